//! Single photons, the tree in which they are looked up, and what was picked among them.

mod lines;
mod look;
mod points;

pub use look::{ColourClass, PhotonColour, PhotonLook};
pub use points::Passing;

use super::buffers::{Units, WorldBuffers, buffer};
use super::gpu_types::{LineRecord, PhotonRecord, PointsUniform};
use super::pipelines::{Pipelines, bind};
use super::records::Records;
use super::{Frame, Gpu, Light, View};
use crate::solution::Split;
use points::Cloud;
use std::mem::size_of;
use std::sync::Arc;
use wgpu::BufferUsages;

/// Length of a tick as a share of the scene's radius.
const TICK: f32 = 0.03;
/// Marks are wider than photons by this much, pixels.
const MARK_WIDER: f32 = 2.0;
/// Threads of a group of splat.wgsl, each for a photon.
const SPLATS: usize = 256;

/// What the views of photons draw over the surfaces of a world.
pub struct PhotonLayer {
    cloud: Cloud,
    /// A `PointsUniform` for photons, and one for marks.
    points: [wgpu::Buffer; 2],
    /// For each pixel the photon that it shows, see splat.wgsl.
    shown: wgpu::Buffer,
    tree: Records<LineRecord>,
    /// What `tree` shows: splits down to this depth.
    drawn_tree: Option<(Arc<Vec<Split>>, u8)>,
    /// Places of a trail, and photons that an estimate used or rejected.
    marks: Records<PhotonRecord>,
    /// A trail, and the disc of an estimate.
    ways: Records<LineRecord>,
    /// Whether marks and ways are of the present light.
    is_marked: bool,
    /// A `FrameUniform`.
    frame: wgpu::Buffer,
    units: Units,
}

impl PhotonLayer {
    pub fn new(gpu: &Gpu, world: &WorldBuffers) -> Self {
        Self {
            cloud: Cloud::new(gpu, &world.world, world.units),
            points: [(); 2].map(|()| buffer(gpu, size_of::<PointsUniform>() as u64, BufferUsages::UNIFORM)),
            shown: buffer(gpu, 0, BufferUsages::STORAGE),
            tree: Records::new(gpu),
            drawn_tree: None,
            marks: Records::new(gpu),
            ways: Records::new(gpu),
            is_marked: false,
            frame: world.frame.clone(),
            units: world.units,
        }
    }

    /// Is told that other light is drawn from now on.
    pub fn set_light(&mut self) {
        self.is_marked = false;
    }

    /// Uploads what `frame` shows and has not been uploaded yet.
    pub fn upload(&mut self, gpu: &Gpu, light: &Light, frame: &Frame) {
        let Some(photons) = &light.photons else { return };
        self.cloud.upload(gpu, photons, frame.photons.colour, &frame.filter);
        let tree = (Arc::clone(&photons.splits), frame.photons.depth);
        let is_drawn = |drawn: &(Arc<Vec<Split>>, u8)| Arc::ptr_eq(&drawn.0, &tree.0) && drawn.1 == tree.1;
        if frame.view == View::KdTree && !self.drawn_tree.as_ref().is_some_and(is_drawn) {
            self.tree.clear();
            self.tree.extend(gpu, lines::of_tree(&tree.0, tree.1, &self.units));
            self.drawn_tree = Some(tree);
        }
        if !self.is_marked {
            self.marks.clear();
            self.marks.extend(gpu, points::marks(light, &self.units));
            self.ways.clear();
            self.ways.extend(gpu, lines::of_picked(light, &self.units));
            self.is_marked = true;
        }
        self.set_frame(gpu, frame);
    }

    /// Says from where photons are seen, and how large they are.
    fn set_frame(&mut self, gpu: &Gpu, frame: &Frame) {
        let look = &frame.photons;
        let photons = PointsUniform {
            eye: self.units.unit_from_world(frame.camera.eye().as_vec3()).to_array(),
            size: look.size,
            tick: if look.ticks { TICK } else { 0.0 },
            count: self.cloud.records().len(),
            stride: look.stride(self.cloud.records().len(), frame.size),
            padding: 0,
        };
        let marks = PointsUniform { size: photons.size + MARK_WIDER, ..photons };
        for (buffer, uniform) in self.points.iter().zip([photons, marks]) {
            gpu.queue.write_buffer(buffer, 0, bytemuck::bytes_of(&uniform));
        }
        let bytes = frame.size.map(u64::from).iter().product::<u64>() * size_of::<u32>() as u64;
        if self.shown.size() < bytes {
            self.shown = buffer(gpu, bytes, BufferUsages::STORAGE);
        }
    }

    /// Finds out which photon each pixel shows, before surfaces of these depths.
    pub fn splat(
        &self,
        gpu: &Gpu,
        pipelines: &Pipelines,
        encoder: &mut wgpu::CommandEncoder,
        depths: &wgpu::TextureView,
    ) {
        encoder.clear_buffer(&self.shown, 0, None);
        let photons = self.cloud.records();
        let group = bind(
            &gpu.device,
            &pipelines.splat_layout,
            &[
                self.frame.as_entire_binding(),
                self.points[0].as_entire_binding(),
                photons.buffer().as_entire_binding(),
                wgpu::BindingResource::TextureView(depths),
                self.shown.as_entire_binding(),
            ],
        );
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipelines.splat);
        pass.set_bind_group(0, &group, &[]);
        pass.dispatch_workgroups(photons.len().div_ceil(SPLATS as u32), 1, 1);
    }

    /// Draws everything over the surfaces.
    pub fn record(&self, gpu: &Gpu, pipelines: &Pipelines, pass: &mut wgpu::RenderPass<'_>, view: View) {
        let mut draw = |pipeline, layout, buffers: &[&wgpu::Buffer], vertices: u32| {
            let resources: Vec<_> = buffers.iter().map(|buffer| buffer.as_entire_binding()).collect();
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &bind(&gpu.device, layout, &resources), &[]);
            pass.draw(0..vertices, 0..1);
        };
        let [points, larger] = &self.points;
        let photons = self.cloud.records().buffer();
        draw(&pipelines.photons, &pipelines.photon_layout, &[&self.frame, points, photons, &self.shown], 3);
        if view == View::KdTree {
            let tree = [&self.frame, self.tree.buffer()];
            draw(&pipelines.lines, &pipelines.line_layout, &tree, 6 * self.tree.len());
        }
        let marks = [&self.frame, larger, self.marks.buffer()];
        draw(&pipelines.marks, &pipelines.mark_layout, &marks, 6 * self.marks.len());
        draw(&pipelines.ways, &pipelines.line_layout, &[&self.frame, self.ways.buffer()], 6 * self.ways.len());
    }
}
