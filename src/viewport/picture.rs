//! A picture without a window.

use super::colour_map::encoded;
use super::readback::{from_half, read_texture};
use super::targets::{self, SAMPLES};
use super::{Frame, Gpu, GpuError, Light, Viewport, image};
use crate::world::World;
use bytemuck::pod_collect_to_vec;
use glam::DVec2;
use std::sync::Arc;
use wgpu::TextureUsages;

/// A finished picture, row by row from the top left.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Linear radiance, W/(m²·sr), or the linear colours of false colours and diagrams, premultiplied with the fourth
    /// channel: the share of the pixel that is covered.
    pub linear: Vec<[f32; 4]>,
    /// As on the screen: exposed, tone-mapped and encoded, on an opaque background. Diagrams have none: their fourth
    /// channel is the same share.
    pub srgb: Vec<[u8; 4]>,
}

impl Picture {
    /// A picture of linear colours in [0, 1], premultiplied with the fourth channel, that are shown as they are.
    pub(super) fn of_colours(size: [u32; 2], linear: Vec<[f32; 4]>) -> Self {
        let shown = |&[r, g, b, coverage]: &[f32; 4]| {
            let [r, g, b] = [r, g, b].map(|value| if coverage > 0.0 { encoded(value / coverage) } else { 0 });
            [r, g, b, (255.0 * coverage).round() as u8]
        };
        Self { size, srgb: linear.iter().map(shown).collect(), linear }
    }
}

/// Draws a frame of a world and its light as a window would, with `samples` a pixel, rounded up to a multiple of 4.
///
/// # Errors
/// If the picture is empty or larger than the adapter can draw, or the device fails.
pub fn render_picture(
    gpu: &Gpu,
    world: &Arc<World>,
    light: &Light,
    frame: &Frame,
    samples: u32,
) -> Result<Picture, GpuError> {
    check_size(gpu, frame.size)?;
    gpu.check()?;
    let mut viewport = Viewport::new(gpu, FINISHED);
    // A picture by rays has its pixels already: nothing of the world is drawn, however large that is.
    viewport.set_light(light);
    if let Some(image) = viewport.take_image(frame) {
        return viewport.finish(&image);
    }
    viewport.set_world(world);
    viewport.set_light(light);
    let draws = samples.div_ceil(SAMPLES).max(1);
    let mut sum = Sum::new(frame.size);
    for draw in 0..draws {
        viewport.accumulate(frame, subpixel(draw, draws), &mut sum)?;
    }
    viewport.finish(&sum.mean(draws))
}

/// Of pictures for files.
const FINISHED: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Radiance as stored and coverage by lines, four floats a pixel each.
struct Sum {
    size: [u32; 2],
    radiance: Vec<f32>,
    overlay: Vec<f32>,
}

impl Sum {
    fn new(size: [u32; 2]) -> Self {
        let channels = 4 * size[0] as usize * size[1] as usize;
        Self { size, radiance: vec![0.0; channels], overlay: vec![0.0; channels] }
    }

    fn mean(mut self, draws: u32) -> Self {
        for value in self.radiance.iter_mut().chain(&mut self.overlay) {
            *value /= draws as f32;
        }
        self
    }
}

impl Viewport {
    /// Draws once and adds the result to `sum`.
    fn accumulate(&mut self, frame: &Frame, shift: DVec2, sum: &mut Sum) -> Result<(), GpuError> {
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.draw_shifted(&mut encoder, frame, shift);
        self.gpu.queue.submit([encoder.finish()]);
        let Some(targets) = &self.targets else { return Ok(()) };
        let radiance: Vec<u16> = pod_collect_to_vec(&read_texture(&self.gpu, &targets.radiance)?);
        for (sum, half) in sum.radiance.iter_mut().zip(radiance) {
            *sum += from_half(half);
        }
        let overlay = read_texture(&self.gpu, &targets.overlay)?;
        for (sum, lines) in sum.overlay.chunks_exact_mut(4).zip(overlay.chunks_exact(2)) {
            sum[0] += f32::from(lines[0]) / 255.0;
            sum[1] += f32::from(lines[1]) / 255.0;
        }
        Ok(())
    }

    /// The picture from a camera that `frame` shows, if it shows one, as what is presented from now on. Pixels of a coarse
    /// picture take over their cell's value.
    fn take_image(&mut self, frame: &Frame) -> Option<Sum> {
        self.shows_image = self.upload_image(frame);
        let uploaded = self.image.as_ref().filter(|_| self.shows_image)?;
        let (cells, resolution, span) = (image::texels(&uploaded.image), uploaded.image.resolution, uploaded.span());
        let mut sum = Sum::new(frame.size);
        let [width, height] = frame.size;
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| [x, y]));
        for (texel, pixel) in sum.radiance.chunks_exact_mut(4).zip(pixels) {
            let [x, y] = [0, 1].map(|axis| {
                let share = (pixel[axis] as f32 + 0.5) / frame.size[axis] as f32;
                ((share * span[axis]) as u32).min(resolution[axis] - 1)
            });
            texel.copy_from_slice(&cells[(y * resolution[0] + x) as usize]);
        }
        self.set_display(frame, frame.size.map(|pixels| pixels as f32));
        Some(sum)
    }

    /// Presents a mean of draws and reads the result.
    fn finish(&self, mean: &Sum) -> Result<Picture, GpuError> {
        let [radiance, overlay] = [&mean.radiance, &mean.overlay].map(|values| {
            let texture = image::texture(&self.gpu, mean.size);
            image::write(&self.gpu, &texture, values);
            texture
        });
        let group = self.present_group(&radiance, &overlay);
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
        let finished = targets::texture(&self.gpu.device, mean.size, FINISHED, 1, usage);
        let view = targets::view(&finished);
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("finish"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        self.present_with(&mut pass, &group);
        drop(pass);
        self.gpu.queue.submit([encoder.finish()]);
        let srgb = pod_collect_to_vec(&read_texture(&self.gpu, &finished)?);
        let (_, stored) = self.stored();
        let linear =
            mean.radiance.chunks_exact(4).map(|v| [v[0] / stored, v[1] / stored, v[2] / stored, v[3]]).collect();
        Ok(Picture { size: mean.size, linear, srgb })
    }
}

/// Whether the graphics adapter can draw a picture of this width and height in pixels.
///
/// # Errors
/// If it cannot.
pub fn check_size(gpu: &Gpu, [width, height]: [u32; 2]) -> Result<(), GpuError> {
    let limit = gpu.device.limits().max_texture_dimension_2d;
    let possible = 1..=limit;
    if possible.contains(&width) && possible.contains(&height) {
        Ok(())
    } else {
        Err(GpuError::PictureSize { width, height, limit })
    }
}

/// By how much the picture is moved in one of several draws, pixels. One draw has a sample near the middle of each quarter
/// of a pixel; the shifts spread over a quarter (Hammersley's points), and there is none in a single draw.
fn subpixel(draw: u32, draws: u32) -> DVec2 {
    let x = (f64::from(draw) + 0.5) / f64::from(draws);
    let y = f64::from(draw.reverse_bits()) / 2f64.powi(32) + 0.5 / f64::from(draws);
    0.5 * (DVec2::new(x, y) - 0.5)
}
