//! A list on the graphics device that grows.

use super::Gpu;
use super::buffers::buffer;
use super::pipelines::bind;
use bytemuck::{Pod, cast_slice};
use std::mem::size_of;
use wgpu::BufferUsages;

/// Records in a storage buffer with room for more, and the bind group that ends with it.
pub struct Records<T> {
    /// As uploaded; kept to move into a larger buffer.
    records: Vec<T>,
    /// Records that the buffer has room for.
    capacity: usize,
    buffer: wgpu::Buffer,
    layout: wgpu::BindGroupLayout,
    /// What is bound before the records.
    before: Vec<wgpu::Buffer>,
    group: wgpu::BindGroup,
}

impl<T: Pod> Records<T> {
    /// Without a record. The bindings of `layout` are the buffers `before` and then the records.
    pub fn new(gpu: &Gpu, layout: &wgpu::BindGroupLayout, before: &[&wgpu::Buffer]) -> Self {
        let before: Vec<wgpu::Buffer> = before.iter().copied().cloned().collect();
        let buffer = buffer(gpu, 0, BufferUsages::STORAGE);
        let group = group(gpu, layout, &before, &buffer);
        Self { records: Vec::new(), capacity: 0, buffer, layout: layout.clone(), before, group }
    }

    /// How many records one such list can have at most.
    pub fn limit(gpu: &Gpu) -> usize {
        let limits = gpu.device.limits();
        let bytes = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        (bytes / size_of::<T>() as u64) as usize
    }

    pub fn len(&self) -> u32 {
        self.records.len() as u32
    }

    pub fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    pub fn clear(&mut self) {
        self.records.clear();
    }

    /// Uploads more records; a buffer that has become too small is replaced by one that is twice as large.
    pub fn extend(&mut self, gpu: &Gpu, more: impl IntoIterator<Item = T>) {
        let mut first_new = self.records.len();
        self.records.extend(more);
        if self.records.len() > self.capacity {
            self.capacity = (2 * self.capacity).max(self.records.len()).min(Self::limit(gpu));
            self.buffer = buffer(gpu, (self.capacity * size_of::<T>()) as u64, BufferUsages::STORAGE);
            self.group = group(gpu, &self.layout, &self.before, &self.buffer);
            first_new = 0;
        }
        let offset = first_new * size_of::<T>();
        gpu.queue.write_buffer(&self.buffer, offset as u64, cast_slice(&self.records[first_new..]));
    }
}

fn group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    before: &[wgpu::Buffer],
    records: &wgpu::Buffer,
) -> wgpu::BindGroup {
    let resources: Vec<_> = before.iter().chain([records]).map(wgpu::Buffer::as_entire_binding).collect();
    bind(&gpu.device, layout, &resources)
}
