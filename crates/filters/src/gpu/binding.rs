//! Pipelines of kernels, and bindings of their variables.

use std::borrow::Cow;
use std::collections::BTreeMap;

use wgpu::naga::{Module, ScalarKind, ShaderStage, front};

use super::device::Gpu;
use crate::filter::Origin;
use crate::shader::{
    EntryPoint, Role, SamplerFilter, Sampling, Shader, Variable, Varying, Wrap,
    follow_interpolation,
};

/// A compiled pass.
#[derive(Clone, Debug)]
pub(super) enum Pipeline {
    Compute(wgpu::ComputePipeline),
    Render(wgpu::RenderPipeline),
}

/// A stage of a pass: a kernel, a fragment shader or its vertex stage.
#[derive(Clone, Debug)]
pub(super) struct CompiledStage {
    module: wgpu::ShaderModule,
    layout: wgpu::BindGroupLayout,
    /// Samplers by the index of their variables.
    pub samplers: BTreeMap<usize, wgpu::Sampler>,
    /// Binding of the buffer of loop iterations, if they are counted.
    counted_at: Option<u32>,
}

impl CompiledStage {
    /// Makes the layout of the stage's group, and its samplers.
    pub fn new(
        gpu: &Gpu,
        shader: &Shader,
        entry: &EntryPoint,
        module: wgpu::ShaderModule,
        counted_at: Option<u32>,
    ) -> Self {
        let used = entry.variables.iter();
        let samplers = used.filter_map(|index| match shader.variables[*index].role {
            Role::Sampler(sampling) => Some((*index, create_sampler(gpu, &entry.name, sampling))),
            _ => None,
        });
        Self {
            module,
            layout: create_layout(gpu, shader, entry, counted_at),
            samplers: samplers.collect(),
            counted_at,
        }
    }

    /// Binds each variable of the stage to its resource, and the buffer of loop iterations if they
    /// are counted.
    pub fn bind<'r>(
        &self,
        gpu: &Gpu,
        shader: &Shader,
        entry: &EntryPoint,
        counts: Option<wgpu::BindingResource<'r>>,
        resource: impl Fn(usize, &Variable) -> wgpu::BindingResource<'r>,
    ) -> wgpu::BindGroup {
        let counted = self.counted_at.zip(counts);
        let used = entry.variables.iter().map(|index| {
            let variable = &shader.variables[*index];
            (variable.binding, resource(*index, variable))
        });
        let entries: Vec<wgpu::BindGroupEntry> = (used.chain(counted))
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        gpu.device().create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&entry.name),
            layout: &self.layout,
            entries: &entries,
        })
    }
}

/// Creates the layout of a group as the shader uses it, with the buffer of loop iterations if there
/// is one.
fn create_layout(
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
    let buffer = |ty| wgpu::BindingType::Buffer {
        ty,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let counts = buffer(wgpu::BufferBindingType::Storage { read_only: false });
    let used = entry.variables.iter().map(|index| {
        let variable = &shader.variables[*index];
        let ty = match variable.role {
            Role::Block(block) => buffer(if shader.blocks[block].is_storage {
                wgpu::BufferBindingType::Storage { read_only: true }
            } else {
                wgpu::BufferBindingType::Uniform
            }),
            Role::Read(kind) => wgpu::BindingType::Texture {
                sample_type: find_sample_type(kind, entry.interpolated.contains(index)),
                view_dimension: wgpu::TextureViewDimension::D2,
                multisampled: false,
            },
            Role::Write(format) => wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                format: format.wgpu(),
                view_dimension: wgpu::TextureViewDimension::D2,
            },
            Role::Sampler(sampling) => wgpu::BindingType::Sampler(if sampling.interpolates() {
                wgpu::SamplerBindingType::Filtering
            } else {
                wgpu::SamplerBindingType::NonFiltering
            }),
        };
        (variable.binding, ty)
    });
    let entries: Vec<wgpu::BindGroupLayoutEntry> = used
        .chain(counted_at.map(|binding| (binding, counts)))
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty,
            count: None,
        })
        .collect();
    gpu.device()
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(&entry.name),
            entries: &entries,
        })
}

/// Returns what shaders read a texture as.
fn find_sample_type(kind: ScalarKind, filterable: bool) -> wgpu::TextureSampleType {
    match kind {
        ScalarKind::Uint => wgpu::TextureSampleType::Uint,
        ScalarKind::Sint => wgpu::TextureSampleType::Sint,
        _ => wgpu::TextureSampleType::Float { filterable },
    }
}

/// Creates the pipeline of a kernel, or of a fragment shader with its vertex stage if there is one.
/// `origin` is the corner where the texture coordinates of the program's own triangle begin.
pub(super) fn create_pipeline(
    gpu: &Gpu,
    stages: &[(CompiledStage, &EntryPoint)],
    targets: &[wgpu::TextureFormat],
    origin: Origin,
) -> Pipeline {
    let (stage, entry) = &stages[0];
    let layouts: Vec<_> = (stages.iter().map(|(stage, _)| Some(&stage.layout))).collect();
    let layout = gpu
        .device()
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&entry.name),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        });
    if entry.is_fragment() {
        return Pipeline::Render(create_render_pipeline(
            gpu, &layout, stages, targets, origin,
        ));
    }
    let pipeline = gpu
        .device()
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(&entry.name),
            layout: Some(&layout),
            module: &stage.module,
            entry_point: Some(&entry.name),
            compilation_options: Default::default(),
            cache: None,
        });
    Pipeline::Compute(pipeline)
}

/// Makes the vertex stage of a triangle over the whole picture. Each location that the fragment
/// shader reads gets texture coordinates from the origin, and then, as in Unreal, the place in clip
/// space, where +y is up in the picture.
pub(crate) fn make_triangle(read: &[Varying], origin: Origin) -> Module {
    let (mut members, mut values) = (String::new(), String::new());
    for varying in read {
        let location = varying.location;
        let (ty, parts) = match varying.count_floats() {
            Some(1) => ("f32", "x"),
            Some(2) => ("vec2<f32>", "xy"),
            Some(3) => ("vec3<f32>", "xyz"),
            _ => ("vec4<f32>", "xyzw"),
        };
        members += &format!("@location({location}) place_{location}: {ty}, ");
        values += &format!(", place.{parts}");
    }
    let up = match origin {
        Origin::TopLeft => "1.0 - 2.0 * uv.y",
        Origin::BottomLeft => "2.0 * uv.y - 1.0",
    };
    let text = format!(
        "struct Corner {{ @builtin(position) position: vec4<f32>, {members}}}
@vertex
fn triangle(@builtin(vertex_index) index: u32) -> Corner {{
    let uv = vec2<f32>(f32((index << 1u) & 2u), f32(index & 2u));
    let place = vec4<f32>(uv, 2.0 * uv.x - 1.0, {up});
    return Corner(vec4<f32>(place.z, 1.0 - 2.0 * uv.y, 0.0, 1.0){values});
}}
"
    );
    let mut triangle = front::wgsl::parse_str(&text).expect("the triangle is valid WGSL");
    follow_interpolation(&mut triangle, read);
    triangle
}

fn create_render_pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    stages: &[(CompiledStage, &EntryPoint)],
    targets: &[wgpu::TextureFormat],
    origin: Origin,
) -> wgpu::RenderPipeline {
    let (stage, entry) = &stages[0];
    let triangle;
    let (corners, corner) = match stages.get(1) {
        Some((vertex, entry)) => (&vertex.module, &entry.name[..]),
        None => {
            triangle = gpu
                .device()
                .create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some("triangle"),
                    source: wgpu::ShaderSource::Naga(Cow::Owned(make_triangle(
                        &entry.inputs,
                        origin,
                    ))),
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
    gpu.device()
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
                module: &stage.module,
                entry_point: Some(&entry.name),
                compilation_options: Default::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
}

fn create_sampler(gpu: &Gpu, label: &str, sampling: Sampling) -> wgpu::Sampler {
    let wrap = match sampling.wrap {
        Wrap::Clamp => wgpu::AddressMode::ClampToEdge,
        Wrap::Repeat => wgpu::AddressMode::Repeat,
        Wrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        Wrap::Border => wgpu::AddressMode::ClampToBorder,
    };
    let border =
        (sampling.wrap == Wrap::Border).then_some(wgpu::SamplerBorderColor::TransparentBlack);
    let filter = match sampling.filter {
        SamplerFilter::Nearest => wgpu::FilterMode::Nearest,
        SamplerFilter::Linear => wgpu::FilterMode::Linear,
    };
    let mip_filter = match sampling.mip_filter {
        SamplerFilter::Nearest => wgpu::MipmapFilterMode::Nearest,
        SamplerFilter::Linear => wgpu::MipmapFilterMode::Linear,
    };
    gpu.device().create_sampler(&wgpu::SamplerDescriptor {
        label: Some(label),
        address_mode_u: wrap,
        address_mode_v: wrap,
        mag_filter: filter,
        min_filter: filter,
        mipmap_filter: mip_filter,
        border_color: border,
        ..Default::default()
    })
}
