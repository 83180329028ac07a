//! Single photons, the tree in which they are looked up, and what was picked among them.

mod lines;
mod look;
mod points;

pub use look::{ColourClass, PhotonColour, PhotonLook};

use super::buffers::{Units, WorldBuffers, buffer};
use super::gpu_types::{LineRecord, PhotonRecord, PointsUniform};
use super::pipelines::Pipelines;
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
const MARK_WIDER: f32 = 4.0;

/// What the views of photons draw over the surfaces of a world.
pub struct PhotonLayer {
    cloud: Cloud,
    /// A `PointsUniform` for photons, and one for marks.
    points: [wgpu::Buffer; 2],
    tree: Records<LineRecord>,
    /// What `tree` shows: splits down to this depth.
    drawn_tree: Option<(Arc<Vec<Split>>, u8)>,
    /// Places of a trail, and photons that an estimate used or rejected.
    marks: Records<PhotonRecord>,
    /// A trail, and the disc of an estimate.
    ways: Records<LineRecord>,
    /// Whether marks and ways are of the present light.
    is_marked: bool,
    units: Units,
}

impl PhotonLayer {
    pub fn new(gpu: &Gpu, pipelines: &Pipelines, world: &WorldBuffers) -> Self {
        let points = [(); 2].map(|()| buffer(gpu, size_of::<PointsUniform>() as u64, BufferUsages::UNIFORM));
        let photons = |points| Records::new(gpu, &pipelines.photon_layout, &[&world.frame, points]);
        let lines = || Records::new(gpu, &pipelines.line_layout, &[&world.frame]);
        Self {
            cloud: Cloud::new(&world.world, world.units, photons(&points[0])),
            marks: photons(&points[1]),
            points,
            tree: lines(),
            drawn_tree: None,
            ways: lines(),
            is_marked: false,
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
    }

    /// Says from where photons are seen, and how large they are.
    pub fn set_frame(&self, gpu: &Gpu, frame: &Frame) {
        let eye = self.units.unit_from_world(frame.camera.eye().as_vec3()).to_array();
        let photons = PointsUniform { eye, size: frame.photons.size, tick: TICK, padding: [0; 3] };
        let marks = PointsUniform { size: photons.size + MARK_WIDER, ..photons };
        for (buffer, uniform) in self.points.iter().zip([photons, marks]) {
            gpu.queue.write_buffer(buffer, 0, bytemuck::bytes_of(&uniform));
        }
    }

    /// Draws it over the surfaces.
    pub fn record(&self, pass: &mut wgpu::RenderPass<'_>, pipelines: &Pipelines, view: View, look: &PhotonLook) {
        let mut draw = |pipeline, group, count: u32| {
            if count > 0 {
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, group, &[]);
                pass.draw(0..6 * count, 0..1);
            }
        };
        let photons = self.cloud.records();
        draw(&pipelines.photons, photons.group(), photons.len());
        if look.ticks {
            draw(&pipelines.ticks, photons.group(), photons.len());
        }
        if view == View::KdTree {
            draw(&pipelines.lines, self.tree.group(), self.tree.len());
        }
        draw(&pipelines.ways, self.ways.group(), self.ways.len());
        draw(&pipelines.marks, self.marks.group(), self.marks.len());
    }
}
