//! Pipelines of kernels, and bindings of their variables.

use std::collections::BTreeMap;

use wgpu::naga::ShaderStage;

use super::device::Gpu;
use crate::filter::{SamplerFilter, Wrap};
use crate::shader::{EntryPoint, Role, Shader, Variable};

/// A compiled pass.
#[derive(Clone, Debug)]
pub(super) enum Pipeline {
    Compute(wgpu::ComputePipeline),
    Render(wgpu::RenderPipeline),
}

/// Creates the layout of a group as the shader uses it, with the buffer of loop iterations if there is one.
pub(super) fn create_layout(
    gpu: &Gpu,
    shader: &Shader,
    entry: &EntryPoint,
    counted_at: Option<u32>,
) -> wgpu::BindGroupLayout {
    let visibility = match entry.stage {
        ShaderStage::Fragment => wgpu::ShaderStages::FRAGMENT,
        ShaderStage::Vertex => wgpu::ShaderStages::VERTEX,
        _ => wgpu::ShaderStages::COMPUTE,
    };
    let counted = counted_at.map(|binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: false },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    });
    let entries: Vec<wgpu::BindGroupLayoutEntry> = entry
        .variables
        .iter()
        .map(|index| (*index, &shader.variables[*index]))
        .map(|(index, variable)| wgpu::BindGroupLayoutEntry {
            binding: variable.binding,
            visibility,
            ty: match variable.role {
                Role::Uniform | Role::Block(_) => wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                Role::Read(texel) => wgpu::BindingType::Texture {
                    sample_type: texel.wgpu(entry.interpolated.contains(&index)),
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                Role::Write(format) => wgpu::BindingType::StorageTexture {
                    access: wgpu::StorageTextureAccess::WriteOnly,
                    format: format.wgpu(),
                    view_dimension: wgpu::TextureViewDimension::D2,
                },
                Role::Sampler(sampling) => {
                    wgpu::BindingType::Sampler(match sampling.interpolates() {
                        false => wgpu::SamplerBindingType::NonFiltering,
                        true => wgpu::SamplerBindingType::Filtering,
                    })
                }
            },
            count: None,
        })
        .chain(counted)
        .collect();
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(&entry.name),
            entries: &entries,
        })
}

/// A stage of a pipeline.
#[derive(Clone, Copy)]
pub(super) struct StageSource<'a> {
    pub layout: &'a wgpu::BindGroupLayout,
    pub module: &'a wgpu::ShaderModule,
    pub entry: &'a EntryPoint,
}

/// Compiles the kernel, or the fragment shader with its vertex stage.
pub(super) fn create_pipeline(
    gpu: &Gpu,
    stage: StageSource,
    vertex: Option<StageSource>,
    targets: &[wgpu::TextureFormat],
) -> Pipeline {
    let StageSource { module, entry, .. } = stage;
    let stages = [Some(stage), vertex];
    let layouts = stages.into_iter().flatten();
    let layouts: Vec<_> = layouts.map(|stage| Some(stage.layout)).collect();
    let layout = gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&entry.name),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        });
    if entry.is_fragment() {
        return Pipeline::Render(create_render_pipeline(gpu, &layout, stage, vertex, targets));
    }
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(&entry.name),
            layout: Some(&layout),
            module,
            entry_point: Some(&entry.name),
            compilation_options: Default::default(),
            cache: None,
        });
    Pipeline::Compute(pipeline)
}

/// Vertices of a triangle over the whole picture, with texture coordinates from the top left at each location that the fragment
/// shader reads.
fn write_triangle(locations: &[u32]) -> String {
    let coordinates = locations
        .iter()
        .map(|location| format!("@location({location}) place_{location}: vec2<f32>, "));
    let coordinates: String = coordinates.collect();
    let values = ", place".repeat(locations.len());
    format!(
        "struct Corner {{ @builtin(position) position: vec4<f32>, {coordinates}}}
@vertex
fn triangle(@builtin(vertex_index) index: u32) -> Corner {{
    let place = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u));
    return Corner(vec4<f32>(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y, 0.0, 1.0){values});
}}
"
    )
}

fn create_render_pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    StageSource { module, entry, .. }: StageSource,
    vertex: Option<StageSource>,
    targets: &[wgpu::TextureFormat],
) -> wgpu::RenderPipeline {
    let triangle;
    let (corners, corner) = match vertex {
        Some(vertex) => (vertex.module, &vertex.entry.name[..]),
        None => {
            triangle = gpu
                .device
                .create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some("triangle"),
                    source: wgpu::ShaderSource::Wgsl(write_triangle(&entry.inputs).into()),
                });
            (&triangle, "triangle")
        }
    };
    let targets: Vec<_> = (targets.iter())
        .map(|format| {
            Some(wgpu::ColorTargetState {
                format: *format,
                blend: None,
                write_mask: wgpu::ColorWrites::ALL,
            })
        })
        .collect();
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(&entry.name),
            layout: Some(layout),
            vertex: wgpu::VertexState {
                module: corners,
                entry_point: Some(corner),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(&entry.name),
                compilation_options: Default::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
}

/// Creates the samplers of the kernel, by the index of their variables.
pub(super) fn create_samplers(
    gpu: &Gpu,
    shader: &Shader,
    entry: &EntryPoint,
) -> BTreeMap<usize, wgpu::Sampler> {
    let mut samplers = BTreeMap::new();
    for index in &entry.variables {
        let Role::Sampler(sampling) = shader.variables[*index].role else {
            continue;
        };
        let wrap = match sampling.wrap {
            Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
            Wrap::Repeat => wgpu::AddressMode::Repeat,
            Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        };
        let filter = match sampling.filter {
            SamplerFilter::Nearest => wgpu::FilterMode::Nearest,
            SamplerFilter::Linear => wgpu::FilterMode::Linear,
        };
        let mip_filter = match sampling.mip_filter {
            SamplerFilter::Nearest => wgpu::MipmapFilterMode::Nearest,
            SamplerFilter::Linear => wgpu::MipmapFilterMode::Linear,
        };
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some(&entry.name),
            address_mode_u: wrap,
            address_mode_v: wrap,
            mag_filter: filter,
            min_filter: filter,
            mipmap_filter: mip_filter,
            ..Default::default()
        });
        samplers.insert(*index, sampler);
    }
    samplers
}

/// Binds each variable of a group to its resource, and the buffer of loop iterations if there is one.
pub(super) fn create_bind_group<'r>(
    gpu: &Gpu,
    shader: &Shader,
    entry: &EntryPoint,
    layout: &wgpu::BindGroupLayout,
    counted: Option<wgpu::BindGroupEntry<'r>>,
    resource: impl Fn(usize, &Variable) -> wgpu::BindingResource<'r>,
) -> wgpu::BindGroup {
    let entries: Vec<wgpu::BindGroupEntry> = entry
        .variables
        .iter()
        .map(|index| (*index, &shader.variables[*index]))
        .map(|(index, variable)| wgpu::BindGroupEntry {
            binding: variable.binding,
            resource: resource(index, variable),
        })
        .chain(counted)
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(&entry.name),
        layout,
        entries: &entries,
    })
}
