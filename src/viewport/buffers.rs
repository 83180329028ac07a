//! A world and its light in the memory of the graphics device.

use super::gpu_types::{FrameUniform, OutlineUniform};
use super::pipelines::{Pipelines, bind};
use super::{Gpu, View};
use crate::math::rgb::Rgb;
use crate::mesh::{Mesh, Patch};
use crate::solution::Solution;
use crate::world::World;
use bytemuck::{Pod, Zeroable, cast_slice};
use glam::{DMat4, DVec3, Vec3};
use std::f32::consts::PI;
use std::mem::size_of;
use wgpu::BufferUsages;

/// The corner that a triangle does not have.
const NO_CORNER: u32 = u32::MAX;
/// On the screen, pixels.
const SHOOTER_WIDTH: f32 = 3.0;
/// The largest radiance is stored as at most this, by half floats that end at 65504.
const LARGEST_STORED: f32 = 32768.0;

/// The mesh, uploaded once, and its light, uploaded with each solution.
pub struct WorldBuffers {
    /// Corners 4 e + k of the triangles that elements are drawn as.
    pub indices: wgpu::Buffer,
    pub index_count: u32,
    /// Edges of the outlined shooter; 0 where nothing has shot.
    pub outline_edges: u32,
    /// Uploaded radiosity to stored radiance: 1/π and a power of two, which keeps half floats in range.
    pub scale: f32,
    frame: wgpu::Buffer,
    outline: wgpu::Buffer,
    /// Radiosity of elements, radiosity of vertices, unshot radiosity of elements, in the order of [`View::ALL`].
    values: [wgpu::Buffer; 3],
    surface_groups: [wgpu::BindGroup; 3],
    outline_group: wgpu::BindGroup,
    units: Units,
    /// Radiosity of vertices, kept to be filled again.
    smoothed: Vec<Rgb>,
}

impl WorldBuffers {
    pub fn new(gpu: &Gpu, pipelines: &Pipelines, world: &World) -> Self {
        let mesh = &world.mesh;
        let units = Units::new(world);
        let positions: Vec<Vec3> = mesh.vertices.iter().map(|&vertex| units.unit_from_world(vertex)).collect();
        let corners: Vec<[u32; 4]> = mesh.elements.iter().map(|element| padded(element.corners())).collect();
        let indices = triangle_indices(mesh);

        let storage = BufferUsages::STORAGE;
        let [per_element, per_vertex] =
            [mesh.elements.len(), mesh.vertices.len()].map(|n| (n * size_of::<Rgb>()) as u64);
        let values = [per_element, per_vertex, per_element].map(|size| buffer(gpu, size, storage));
        let frame = buffer(gpu, size_of::<FrameUniform>() as u64, BufferUsages::UNIFORM);
        let outline = buffer(gpu, size_of::<OutlineUniform>() as u64, BufferUsages::UNIFORM);
        let [positions, corners] = [filled(gpu, &positions, storage), filled(gpu, &corners, storage)];

        let surface_groups = values.each_ref().map(|values| {
            let buffers = [&frame, &positions, &corners, values].map(wgpu::Buffer::as_entire_binding);
            bind(&gpu.device, &pipelines.surface_layout, &buffers)
        });
        let outline_resources = [&frame, &outline].map(wgpu::Buffer::as_entire_binding);
        Self {
            index_count: indices.len() as u32,
            indices: filled(gpu, &indices, BufferUsages::INDEX),
            outline_edges: 0,
            scale: 1.0 / PI,
            outline_group: bind(&gpu.device, &pipelines.outline_layout, &outline_resources),
            frame,
            outline,
            values,
            surface_groups,
            units,
            smoothed: Vec::new(),
        }
    }

    /// Uploads radiosities, smoothed and not, and the outline of the shooter. Only memory is moved: no buffer is made.
    pub fn set_light(&mut self, gpu: &Gpu, world: &World, solution: &Solution) {
        let light = &solution.light;
        world.mesh.smooth(&light.radiosity, &mut self.smoothed);
        for (buffer, values) in self.values.iter().zip([&light.radiosity, &self.smoothed, &light.unshot]) {
            gpu.queue.write_buffer(buffer, 0, cast_slice(values));
        }
        self.scale = range_scale(&[&light.radiosity, &light.unshot]) / PI;
        self.outline_edges = 0;
        if let Some(shooter) = solution.shooter {
            let outline = self.units.outline(&world.mesh.patches[shooter as usize]);
            gpu.queue.write_buffer(&self.outline, 0, bytemuck::bytes_of(&outline));
            self.outline_edges = outline.count;
        }
    }

    pub fn set_frame(&self, gpu: &Gpu, clip_from_world: DMat4, size: [u32; 2], line_width: f32) {
        let uniform = FrameUniform {
            clip_from_unit: (clip_from_world * self.units.world_from_unit()).as_mat4().to_cols_array_2d(),
            size: size.map(|pixels| pixels as f32),
            scale: self.scale,
            line_width,
        };
        gpu.queue.write_buffer(&self.frame, 0, bytemuck::bytes_of(&uniform));
    }

    pub fn surface_group(&self, view: View) -> &wgpu::BindGroup {
        &self.surface_groups[view as usize]
    }

    pub fn outline_group(&self) -> &wgpu::BindGroup {
        &self.outline_group
    }
}

/// Coordinates in which the scene is at the origin and has radius 1. The change is made in double precision, so that
/// single precision is enough for what is drawn, however large or far from the origin a scene is.
struct Units {
    center: DVec3,
    /// World units in one.
    radius: f64,
}

impl Units {
    fn new(world: &World) -> Self {
        let radius = f64::from(world.bounds.radius());
        Self { center: world.bounds.center().as_dvec3(), radius: if radius > 0.0 { radius } else { 1.0 } }
    }

    fn unit_from_world(&self, position: Vec3) -> Vec3 {
        ((position.as_dvec3() - self.center) / self.radius).as_vec3()
    }

    fn world_from_unit(&self) -> DMat4 {
        DMat4::from_translation(self.center) * DMat4::from_scale(DVec3::splat(self.radius))
    }

    fn outline(&self, patch: &Patch) -> OutlineUniform {
        let mut outline = OutlineUniform { width: SHOOTER_WIDTH, ..OutlineUniform::zeroed() };
        for (corner, &position) in outline.corners.iter_mut().zip(patch.corners()) {
            *corner = self.unit_from_world(position).extend(1.0).to_array();
            outline.count += 1;
        }
        outline
    }
}

fn padded(corners: &[u32]) -> [u32; 4] {
    let mut padded = [NO_CORNER; 4];
    padded[..corners.len()].copy_from_slice(corners);
    padded
}

/// A fan of triangles for each element.
fn triangle_indices(mesh: &Mesh) -> Vec<u32> {
    let fan = |(element, corners): (usize, &[u32])| {
        let first = 4 * element as u32;
        (2..corners.len() as u32).flat_map(move |corner| [first, first + corner - 1, first + corner])
    };
    mesh.elements.iter().map(|element| element.corners()).enumerate().flat_map(fan).collect()
}

/// The power of two that takes the radiance of the largest of some radiosities as far up as half floats reach. A power
/// of two, so that it costs no precision.
fn range_scale(radiosities: &[&[Rgb]]) -> f32 {
    let largest = radiosities.iter().flat_map(|values| values.iter()).fold(Rgb::ZERO, |a, &b| a.max(b)).max_element();
    let radiance = largest / PI;
    if radiance > 0.0 { (LARGEST_STORED / radiance).log2().floor().exp2() } else { 1.0 }
}

/// Never empty, because an empty buffer cannot be bound.
fn buffer(gpu: &Gpu, size: u64, usage: BufferUsages) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: size.max(size_of::<[f32; 4]>() as u64),
        usage: usage | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

fn filled<T: Pod>(gpu: &Gpu, data: &[T], usage: BufferUsages) -> wgpu::Buffer {
    let bytes: &[u8] = cast_slice(data);
    let buffer = buffer(gpu, bytes.len() as u64, usage);
    gpu.queue.write_buffer(&buffer, 0, bytes);
    buffer
}
