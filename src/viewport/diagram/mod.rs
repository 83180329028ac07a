//! Pictures that are no view of the scene, drawn without a graphics adapter: of the matrix of form factors, and of what a
//! patch sees.

mod canvas;
mod item_buffer;
mod matrix;

pub use item_buffer::item_buffer;
pub use matrix::{MatrixDiagram, Swatch, matrix};

use crate::choice::Choice;

/// Which diagram is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Diagram {
    /// See [`matrix`].
    Matrix,
    /// See [`item_buffer`].
    ItemBuffer,
}

impl Diagram {
    /// What to do where there is nothing to draw it from.
    pub fn remedy(self) -> &'static str {
        match self {
            Self::Matrix => "Only the solvers Jacobi, Gauss-Seidel and Southwell keep a matrix: choose one and run",
            Self::ItemBuffer => "Click a patch to see what its hemicube sees",
        }
    }
}

impl Choice for Diagram {
    const ALL: &'static [Self] = &[Self::Matrix, Self::ItemBuffer];
    const KIND: &'static str = "diagram";

    fn name(self) -> &'static str {
        match self {
            Self::Matrix => "matrix",
            Self::ItemBuffer => "item-buffer",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Matrix => "Matrix",
            Self::ItemBuffer => "Item buffer",
        }
    }

    fn meaning(self) -> &'static str {
        match self {
            Self::Matrix => "The form factors of all pairs of patches, and why so many of them are zero",
            Self::ItemBuffer => "What the picked patch sees through each cell of its hemicube",
        }
    }
}
