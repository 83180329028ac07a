//! The textures that a picture is drawn into.

use wgpu::{TextureFormat, TextureUsages};

/// Of radiance: half floats, whose range [`super::light`] scales the light into.
pub const RADIANCE: TextureFormat = TextureFormat::Rgba16Float;
/// Of the coverage by two kinds of lines.
pub const OVERLAY: TextureFormat = TextureFormat::Rg8Unorm;
pub const DEPTH: TextureFormat = TextureFormat::Depth32Float;
/// A pixel.
pub const SAMPLES: u32 = 4;

/// One set of textures of equal size.
pub struct Targets {
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Means over the samples of a pixel.
    pub radiance: wgpu::Texture,
    pub overlay: wgpu::Texture,
    radiance_samples: wgpu::TextureView,
    overlay_samples: wgpu::TextureView,
    pub depth_samples: wgpu::TextureView,
}

/// Which part of a picture a pass draws.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// All of it: the pass clears everything, and leaves the means when it ends.
    Whole,
    /// What others go on with: the pass clears everything, and leaves the samples.
    First,
    /// The rest: the pass leaves the means when it ends.
    Last,
}

impl Targets {
    pub fn new(device: &wgpu::Device, size: [u32; 2]) -> Self {
        let mean = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
        let samples = |format| {
            let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
            let texture = texture(device, size, format, SAMPLES, usage);
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        Self {
            size,
            radiance: texture(device, size, RADIANCE, 1, mean),
            overlay: texture(device, size, OVERLAY, 1, mean),
            radiance_samples: samples(RADIANCE),
            overlay_samples: samples(OVERLAY),
            depth_samples: samples(DEPTH),
        }
    }

    /// Begins a pass over all targets.
    pub fn begin<'a>(&self, encoder: &'a mut wgpu::CommandEncoder, part: Part) -> wgpu::RenderPass<'a> {
        let [radiance, overlay] = [&self.radiance, &self.overlay].map(view);
        let store = if part == Part::First { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard };
        let is_fresh = part != Part::Last;
        let colour = |view, resolve_target| {
            let load = if is_fresh { wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT) } else { wgpu::LoadOp::Load };
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: Some(resolve_target).filter(|_| part != Part::First),
                ops: wgpu::Operations { load, store },
            })
        };
        // Depth is reversed: 0 is at infinity.
        let load = if is_fresh { wgpu::LoadOp::Clear(0.0) } else { wgpu::LoadOp::Load };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[colour(&self.radiance_samples, &radiance), colour(&self.overlay_samples, &overlay)],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.depth_samples,
                depth_ops: Some(wgpu::Operations { load, store }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        })
    }
}

/// All of a texture.
pub fn view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// An uninitialised texture of `size` pixels.
pub fn texture(
    device: &wgpu::Device,
    size: [u32; 2],
    format: TextureFormat,
    sample_count: u32,
    usage: TextureUsages,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}
