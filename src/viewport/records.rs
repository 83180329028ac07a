//! A list on the graphics device that grows.

use super::Gpu;
use super::buffers::buffer;
use bytemuck::{Pod, cast_slice};
use std::mem::size_of;
use wgpu::BufferUsages;

/// Records in a storage buffer with room for more.
pub struct Records<T> {
    /// As uploaded; kept to move into a larger buffer.
    records: Vec<T>,
    /// Records that the buffer has room for.
    capacity: usize,
    buffer: wgpu::Buffer,
}

impl<T: Pod> Records<T> {
    /// Without a record.
    pub fn new(gpu: &Gpu) -> Self {
        // Shaders want room for one.
        Self { records: Vec::new(), capacity: 1, buffer: buffer(gpu, size_of::<T>() as u64, BufferUsages::STORAGE) }
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

    /// Where they are. Another one after they have outgrown it.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
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
            first_new = 0;
        }
        let offset = first_new * size_of::<T>();
        gpu.queue.write_buffer(&self.buffer, offset as u64, cast_slice(&self.records[first_new..]));
    }
}
