//! Draws a world and the light in it, in a window or into a file, by one path.
//!
//! Elements are drawn into a target of radiance in half floats, which a second pass exposes, bends by a tone curve and
//! encodes for the screen. Only this module names wgpu: a window hands its device through [`Gpu::from_parts`].

mod exposure;
mod gpu;
pub mod gpu_types;
mod picture;
mod view;

pub use exposure::{Exposure, ToneCurve, automatic_exposure};
pub use gpu::{AdapterChoice, Gpu, GpuError, adapter_selector, choose_adapter, device_descriptor};
pub use picture::{Picture, render_picture};
pub use view::{Frame, View};

use crate::solution::Solution;
use crate::world::World;

/// A world and its light on a graphics device, and the picture of them that was drawn last.
pub struct Viewport {
    gpu: Gpu,
    output_format: wgpu::TextureFormat,
}

impl Viewport {
    /// A viewport without a world, which presents into targets of `output_format` with one sample and no depth.
    pub fn new(gpu: &Gpu, output_format: wgpu::TextureFormat) -> Self {
        Self { gpu: gpu.clone(), output_format }
    }

    /// Uploads the mesh of a world. It is dark until [`Viewport::set_light`].
    pub fn set_world(&mut self, world: &World) {
        let _ = (&self.gpu, self.output_format, world);
    }

    /// Uploads the light of a solution, which must belong to the world that was set last.
    pub fn set_light(&mut self, world: &World, solution: &Solution) {
        let _ = (world, solution);
    }

    /// Draws what `frame` asks for, or nothing if that is what was drawn last. Call it before the pass that presents.
    pub fn draw(&mut self, encoder: &mut wgpu::CommandEncoder, frame: &Frame) {
        let _ = (encoder, frame);
    }

    /// Shows the picture that was drawn last in the viewport rectangle of `pass`.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        let _ = pass;
    }

    /// How many times [`Viewport::draw`] had something to do.
    pub fn draws(&self) -> u64 {
        0
    }
}
