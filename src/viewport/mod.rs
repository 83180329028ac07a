//! Draws a world and the light in it, in a window or into a file, by one path.
//!
//! A [`View`] says which value each element has. Elements are drawn into a target of radiance in half floats, photons
//! over them, and a second pass exposes the target, bends it by a tone curve and encodes it for the screen; false colours
//! pass as they are. A picture from a camera is taken to the second pass without the first. Diagrams need no device. Only
//! this module names wgpu: a window hands its device through [`Gpu::from_parts`].

mod buffers;
pub mod colour_map;
pub mod diagram;
mod exposure;
mod gpu;
pub mod gpu_types;
mod image;
mod legend;
mod photons;
mod picking;
mod picture;
mod pipelines;
mod readback;
mod records;
mod shading;
mod targets;
mod view;

pub use exposure::{Exposure, ToneCurve, automatic_exposure};
pub use gpu::{AdapterChoice, Gpu, GpuError, adapter_selector, choose_adapter, device_descriptor};
pub use legend::Legend;
pub use photons::{ColourClass, PhotonColour, PhotonLook};
pub use picking::{pick_patch, pick_photon, pick_point};
pub use picture::{Picture, check_size, render_picture};
pub use pipelines::SHADERS;
pub use view::{Frame, Light, View};

use crate::solution::PathFilter;
use crate::world::World;
use buffers::WorldBuffers;
use glam::{DMat4, DVec2, DVec3};
use gpu_types::DisplayUniform;
use image::ImageTexture;
use photons::PhotonLayer;
use pipelines::{Pipelines, bind};
use shading::{Quantity, Shading};
use std::mem::size_of;
use std::sync::Arc;
use targets::{Part, Targets};

/// Width of the outlines of elements, pixels.
const LINE_WIDTH: f32 = 1.0;
/// Colours of outlines, linear RGB: of the patch that shot last, and of the picked one, which stands out from all false
/// colours.
const SHOOTER: [f32; 3] = [0.0, 0.35, 1.0];
const PICKED: [f32; 3] = [1.0, 0.02, 0.1];

/// A world and its light on a graphics device, and the picture of them that was drawn last.
pub struct Viewport {
    gpu: Gpu,
    pipelines: Pipelines,
    encodes: bool,
    world: Option<WorldBuffers>,
    photons: Option<PhotonLayer>,
    light: Option<Light>,
    /// The picture from a camera that was uploaded last.
    image: Option<ImageTexture>,
    /// Whether `image` is what is presented, and not the targets.
    shows_image: bool,
    /// What of the light is uploaded; `None` when world or light are newer.
    uploaded: Option<Contents>,
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
    contents: Contents,
    wireframe: bool,
    /// A patch.
    outlined: Option<u32>,
    /// Where single photons are drawn.
    photons: Option<(PhotonLook, PathFilter)>,
}

/// What the values of elements depend on, beside world and light.
#[derive(Clone, Copy, PartialEq)]
struct Contents {
    view: View,
    bounce: usize,
    ambient: bool,
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
            photons: None,
            light: None,
            image: None,
            shows_image: false,
            uploaded: None,
            targets: None,
            drawn: None,
            draws: 0,
            display,
            displayed: bytemuck::Zeroable::zeroed(),
            present_group: None,
        }
    }

    /// Uploads the mesh of a world. It is dark until [`Viewport::set_light`].
    pub fn set_world(&mut self, world: &Arc<World>) {
        let world = WorldBuffers::new(&self.gpu, &self.pipelines, world);
        self.photons = Some(PhotonLayer::new(&self.gpu, &world));
        self.world = Some(world);
        self.light = None;
        self.uploaded = None;
        self.drawn = None;
    }

    /// Takes over the light of the world that was set last. What a picture needs of it is uploaded when that is drawn.
    pub fn set_light(&mut self, light: &Light) {
        self.light = Some(light.clone());
        if let Some(photons) = &mut self.photons {
            photons.set_light();
        }
        self.uploaded = None;
        self.drawn = None;
    }

    /// Draws what `frame` asks for, or nothing if that is what was drawn last, or if there is no world or no pixel.
    /// Comes before the pass that presents.
    pub fn draw(&mut self, encoder: &mut wgpu::CommandEncoder, frame: &Frame) {
        self.draw_shifted(encoder, frame, DVec2::ZERO);
    }

    /// Shows the picture that was drawn last in the viewport rectangle of `pass`.
    pub fn present(&self, pass: &mut wgpu::RenderPass<'_>) {
        let image = self.image.as_ref().filter(|_| self.shows_image).map(|image| &image.group);
        if let Some(group) = image.or(self.present_group.as_ref()) {
            self.present_with(pass, group);
        }
    }

    /// How many times [`Viewport::draw`] had something to do.
    pub fn draws(&self) -> u64 {
        self.draws
    }

    /// [`Viewport::draw`] with the picture moved by `shift` pixels, to the right and down.
    fn draw_shifted(&mut self, encoder: &mut wgpu::CommandEncoder, frame: &Frame, shift: DVec2) {
        if self.world.is_none() || frame.size.contains(&0) {
            return;
        }
        self.shows_image = self.upload_image(frame);
        if let Some(image) = self.image.as_ref().filter(|_| self.shows_image) {
            return self.set_display(frame, image.span());
        }
        let [width, height] = frame.size.map(f64::from);
        let moved = DVec3::new(2.0 * shift.x / width, -2.0 * shift.y / height, 0.0);
        let wanted = Drawn {
            clip_from_world: DMat4::from_translation(moved) * frame.camera.clip_from_world((width / height) as f32),
            size: frame.size,
            contents: Contents { view: frame.view, bounce: frame.bounce, ambient: frame.ambient },
            wireframe: frame.wireframe,
            outlined: self.light.as_ref().and_then(|light| frame.outlined(light)),
            photons: self.shows_photons(frame).then_some((frame.photons, frame.filter)),
        };
        self.upload_values(frame, wanted.contents);
        self.set_display(frame, frame.size.map(|pixels| pixels as f32));
        if self.drawn != Some(wanted) {
            self.resize(frame.size);
            if wanted.photons.is_some() {
                self.upload_photons(frame);
            }
            self.record(encoder, &wanted);
            self.drawn = Some(wanted);
            self.draws += 1;
        }
    }

    /// Uploads what `frame` shows of the light, unless that was uploaded last.
    fn upload_values(&mut self, frame: &Frame, contents: Contents) {
        let (Some(world), Some(light)) = (&mut self.world, &self.light) else { return };
        if self.uploaded != Some(contents) {
            let drawn_world = Arc::clone(&world.world);
            world.set_values(&self.gpu, &Shading::of(&drawn_world, light, frame));
            self.uploaded = Some(contents);
        }
    }

    /// Uploads the picture from a camera that `frame` shows, unless that was uploaded last; false if it shows none.
    fn upload_image(&mut self, frame: &Frame) -> bool {
        let View::Camera(view) = frame.view else { return false };
        let Some(image) = self.light.as_ref().and_then(|light| light.image_of(view)) else { return false };
        let is_uploaded = self.image.as_ref().is_some_and(|uploaded| Arc::ptr_eq(&uploaded.image, image));
        if !is_uploaded {
            let is_replaced = self.image.as_mut().is_some_and(|uploaded| uploaded.replace(&self.gpu, image));
            if !is_replaced {
                self.image = Some(ImageTexture::new(&self.gpu, &self.pipelines, &self.display, image));
            }
            self.draws += 1;
        }
        true
    }

    /// Uploads what `frame` shows of photons and has not been uploaded.
    fn upload_photons(&mut self, frame: &Frame) {
        let (Some(photons), Some(light)) = (&mut self.photons, &self.light) else { return };
        photons.upload(&self.gpu, light, frame);
    }

    /// Whether `frame` shows single photons, and there are some.
    fn shows_photons(&self, frame: &Frame) -> bool {
        frame.view.shows_photons() && self.light.as_ref().is_some_and(|light| light.photons.is_some())
    }

    /// What is stored in the picture that is presented: of what, and how much for a unit of it.
    fn stored(&self) -> (Quantity, f32) {
        let image = self.image.as_ref().filter(|_| self.shows_image).map(|image| (image.quantity(), 1.0));
        let surfaces = || self.world.as_ref().map(|world| (world.quantity, world.stored_per_unit));
        image.or_else(surfaces).unwrap_or((Quantity::FluxDensity, 1.0))
    }

    /// Says how the stored picture, of which this many texels lie along width and height, is shown.
    fn set_display(&mut self, frame: &Frame, span: [f32; 2]) {
        let is_picked = self.light.as_ref().is_some_and(|light| light.picked.is_some());
        let (quantity, stored_per_unit) = self.stored();
        let (shown_per_unit, tone) = match quantity {
            Quantity::FluxDensity => (frame.exposure_ev.exp2(), frame.tone),
            Quantity::Colour => (1.0, ToneCurve::Linear),
        };
        let display = DisplayUniform {
            outline: if is_picked { PICKED } else { SHOOTER },
            exposure: shown_per_unit / stored_per_unit,
            tone: tone as u32,
            encode: self.encodes.into(),
            span,
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
        let photons = self.photons.as_ref().filter(|_| wanted.photons.is_some());
        let mut pass = targets.begin(encoder, if photons.is_some() { Part::First } else { Part::Whole });
        let surface = if world.is_smooth { &self.pipelines.surface_smooth } else { &self.pipelines.surface_constant };
        pass.set_pipeline(surface);
        pass.set_bind_group(0, world.surface_group(), &[]);
        pass.set_index_buffer(world.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..world.index_count, 0, 0..1);
        if let Some(patch) = wanted.outlined {
            let edges = world.set_outline(&self.gpu, patch);
            pass.set_pipeline(&self.pipelines.outline);
            pass.set_bind_group(0, world.outline_group(), &[]);
            pass.draw(0..6, 0..edges);
        }
        drop(pass);
        if let Some(photons) = photons {
            photons.splat(&self.gpu, &self.pipelines, encoder, &targets.depth_samples);
            let mut pass = targets.begin(encoder, Part::Last);
            photons.record(&self.gpu, &self.pipelines, &mut pass, wanted.contents.view);
        }
    }
}
