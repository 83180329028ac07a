//! Which patch exchanges light with which: the matrix of form factors, and one patch's row of it.

use crate::math::sparse::Sparse;
use std::sync::Arc;

/// Why a form factor is zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Zero {
    /// Both lie in one plane.
    SamePlane,
    /// One of them lies behind the other.
    FacesAway,
    /// Something stands between them.
    Occluded,
}

impl Zero {
    pub const ALL: [Self; 3] = [Self::SamePlane, Self::FacesAway, Self::Occluded];

    /// For people.
    pub fn label(self) -> &'static str {
        match self {
            Self::SamePlane => "Same plane",
            Self::FacesAway => "Faces away",
            Self::Occluded => "Occluded",
        }
    }
}

/// The form factors of all pairs of patches, and for each zero its reason.
#[derive(Clone, Debug)]
pub struct FormFactorMatrix {
    /// Row i holds the F_ij that are not zero: the share of the flux of patch i that arrives at patch j.
    pub form_factors: Arc<Sparse>,
    /// Row by row, one for each pair of patches; `None` where F_ij is not zero.
    pub zeros: Arc<Vec<Option<Zero>>>,
}

impl FormFactorMatrix {
    /// Patches along each side.
    pub fn size(&self) -> usize {
        self.form_factors.rows()
    }

    /// The share of all pairs whose form factor is zero for this reason, or with `None` is not zero, in [0, 1].
    pub fn share(&self, reason: Option<Zero>) -> f64 {
        let count = self.zeros.iter().filter(|zero| **zero == reason).count();
        count as f64 / self.zeros.len().max(1) as f64
    }
}

/// What one patch sees.
#[derive(Clone, Debug)]
pub struct Picked {
    /// Index into the patches of the mesh.
    pub patch: u32,
    /// F from the picked patch to each patch of the mesh, in the order of the patches, by the chosen method.
    pub form_factors: Vec<f64>,
    /// Share of its flux that leaves the scene.
    pub escaping: f64,
    pub item_buffer: Arc<ItemBuffer>,
}

/// What is seen from the middle of a patch through each cell of a hemicube.
#[derive(Clone, Debug, PartialEq)]
pub struct ItemBuffer {
    /// Cells along the edge of the top face; the sides are half as high.
    pub resolution: u32,
    /// Top, then the four sides: the patch seen in each cell, or [`ItemBuffer::NOTHING`]. Rows of the top run along the
    /// hemicube's second axis, rows of a side from its foot up.
    pub faces: [Vec<u32>; 5],
}

impl ItemBuffer {
    pub const NOTHING: u32 = u32::MAX;
}
