//! Draws a world and the light in it, in a window or into a file, by one path.
//!
//! Elements are drawn into a target of radiance in half floats, which a second pass exposes, bends by a tone curve and
//! encodes for the screen. Only this module names wgpu: a window hands its device through [`Gpu::from_parts`].

mod buffers;
mod exposure;
mod gpu;
pub mod gpu_types;
mod picture;
mod pipelines;
mod readback;
mod targets;
mod view;

pub use exposure::{Exposure, ToneCurve, automatic_exposure};
pub use gpu::{AdapterChoice, Gpu, GpuError, adapter_selector, choose_adapter, device_descriptor};
pub use picture::{Picture, render_picture};
pub use pipelines::SHADERS;
pub use view::{Frame, View};

use crate::solution::Solution;
use crate::world::World;
use buffers::WorldBuffers;
use glam::{DMat4, DVec2, DVec3};
use gpu_types::DisplayUniform;
use pipelines::{Pipelines, bind};
use std::mem::size_of;
use targets::Targets;

/// Width of the outlines of elements, pixels.
const LINE_WIDTH: f32 = 1.0;

/// A world and its light on a graphics device, and the picture of them that was drawn last.
pub struct Viewport {
    gpu: Gpu,
    pipelines: Pipelines,
    encodes: bool,
    world: Option<WorldBuffers>,
    targets: Option<Targets>,
    /// What `targets` show, without what only presenting depends on; `None` when world or light are newer.
    drawn: Option<Drawn>,
    draws: u64,
    display: wgpu::Buffer,
    displayed: DisplayUniform,
    present_group: Option<wgpu::BindGroup>,
}

/// What the targets depend on.
#[derive(Clone, Copy, PartialEq)]
struct Drawn {
    clip_from_world: DMat4,
    size: [u32; 2],
    view: View,
    wireframe: bool,
    show_shooter: bool,
}

impl Viewport {
    /// A viewport without a world, which presents into targets of `output_format` with one sample a pixel and no depth.
    pub fn new(gpu: &Gpu, output_format: wgpu::TextureFormat) -> Self {
        let display = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("display"),
            size: size_of::<DisplayUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self {
            gpu: gpu.clone(),
            pipelines: Pipelines::new(&gpu.device, output_format),
            encodes: !output_format.is_srgb(),
            world: None,
            targets: None,
            drawn: None,
            draws: 0,
            display,
            displayed: bytemuck::Zeroable::zeroed(),
            present_group: None,
        }
    }

    /// Uploads the mesh of a world. It is dark until [`Viewport::set_light`].
    pub fn set_world(&mut self, world: &World) {
        self.world = Some(WorldBuffers::new(&self.gpu, &self.pipelines, world));
        self.drawn = None;
    }

    /// Uploads the light of a solution, which must belong to the world that was set last.
    pub fn set_light(&mut self, world: &World, solution: &Solution) {
        if let Some(buffers) = &mut self.world {
            buffers.set_light(&self.gpu, world, solution);
            self.drawn = None;
        }
    }

    /// Draws what `frame` asks for, or nothing if that is what was drawn last, or if there is no world or no pixel.
    /// Comes before the pass that presents.
    pub fn draw(&mut self, encoder: &mut wgpu::CommandEncoder, frame: &Frame) {
        self.draw_shifted(encoder, frame, DVec2::ZERO);
    }

    /// Shows the picture that was drawn last in the viewport rectangle of `pass`.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        if let Some(group) = &self.present_group {
            self.present_with(pass, group);
        }
    }

    /// How many times [`Viewport::draw`] had something to do.
    pub fn draws(&self) -> u64 {
        self.draws
    }

    /// [`Viewport::draw`] with the picture moved by `shift` pixels, to the right and down.
    fn draw_shifted(&mut self, encoder: &mut wgpu::CommandEncoder, frame: &Frame, shift: DVec2) {
        let Some(world) = &self.world else { return };
        if frame.size.contains(&0) {
            return;
        }
        let [width, height] = frame.size.map(f64::from);
        let moved = DVec3::new(2.0 * shift.x / width, -2.0 * shift.y / height, 0.0);
        let wanted = Drawn {
            clip_from_world: DMat4::from_translation(moved) * frame.camera.clip_from_world((width / height) as f32),
            size: frame.size,
            view: frame.view,
            wireframe: frame.wireframe,
            show_shooter: frame.show_shooter,
        };
        self.set_display(frame, world.scale);
        if self.drawn != Some(wanted) {
            self.resize(frame.size);
            self.record(encoder, &wanted);
            self.drawn = Some(wanted);
            self.draws += 1;
        }
    }

    fn set_display(&mut self, frame: &Frame, scale: f32) {
        let display = DisplayUniform {
            // Stored radiance is scale · π · L.
            exposure: frame.exposure_ev.exp2() / (scale * std::f32::consts::PI),
            tone: frame.tone as u32,
            encode: self.encodes.into(),
        };
        if display != self.displayed {
            self.gpu.queue.write_buffer(&self.display, 0, bytemuck::bytes_of(&display));
            self.displayed = display;
        }
    }

    fn resize(&mut self, size: [u32; 2]) {
        if self.targets.as_ref().is_none_or(|targets| targets.size != size) {
            let targets = Targets::new(&self.gpu.device, size);
            self.present_group = Some(self.present_group(&targets.radiance, &targets.overlay));
            self.targets = Some(targets);
        }
    }

    /// What the presenting pass reads.
    fn present_group(&self, radiance: &wgpu::Texture, overlay: &wgpu::Texture) -> wgpu::BindGroup {
        let [radiance, overlay] = [radiance, overlay].map(targets::view);
        let resources = [
            self.display.as_entire_binding(),
            wgpu::BindingResource::TextureView(&radiance),
            wgpu::BindingResource::TextureView(&overlay),
        ];
        bind(&self.gpu.device, &self.pipelines.present_layout, &resources)
    }

    fn present_with(&self, pass: &mut wgpu::RenderPass<'_>, group: &wgpu::BindGroup) {
        pass.set_pipeline(&self.pipelines.present);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..3, 0..1);
    }

    fn record(&self, encoder: &mut wgpu::CommandEncoder, wanted: &Drawn) {
        let (Some(world), Some(targets)) = (&self.world, &self.targets) else { return };
        let line_width = if wanted.wireframe { LINE_WIDTH } else { 0.0 };
        world.set_frame(&self.gpu, wanted.clip_from_world, wanted.size, line_width);
        let mut pass = targets.begin(encoder);
        pass.set_pipeline(match wanted.view {
            View::Smooth => &self.pipelines.surface_smooth,
            View::Patches | View::Unshot => &self.pipelines.surface_constant,
        });
        pass.set_bind_group(0, world.surface_group(wanted.view), &[]);
        pass.set_index_buffer(world.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..world.index_count, 0, 0..1);
        if wanted.show_shooter && world.outline_edges > 0 {
            pass.set_pipeline(&self.pipelines.outline);
            pass.set_bind_group(0, world.outline_group(), &[]);
            pass.draw(0..6, 0..world.outline_edges);
        }
    }
}
