//! The three programs that draw a picture, compiled once.

use super::gpu_types::{DisplayUniform, FrameUniform, OutlineUniform};
use super::targets;
use std::mem::size_of;
use wgpu::{BindingType, BufferBindingType, ShaderStages};

/// Every shader with the part that all share, as it is compiled: name and source.
pub const SHADERS: [(&str, &str); 3] = [
    ("surface", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/surface.wgsl"))),
    ("outline", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/outline.wgsl"))),
    ("present", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/present.wgsl"))),
];

/// Programs and the layouts of what they read.
pub struct Pipelines {
    /// `Frame`, positions, elements, values.
    pub surface_layout: wgpu::BindGroupLayout,
    pub surface_constant: wgpu::RenderPipeline,
    pub surface_smooth: wgpu::RenderPipeline,
    /// `Frame`, `Outline`.
    pub outline_layout: wgpu::BindGroupLayout,
    pub outline: wgpu::RenderPipeline,
    /// `Display`, radiance, overlay.
    pub present_layout: wgpu::BindGroupLayout,
    pub present: wgpu::RenderPipeline,
}

impl Pipelines {
    pub fn new(device: &wgpu::Device, output_format: wgpu::TextureFormat) -> Self {
        let [surface, outline, present] = SHADERS.map(|(name, source)| Program::new(device, name, source));
        let surface_layout = surface.layout(device, &[uniform::<FrameUniform>(), storage(), storage(), storage()]);
        let outline_layout = outline.layout(device, &[uniform::<FrameUniform>(), uniform::<OutlineUniform>()]);
        let present_layout = present.layout(device, &[uniform::<DisplayUniform>(), texture(), texture()]);

        let surface_targets = [targets::RADIANCE, targets::OVERLAY].map(|format| Some(format.into()));
        let outline_targets = [
            Some(wgpu::ColorTargetState { write_mask: wgpu::ColorWrites::empty(), ..targets::RADIANCE.into() }),
            Some(wgpu::ColorTargetState { write_mask: wgpu::ColorWrites::GREEN, ..targets::OVERLAY.into() }),
        ];
        let constant =
            Drawing { fragment: "fragment_constant", targets: &surface_targets, depth: Some(true), cull: true };
        let smooth = Drawing { fragment: "fragment_smooth", ..constant };
        let lines = Drawing { fragment: "fragment", targets: &outline_targets, depth: Some(false), cull: false };
        let screen = Drawing { targets: &[Some(output_format.into())], depth: None, ..lines };
        Self {
            surface_constant: surface.pipeline(device, &surface_layout, &constant),
            surface_smooth: surface.pipeline(device, &surface_layout, &smooth),
            outline: outline.pipeline(device, &outline_layout, &lines),
            present: present.pipeline(device, &present_layout, &screen),
            surface_layout,
            outline_layout,
            present_layout,
        }
    }
}

/// A bind group whose bindings are `resources`, in order.
pub fn bind(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let numbered = resources.iter().cloned().enumerate();
    let entries: Vec<_> =
        numbered.map(|(binding, resource)| wgpu::BindGroupEntry { binding: binding as u32, resource }).collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

/// How a program meets its targets.
#[derive(Clone, Copy)]
struct Drawing<'a> {
    fragment: &'static str,
    targets: &'a [Option<wgpu::ColorTargetState>],
    /// Whether it writes depth; `None` where there is no depth and a single sample a pixel.
    depth: Option<bool>,
    cull: bool,
}

struct Program {
    name: &'static str,
    module: wgpu::ShaderModule,
}

impl Program {
    fn new(device: &wgpu::Device, name: &'static str, source: &'static str) -> Self {
        let source = wgpu::ShaderSource::Wgsl(source.into());
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(name), source });
        Self { name, module }
    }

    fn layout(&self, device: &wgpu::Device, bindings: &[BindingType]) -> wgpu::BindGroupLayout {
        let entry = |(binding, ty): (usize, &BindingType)| wgpu::BindGroupLayoutEntry {
            binding: binding as u32,
            visibility: ShaderStages::VERTEX_FRAGMENT,
            ty: *ty,
            count: None,
        };
        let entries: Vec<_> = bindings.iter().enumerate().map(entry).collect();
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(self.name), entries: &entries })
    }

    fn pipeline(
        &self,
        device: &wgpu::Device,
        bindings: &wgpu::BindGroupLayout,
        drawing: &Drawing<'_>,
    ) -> wgpu::RenderPipeline {
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.name),
            bind_group_layouts: &[Some(bindings)],
            immediate_size: 0,
        });
        let depth_stencil = drawing.depth.map(|write| wgpu::DepthStencilState {
            format: targets::DEPTH,
            depth_write_enabled: Some(write),
            depth_compare: Some(wgpu::CompareFunction::GreaterEqual),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        });
        let samples = if depth_stencil.is_some() { targets::SAMPLES } else { 1 };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.name),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some("vertex"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: drawing.cull.then_some(wgpu::Face::Back),
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil,
            multisample: wgpu::MultisampleState { count: samples, ..wgpu::MultisampleState::default() },
            fragment: Some(wgpu::FragmentState {
                module: &self.module,
                entry_point: Some(drawing.fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: drawing.targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

fn uniform<T>() -> BindingType {
    BindingType::Buffer {
        ty: BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: wgpu::BufferSize::new(size_of::<T>() as u64),
    }
}

fn storage() -> BindingType {
    BindingType::Buffer {
        ty: BufferBindingType::Storage { read_only: true },
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn texture() -> BindingType {
    BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}
