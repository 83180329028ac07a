//! Diagrams as textures, made anew only when there is something new to show.

use crate::solution::{FormFactorMatrix, Picked};
use crate::viewport::diagram::{MatrixDiagram, Swatch, item_buffer, matrix};
use crate::viewport::{Legend, Picture};
use crate::worker::Snapshot;
use egui::{ColorImage, Context, TextureFilter, TextureHandle, TextureOptions};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

/// Pixels along the edges of a texture: what fits into a window on most screens.
const LIMIT: u32 = 768;

/// What is drawn or being drawn.
#[derive(Default)]
pub struct Diagrams {
    item_buffer: Option<(Arc<Picked>, TextureHandle)>,
    matrix: Option<(FormFactorMatrix, MatrixTexture)>,
    /// The matrix that a thread draws: a large one takes longer than a frame.
    drawing: Option<Receiver<(FormFactorMatrix, MatrixDiagram)>>,
}

/// A matrix on a texture, and what its colours mean.
pub struct MatrixTexture {
    pub texture: TextureHandle,
    /// Patches along each edge.
    pub size: usize,
    pub legend: Option<Legend>,
    pub zeros: [Swatch; 3],
    /// Share of the form factors that are not zero, in [0, 1].
    pub filled: f64,
}

impl Diagrams {
    /// Draws what is new in the snapshot, the matrix only if it `is_wanted`.
    pub fn follow(&mut self, ctx: &Context, snapshot: &Snapshot, is_wanted: bool) {
        self.follow_picked(ctx, snapshot);
        let matrix = snapshot.solution.as_ref().and_then(|solution| solution.matrix.as_ref());
        self.matrix.take_if(|(drawn, _)| matrix.is_none_or(|matrix| !is_same(drawn, matrix)));
        if let Some(done) = self.drawing.as_ref().and_then(|drawing| drawing.try_recv().ok()) {
            self.drawing = None;
            if matrix.is_some_and(|matrix| is_same(&done.0, matrix)) {
                self.matrix = Some((done.0.clone(), upload_matrix(ctx, &done.0, done.1)));
            }
        }
        if let Some(matrix) = matrix.filter(|_| is_wanted && self.matrix.is_none() && self.drawing.is_none()) {
            self.drawing = Some(draw_matrix(ctx, matrix.clone()));
        }
    }

    fn follow_picked(&mut self, ctx: &Context, snapshot: &Snapshot) {
        let (Some(world), Some(picked)) = (&snapshot.world, &snapshot.picked) else {
            self.item_buffer = None;
            return;
        };
        if self.item_buffer.as_ref().is_none_or(|(drawn, _)| !Arc::ptr_eq(drawn, picked)) {
            let picture = item_buffer(&picked.item_buffer, world, LIMIT);
            self.item_buffer = Some((Arc::clone(picked), upload(ctx, "item buffer", &picture)));
        }
    }

    /// What the picked patch sees through its hemicube.
    pub fn item_buffer(&self) -> Option<&TextureHandle> {
        self.item_buffer.as_ref().map(|(_, texture)| texture)
    }

    pub fn matrix(&self) -> Option<&MatrixTexture> {
        self.matrix.as_ref().map(|(_, texture)| texture)
    }
}

fn is_same(one: &FormFactorMatrix, other: &FormFactorMatrix) -> bool {
    Arc::ptr_eq(&one.form_factors, &other.form_factors)
}

fn draw_matrix(ctx: &Context, drawn: FormFactorMatrix) -> Receiver<(FormFactorMatrix, MatrixDiagram)> {
    let (sender, receiver) = channel();
    let ctx = ctx.clone();
    std::thread::spawn(move || {
        let diagram = matrix(&drawn, LIMIT);
        // The window may be gone by now.
        if sender.send((drawn, diagram)).is_ok() {
            ctx.request_repaint();
        }
    });
    receiver
}

fn upload_matrix(ctx: &Context, matrix: &FormFactorMatrix, diagram: MatrixDiagram) -> MatrixTexture {
    MatrixTexture {
        texture: upload(ctx, "matrix", &diagram.picture),
        size: matrix.size(),
        legend: diagram.legend,
        zeros: diagram.zeros,
        filled: matrix.share(None),
    }
}

fn upload(ctx: &Context, name: &str, picture: &Picture) -> TextureHandle {
    let size = picture.size.map(|pixels| pixels as usize);
    let image = ColorImage::from_rgba_unmultiplied(size, picture.srgb.as_flattened());
    // Cells have edges.
    let options = TextureOptions { magnification: TextureFilter::Nearest, ..TextureOptions::LINEAR };
    ctx.load_texture(name, image, options)
}
