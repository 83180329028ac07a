//! A world and its light in the memory of the graphics device.

use super::Gpu;
use super::gpu_types::{FrameUniform, OutlineUniform};
use super::pipelines::{Pipelines, bind};
use super::shading::{Quantity, Shading, Spread};
use crate::math::rgb::Rgb;
use crate::mesh::{Mesh, Patch};
use crate::world::World;
use bytemuck::{Pod, Zeroable, cast_slice};
use glam::{DMat4, DVec3, Vec3};
use std::f32::consts::PI;
use std::mem::size_of;
use std::sync::Arc;
use wgpu::BufferUsages;

/// The corner that a triangle does not have.
const NO_CORNER: u32 = u32::MAX;
/// On the screen, pixels.
const OUTLINE_WIDTH: f32 = 3.0;
/// The largest radiance is stored as at most this, by half floats that end at 65504.
const LARGEST_STORED: f32 = 32768.0;

/// The mesh, uploaded once, and the values of its elements, uploaded whenever others are shown.
pub struct WorldBuffers {
    pub world: Arc<World>,
    /// Corners 4 e + k of the triangles that elements are drawn as.
    pub indices: wgpu::Buffer,
    pub index_count: u32,
    /// What is stored for a radiance of 1 W/(m²·sr), or for a colour of 1: a power of two, which keeps half floats in range.
    pub stored_per_unit: f32,
    pub quantity: Quantity,
    /// Whether values belong to vertices, and not to elements.
    pub is_smooth: bool,
    /// Uploaded to stored values.
    scale: f32,
    /// A `FrameUniform`.
    pub frame: wgpu::Buffer,
    outline: wgpu::Buffer,
    element_values: Values,
    vertex_values: Values,
    outline_group: wgpu::BindGroup,
    pub units: Units,
    /// Values of vertices, kept to be filled again.
    smoothed: Vec<Rgb>,
}

/// r g b of each element or of each vertex, and what a surface's pipeline reads with it.
struct Values {
    buffer: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl WorldBuffers {
    /// A world in the dark.
    pub fn new(gpu: &Gpu, pipelines: &Pipelines, world: &Arc<World>) -> Self {
        let mesh = &world.mesh;
        let units = Units::new(world);
        let positions: Vec<Vec3> = mesh.vertices.iter().map(|&vertex| units.unit_from_world(vertex)).collect();
        let corners: Vec<[u32; 4]> = mesh.elements.iter().map(|element| padded(element.corners())).collect();
        let indices = triangle_indices(mesh);

        let storage = BufferUsages::STORAGE;
        let frame = buffer(gpu, size_of::<FrameUniform>() as u64, BufferUsages::UNIFORM);
        let outline = buffer(gpu, size_of::<OutlineUniform>() as u64, BufferUsages::UNIFORM);
        let [positions, corners] = [filled(gpu, &positions, storage), filled(gpu, &corners, storage)];
        let values = |count: usize| {
            let values = buffer(gpu, (count * size_of::<Rgb>()) as u64, storage);
            let buffers = [&frame, &positions, &corners, &values].map(wgpu::Buffer::as_entire_binding);
            let group = bind(&gpu.device, &pipelines.surface_layout, &buffers);
            Values { buffer: values, group }
        };
        let outline_resources = [&frame, &outline].map(wgpu::Buffer::as_entire_binding);
        Self {
            world: Arc::clone(world),
            index_count: indices.len() as u32,
            indices: filled(gpu, &indices, BufferUsages::INDEX),
            stored_per_unit: 1.0,
            quantity: Quantity::FluxDensity,
            is_smooth: false,
            scale: 1.0,
            element_values: values(mesh.elements.len()),
            vertex_values: values(mesh.vertices.len()),
            outline_group: bind(&gpu.device, &pipelines.outline_layout, &outline_resources),
            frame,
            outline,
            units,
            smoothed: Vec::new(),
        }
    }

    /// Uploads the values that are drawn from now on. Only memory is moved: no buffer is made.
    pub fn set_values(&mut self, gpu: &Gpu, shading: &Shading<'_>) {
        self.is_smooth = shading.spread != Spread::Constant;
        match shading.spread {
            Spread::Constant => gpu.queue.write_buffer(&self.element_values.buffer, 0, cast_slice(&shading.values)),
            Spread::Averaged => {
                self.world.mesh.smooth(&shading.values, &mut self.smoothed);
                gpu.queue.write_buffer(&self.vertex_values.buffer, 0, cast_slice(&self.smoothed));
            }
            Spread::OfVertices => gpu.queue.write_buffer(&self.vertex_values.buffer, 0, cast_slice(&shading.values)),
        }
        self.quantity = shading.quantity;
        let units_per_value = match shading.quantity {
            Quantity::FluxDensity => 1.0 / PI,
            Quantity::Colour => 1.0,
        };
        self.stored_per_unit = match shading.quantity {
            Quantity::FluxDensity => range_scale(&shading.values, units_per_value),
            // Colours are in range, and others than those of elements may be drawn.
            Quantity::Colour => 1.0,
        };
        self.scale = self.stored_per_unit * units_per_value;
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

    /// Uploads the outline of a patch and returns how many edges it has.
    pub fn set_outline(&self, gpu: &Gpu, patch: u32) -> u32 {
        let outline = self.units.outline(&self.world.mesh.patches[patch as usize]);
        gpu.queue.write_buffer(&self.outline, 0, bytemuck::bytes_of(&outline));
        outline.count
    }

    /// What the surfaces' pipeline reads.
    pub fn surface_group(&self) -> &wgpu::BindGroup {
        if self.is_smooth { &self.vertex_values.group } else { &self.element_values.group }
    }

    pub fn outline_group(&self) -> &wgpu::BindGroup {
        &self.outline_group
    }
}

/// Coordinates in which the scene is at the origin and has radius 1. The change is made in double precision, so that
/// single precision is enough for what is drawn, however large or far from the origin a scene is.
#[derive(Clone, Copy)]
pub struct Units {
    center: DVec3,
    /// World units in one.
    radius: f64,
}

impl Units {
    fn new(world: &World) -> Self {
        let radius = f64::from(world.bounds.radius());
        Self { center: world.bounds.center().as_dvec3(), radius: if radius > 0.0 { radius } else { 1.0 } }
    }

    pub fn unit_from_world(&self, position: Vec3) -> Vec3 {
        ((position.as_dvec3() - self.center) / self.radius).as_vec3()
    }

    /// Of the scene, m.
    pub fn radius(&self) -> f32 {
        self.radius as f32
    }

    fn world_from_unit(&self) -> DMat4 {
        DMat4::from_translation(self.center) * DMat4::from_scale(DVec3::splat(self.radius))
    }

    fn outline(&self, patch: &Patch) -> OutlineUniform {
        let mut outline = OutlineUniform { width: OUTLINE_WIDTH, ..OutlineUniform::zeroed() };
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

/// The power of two that takes the largest of some values as far up as half floats reach. A power of two, so that it
/// costs no precision.
fn range_scale(values: &[Rgb], units_per_value: f32) -> f32 {
    let largest = values.iter().fold(Rgb::ZERO, |a, &b| a.max(b)).max_element() * units_per_value;
    // Of the darkest light that there is, the quotient would leave the range of numbers.
    let exponent = (LARGEST_STORED.log2() - largest.log2()).floor().min(f32::MAX_EXP as f32 - 2.0);
    if largest > 0.0 { exponent.exp2() } else { 1.0 }
}

/// Never empty, because an empty buffer cannot be bound.
pub fn buffer(gpu: &Gpu, size: u64, usage: BufferUsages) -> wgpu::Buffer {
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
