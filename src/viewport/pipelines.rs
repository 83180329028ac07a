//! The programs that draw a picture, compiled once.

use super::gpu_types::{DisplayUniform, FrameUniform, OutlineUniform, PointsUniform};
use super::targets;
use std::mem::size_of;
use wgpu::{BindingType, BufferBindingType, ShaderStages};

/// A shader of photons, with what these share.
macro_rules! photon_shader {
    ($name:literal) => {
        concat!(
            include_str!("../../shaders/common.wgsl"),
            include_str!("../../shaders/photon.wgsl"),
            include_str!(concat!("../../shaders/", $name, ".wgsl"))
        )
    };
}

/// Every shader with the part that all share, as it is compiled: name and source.
pub const SHADERS: [(&str, &str); 6] = [
    ("surface", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/surface.wgsl"))),
    ("outline", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/outline.wgsl"))),
    ("splat", photon_shader!("splat")),
    ("photons", photon_shader!("photons")),
    ("lines", concat!(include_str!("../../shaders/common.wgsl"), include_str!("../../shaders/lines.wgsl"))),
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
    /// `Frame`, `Points`, photons, depths, photons shown.
    pub splat_layout: wgpu::BindGroupLayout,
    pub splat: wgpu::ComputePipeline,
    /// `Frame`, `Points`, photons, photons shown.
    pub photon_layout: wgpu::BindGroupLayout,
    pub photons: wgpu::RenderPipeline,
    /// `Frame`, `Points`, marks.
    pub mark_layout: wgpu::BindGroupLayout,
    pub marks: wgpu::RenderPipeline,
    /// `Frame`, lines.
    pub line_layout: wgpu::BindGroupLayout,
    pub lines: wgpu::RenderPipeline,
    /// Lines before everything else.
    pub ways: wgpu::RenderPipeline,
    /// `Display`, radiance, overlay.
    pub present_layout: wgpu::BindGroupLayout,
    pub present: wgpu::RenderPipeline,
}

impl Pipelines {
    pub fn new(device: &wgpu::Device, output_format: wgpu::TextureFormat) -> Self {
        let [surface, outline, splat, photons, lines, present] =
            SHADERS.map(|(name, source)| Program::new(device, name, source));
        let surface_layout = surface.layout(device, &[uniform::<FrameUniform>(), storage(), storage(), storage()]);
        let outline_layout = outline.layout(device, &[uniform::<FrameUniform>(), uniform::<OutlineUniform>()]);
        let points = [uniform::<FrameUniform>(), uniform::<PointsUniform>(), storage()];
        let [frame, look, photon] = points;
        let splat_layout = splat.compute_layout(device, &[frame, look, photon, depth_texture(), written_storage()]);
        let photon_layout = photons.layout(device, &[frame, look, photon, storage()]);
        let mark_layout = photons.layout(device, &points);
        let line_layout = lines.layout(device, &[uniform::<FrameUniform>(), storage()]);
        let present_layout = present.layout(device, &[uniform::<DisplayUniform>(), texture(), texture()]);

        let picture_targets = [targets::RADIANCE, targets::OVERLAY].map(|format| Some(format.into()));
        let outline_targets = [
            Some(wgpu::ColorTargetState { write_mask: wgpu::ColorWrites::empty(), ..targets::RADIANCE.into() }),
            Some(wgpu::ColorTargetState { write_mask: wgpu::ColorWrites::GREEN, ..targets::OVERLAY.into() }),
        ];
        let plain = Drawing {
            vertex: "vertex",
            fragment: "fragment",
            targets: &picture_targets,
            depth: Depth::Test,
            cull: false,
        };
        let constant = Drawing { fragment: "fragment_constant", depth: Depth::Write, cull: true, ..plain };
        let smooth = Drawing { fragment: "fragment_smooth", ..constant };
        let outlines = Drawing { targets: &outline_targets, ..plain };
        let in_front = Drawing { depth: Depth::Ignore, ..plain };
        let mark = Drawing { vertex: "vertex_mark", fragment: "fragment_mark", ..in_front };
        let screen = Drawing { targets: &[Some(output_format.into())], depth: Depth::None, ..plain };
        Self {
            surface_constant: surface.pipeline(device, &surface_layout, &constant),
            surface_smooth: surface.pipeline(device, &surface_layout, &smooth),
            outline: outline.pipeline(device, &outline_layout, &outlines),
            splat: splat.compute_pipeline(device, &splat_layout, "splat"),
            photons: photons.pipeline(device, &photon_layout, &in_front),
            marks: photons.pipeline(device, &mark_layout, &mark),
            lines: lines.pipeline(device, &line_layout, &plain),
            ways: lines.pipeline(device, &line_layout, &in_front),
            present: present.pipeline(device, &present_layout, &screen),
            surface_layout,
            outline_layout,
            splat_layout,
            photon_layout,
            mark_layout,
            line_layout,
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
    vertex: &'static str,
    fragment: &'static str,
    targets: &'a [Option<wgpu::ColorTargetState>],
    depth: Depth,
    cull: bool,
}

/// What is done about depth.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Depth {
    /// What is farther is hidden, now and later.
    Write,
    /// What is farther is hidden.
    Test,
    /// Nothing hides it.
    Ignore,
    /// There is no depth, and a single sample a pixel.
    None,
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
        self.layout_for(device, ShaderStages::VERTEX_FRAGMENT, bindings)
    }

    fn compute_layout(&self, device: &wgpu::Device, bindings: &[BindingType]) -> wgpu::BindGroupLayout {
        self.layout_for(device, ShaderStages::COMPUTE, bindings)
    }

    fn layout_for(
        &self,
        device: &wgpu::Device,
        visibility: ShaderStages,
        bindings: &[BindingType],
    ) -> wgpu::BindGroupLayout {
        let entry = |(binding, ty): (usize, &BindingType)| wgpu::BindGroupLayoutEntry {
            binding: binding as u32,
            visibility,
            ty: *ty,
            count: None,
        };
        let entries: Vec<_> = bindings.iter().enumerate().map(entry).collect();
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(self.name), entries: &entries })
    }

    fn pipeline_layout(&self, device: &wgpu::Device, bindings: &wgpu::BindGroupLayout) -> wgpu::PipelineLayout {
        device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.name),
            bind_group_layouts: &[Some(bindings)],
            immediate_size: 0,
        })
    }

    fn compute_pipeline(
        &self,
        device: &wgpu::Device,
        bindings: &wgpu::BindGroupLayout,
        entry: &'static str,
    ) -> wgpu::ComputePipeline {
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(self.name),
            layout: Some(&self.pipeline_layout(device, bindings)),
            module: &self.module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    }

    fn pipeline(
        &self,
        device: &wgpu::Device,
        bindings: &wgpu::BindGroupLayout,
        drawing: &Drawing<'_>,
    ) -> wgpu::RenderPipeline {
        let layout = self.pipeline_layout(device, bindings);
        let nearer = if drawing.depth == Depth::Ignore {
            wgpu::CompareFunction::Always
        } else {
            wgpu::CompareFunction::GreaterEqual
        };
        let depth_stencil = (drawing.depth != Depth::None).then(|| wgpu::DepthStencilState {
            format: targets::DEPTH,
            depth_write_enabled: Some(drawing.depth == Depth::Write),
            depth_compare: Some(nearer),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        });
        let samples = if depth_stencil.is_some() { targets::SAMPLES } else { 1 };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.name),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some(drawing.vertex),
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
    storage_that(true)
}

fn written_storage() -> BindingType {
    storage_that(false)
}

fn storage_that(read_only: bool) -> BindingType {
    BindingType::Buffer {
        ty: BufferBindingType::Storage { read_only },
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn depth_texture() -> BindingType {
    BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Depth,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: true,
    }
}

fn texture() -> BindingType {
    BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}
