//! A picture from a camera on the graphics device, shown as it is.

use super::Gpu;
use super::colour_map::GREY;
use super::pipelines::{Pipelines, bind};
use super::shading::Quantity;
use super::{Legend, targets};
use crate::math::rgb::Rgb;
use crate::solution::CameraImage;
use bytemuck::cast_slice;
use std::sync::Arc;
use wgpu::TextureUsages;

/// Of radiance in single precision.
pub const EXACT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// A picture from a camera, uploaded.
pub struct ImageTexture {
    pub image: Arc<CameraImage>,
    texture: wgpu::Texture,
    pub group: wgpu::BindGroup,
}

impl ImageTexture {
    /// `display` is what the presenting pass reads of a `DisplayUniform`.
    pub fn new(gpu: &Gpu, pipelines: &Pipelines, display: &wgpu::Buffer, image: &Arc<CameraImage>) -> Self {
        let texture = texture(gpu, image.resolution);
        let no_lines = targets::texture(&gpu.device, [1; 2], targets::OVERLAY, 1, TextureUsages::TEXTURE_BINDING);
        let [radiance, overlay] = [&texture, &no_lines].map(targets::view);
        let resources = [
            display.as_entire_binding(),
            wgpu::BindingResource::TextureView(&radiance),
            wgpu::BindingResource::TextureView(&overlay),
        ];
        let group = bind(&gpu.device, &pipelines.present_layout, &resources);
        let uploaded = Self { image: Arc::clone(image), texture, group };
        uploaded.write(gpu);
        uploaded
    }

    /// Takes over another picture; false if it has another resolution.
    pub fn replace(&mut self, gpu: &Gpu, image: &Arc<CameraImage>) -> bool {
        let fits = self.image.resolution == image.resolution;
        if fits {
            self.image = Arc::clone(image);
            self.write(gpu);
        }
        fits
    }

    /// What its values are.
    pub fn quantity(&self) -> Quantity {
        if self.image.view.is_light() { Quantity::FluxDensity } else { Quantity::Colour }
    }

    /// How many cells lie along its width and height: the last ones may reach past the edge.
    pub fn span(&self) -> [f32; 2] {
        self.image.size.map(|pixels| pixels as f32 / self.image.cell() as f32)
    }

    fn write(&self, gpu: &Gpu) {
        write(gpu, &self.texture, cast_slice(&texels(&self.image)));
    }
}

/// Radiance of each cell, or its false colour, premultiplied with the coverage in the fourth channel, row by row from the
/// top left.
pub fn texels(image: &CameraImage) -> Vec<[f32; 4]> {
    let texel = |(colour, &coverage): (Rgb, &f32)| [colour.x, colour.y, colour.z, coverage];
    if image.view.is_comparison() {
        return differences(image).zip(&image.coverage).map(texel).collect();
    }
    image.radiance.iter().copied().zip(&image.coverage).map(texel).collect()
}

/// The colour of the difference that each cell shows; plain grey where there is nothing to compare.
fn differences(image: &CameraImage) -> impl Iterator<Item = Rgb> {
    let legend = Legend::of_image(image);
    let colour =
        move |cell| legend.as_ref().zip(image.difference(cell)).map_or(GREY, |(legend, value)| legend.colour(value));
    (0..image.radiance.len()).map(move |cell| image.coverage[cell] * colour(cell))
}

/// A texture of four floats a texel.
pub fn texture(gpu: &Gpu, size: [u32; 2]) -> wgpu::Texture {
    targets::texture(&gpu.device, size, EXACT, 1, TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST)
}

/// Fills a texture of [`texture`].
pub fn write(gpu: &Gpu, texture: &wgpu::Texture, values: &[f32]) {
    let row = Some(16 * texture.width());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: row, rows_per_image: None };
    gpu.queue.write_texture(texture.as_image_copy(), cast_slice(values), layout, texture.size());
}
