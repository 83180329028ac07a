//! Textures brought back from the graphics device.

use super::{Gpu, GpuError};
use std::sync::mpsc;

/// The texels of a texture of one sample a pixel, row by row from the top left, without the padding between rows.
///
/// # Errors
/// If the device fails.
pub fn read_texture(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Vec<u8>, GpuError> {
    let texel = texture.format().block_copy_size(None).expect("a colour format has one size of texel");
    let row = texture.width() * texel;
    let padded_row = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size: u64::from(padded_row) * u64::from(texture.height()),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded_row), rows_per_image: None };
    let target = wgpu::TexelCopyBufferInfo { buffer: &buffer, layout };
    encoder.copy_texture_to_buffer(texture.as_image_copy(), target, texture.size());
    gpu.queue.submit([encoder.finish()]);

    let (sender, mapped) = mpsc::channel();
    // The receiver outlives the poll below, which is when the answer comes.
    buffer.map_async(wgpu::MapMode::Read, .., move |result| drop(sender.send(result)));
    let failed = |cause: &dyn std::fmt::Display| GpuError::Failed(cause.to_string());
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| failed(&error))?;
    gpu.check()?;
    mapped.recv().map_err(|error| failed(&error))?.map_err(|error| failed(&error))?;
    let bytes = buffer.get_mapped_range(..).map_err(|error| failed(&error))?;
    Ok(bytes.chunks_exact(padded_row as usize).flat_map(|padded| &padded[..row as usize]).copied().collect())
}

/// The value of a half float that is not negative and finite (IEEE 754 binary16).
pub fn from_half(bits: u16) -> f32 {
    // The bits of the exponent and fraction in the place of those of a single, whose exponent is 112 further from 0.
    const REBIAS: f32 = f32::from_bits((127 + 112) << 23);
    f32::from_bits(u32::from(bits) << 13) * REBIAS
}

#[cfg(test)]
mod tests {
    use super::from_half;

    #[test]
    fn halves_have_the_values_of_their_standard() {
        // Zero, the smallest subnormal, the smallest normal, 1 and its neighbour, and the largest.
        let cases = [
            (0x0000, 0.0),
            (0x0001, 2f32.powi(-24)),
            (0x0400, 2f32.powi(-14)),
            (0x3c00, 1.0),
            (0x3c01, 1.0 + 2f32.powi(-10)),
            (0x7bff, 65504.0),
        ];
        for (bits, value) in cases {
            assert_eq!(from_half(bits), value);
        }
    }
}
