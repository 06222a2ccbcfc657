//! The passes of one filter, settings and size, compiled and bound: what a run only has to dispatch.

use std::collections::{BTreeMap, BTreeSet};

use super::adapter::Gpu;
use super::shader::{EntryPoint, Role, Shader};
use super::transfer::{Place, Target};
use crate::wiring::written;
use crate::{Filter, FilterError, Format, Pass, Repeat, Settings};

/// The uniform `frame`: the WGSL struct `Frame` of common.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct FrameUniform {
    pub size: [i32; 2],
    pub exposure: f32,
    pub frame_index: u32,
    pub iteration: u32,
    pub iterations: u32,
}

/// Everything of a filter that lives on the GPU.
#[derive(Debug)]
pub(super) struct Plan {
    /// In the order in which they run.
    pub steps: Vec<Step>,
    targets: Targets,
    frames: wgpu::Buffer,
}

/// One dispatch.
#[derive(Debug)]
pub(super) struct Step {
    pub entry: String,
    pub pipeline: wgpu::ComputePipeline,
    pub bind_group: wgpu::BindGroup,
    pub workgroups: [u32; 2],
    /// Whether its result changes with the colour image.
    pub depends_on_color: bool,
    iteration: u32,
    iterations: u32,
}

/// Textures by name. One that a pass both reads and writes has two copies, and the first is the one to read.
#[derive(Debug)]
struct Targets(BTreeMap<String, Vec<Target>>);

impl Plan {
    pub fn new(
        gpu: &Gpu,
        filter: &Filter,
        settings: &Settings,
        size: [u32; 2],
    ) -> Result<Self, FilterError> {
        let place = |pass| Place {
            filter: &filter.name,
            pass,
        };
        let mut targets = gpu.guarded(place("textures"), || {
            Targets::new(gpu, filter, settings, size)
        })?;
        let module = gpu.guarded(place("kernels"), || {
            gpu.device
                .create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some(&filter.name),
                    source: wgpu::ShaderSource::Wgsl(filter.shader.source.as_str().into()),
                })
        })?;
        let times = |pass: &Pass| match &pass.repeat {
            Repeat::Times(times) => *times,
            Repeat::Parameter(name) => settings.count(name),
        };
        let dispatches: u32 = filter.passes.iter().map(times).sum();
        let uniforms = gpu.guarded(place("uniforms"), || {
            Uniforms::new(gpu, &settings.bytes(filter), dispatches)
        })?;
        let colored = color_dependent(filter);
        let mut steps = Vec::new();
        for (pass, depends_on_color) in filter.passes.iter().zip(colored) {
            let entry = entry_point(filter, pass);
            let over = pass.over.as_deref().unwrap_or("output");
            let over = targets.current(over).texture.size();
            let [group_width, group_height, _] = entry.workgroup_size;
            let place = place(&pass.entry);
            let (layout, pipeline) = gpu.guarded(place, || {
                let layout = layout(gpu, &filter.shader, entry);
                let pipeline = pipeline(gpu, &layout, &module, entry);
                (layout, pipeline)
            })?;
            let iterations = times(pass);
            for iteration in 0..iterations {
                let frame = uniforms.frame(steps.len());
                let bind_group = gpu.guarded(place, || {
                    let resource = |name: &str, role| match (name, role) {
                        ("frame", _) => frame.clone(),
                        ("parameters", _) => uniforms.parameters.as_entire_binding(),
                        (name, role) => targets.bind(&filter.shader, entry, name, role),
                    };
                    bind_group(gpu, &filter.shader, entry, &layout, resource)
                })?;
                steps.push(Step {
                    entry: pass.entry.clone(),
                    pipeline: pipeline.clone(),
                    bind_group,
                    workgroups: [
                        over.width.div_ceil(group_width),
                        over.height.div_ceil(group_height),
                    ],
                    depends_on_color,
                    iteration,
                    iterations,
                });
                targets.exchange(&filter.shader, entry);
            }
        }
        Ok(Self {
            steps,
            targets,
            frames: uniforms.frames,
        })
    }

    /// A texture by name, as the last pass leaves it.
    pub fn target(&self, name: &str) -> &Target {
        self.targets.current(name)
    }

    /// Writes the uniform `frame` of every dispatch.
    pub fn upload_frame(&self, gpu: &Gpu, frame: FrameUniform) {
        let stride = frame_stride(gpu);
        for (index, step) in self.steps.iter().enumerate() {
            let frame = FrameUniform {
                iteration: step.iteration,
                iterations: step.iterations,
                ..frame
            };
            let offset = index as u64 * stride;
            gpu.queue
                .write_buffer(&self.frames, offset, bytemuck::bytes_of(&frame));
        }
    }
}

impl Targets {
    fn new(gpu: &Gpu, filter: &Filter, settings: &Settings, size: [u32; 2]) -> Self {
        let mut targets = BTreeMap::new();
        for (name, format) in [
            ("color", Format::Rgba32Float),
            ("velocity", Format::Rg32Float),
            ("depth", Format::R32Float),
            ("output", Format::Rgba32Float),
        ] {
            let target = gpu.target(name, size[0], size[1], format);
            targets.insert(name.to_owned(), vec![target]);
        }
        for texture in &filter.textures {
            let divisor = texture.divided_by.as_ref();
            let divisor = divisor.map_or(1, |parameter| settings.count(parameter));
            let [width, height] = size.map(|side| side.div_ceil(divisor));
            let exchanged = filter.passes.iter().any(|pass| {
                exchanged(&filter.shader, entry_point(filter, pass))
                    .contains(&texture.name.as_str())
            });
            let copies = if exchanged { 2 } else { 1 };
            let copies = (0..copies)
                .map(|_| gpu.target(&texture.name, width, height, texture.format))
                .collect();
            targets.insert(texture.name.clone(), copies);
        }
        Self(targets)
    }

    fn current(&self, name: &str) -> &Target {
        match self.0.get(name) {
            Some(copies) => &copies[0],
            None => panic!("the filter has no texture \"{name}\""),
        }
    }

    fn bind(
        &self,
        shader: &Shader,
        entry: &EntryPoint,
        variable: &str,
        role: Role,
    ) -> wgpu::BindingResource<'_> {
        let target = match role {
            Role::Write(_) => {
                let name = written(variable).unwrap_or(variable);
                match exchanged(shader, entry).contains(&name) {
                    true => &self.0[name][1],
                    false => self.current(name),
                }
            }
            _ => self.current(variable),
        };
        wgpu::BindingResource::TextureView(&target.view)
    }

    /// What the pass wrote becomes what the next one reads.
    fn exchange(&mut self, shader: &Shader, entry: &EntryPoint) {
        for name in exchanged(shader, entry) {
            let copies = self.0.get_mut(name);
            copies
                .expect("a checked kernel uses declared textures")
                .swap(0, 1);
        }
    }
}

struct Uniforms {
    parameters: wgpu::Buffer,
    /// One `frame` per dispatch, a stride apart.
    frames: wgpu::Buffer,
    stride: u64,
}

impl Uniforms {
    fn new(gpu: &Gpu, parameters: &[u8], dispatches: u32) -> Self {
        let buffer = |label, size| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let stride = frame_stride(gpu);
        let uniforms = Self {
            parameters: buffer(
                "parameters",
                parameters.len().next_multiple_of(16).max(16) as u64,
            ),
            frames: buffer("frame", stride * u64::from(dispatches)),
            stride,
        };
        gpu.queue.write_buffer(&uniforms.parameters, 0, parameters);
        uniforms
    }

    fn frame(&self, dispatch: usize) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.frames,
            offset: dispatch as u64 * self.stride,
            size: wgpu::BufferSize::new(size_of::<FrameUniform>() as u64),
        })
    }
}

fn frame_stride(gpu: &Gpu) -> u64 {
    let alignment = gpu.device.limits().min_uniform_buffer_offset_alignment;
    (size_of::<FrameUniform>() as u64).next_multiple_of(u64::from(alignment))
}

fn entry_point<'f>(filter: &'f Filter, pass: &Pass) -> &'f EntryPoint {
    let entry = filter.shader.entry_point(&pass.entry);
    entry.expect("a checked filter has the entry points of its passes")
}

/// Names of the textures that the kernel reads.
fn reads<'s>(shader: &'s Shader, entry: &EntryPoint) -> BTreeSet<&'s str> {
    let variables = entry.variables.iter().map(|v| &shader.variables[*v]);
    variables
        .filter(|variable| variable.role == Role::Read)
        .map(|variable| variable.name.as_str())
        .collect()
}

/// Names of the textures that the kernel writes.
fn writes<'s>(shader: &'s Shader, entry: &EntryPoint) -> BTreeSet<&'s str> {
    let variables = entry.variables.iter().map(|v| &shader.variables[*v]);
    variables
        .filter(|variable| matches!(variable.role, Role::Write(_)))
        .map(|variable| written(&variable.name).unwrap_or(&variable.name))
        .collect()
}

/// Names of the textures that the kernel both reads and writes.
fn exchanged<'s>(shader: &'s Shader, entry: &EntryPoint) -> Vec<&'s str> {
    let writes = writes(shader, entry);
    let reads = reads(shader, entry).into_iter();
    reads.filter(|name| writes.contains(name)).collect()
}

/// Per pass: whether what it writes depends on the colour image, by itself or through other passes.
fn color_dependent(filter: &Filter) -> Vec<bool> {
    let mut tainted = BTreeSet::from(["color", "output"]);
    loop {
        let known = tainted.len();
        let dependent: Vec<bool> = filter
            .passes
            .iter()
            .map(|pass| {
                let entry = entry_point(filter, pass);
                let writes = writes(&filter.shader, entry);
                let touched = &reads(&filter.shader, entry) | &writes;
                let dependent = !touched.is_disjoint(&tainted);
                if dependent {
                    tainted.extend(writes);
                }
                dependent
            })
            .collect();
        if tainted.len() == known {
            return dependent;
        }
    }
}

fn layout(gpu: &Gpu, shader: &Shader, entry: &EntryPoint) -> wgpu::BindGroupLayout {
    let entries: Vec<wgpu::BindGroupLayoutEntry> = entry
        .variables
        .iter()
        .map(|variable| &shader.variables[*variable])
        .map(|variable| wgpu::BindGroupLayoutEntry {
            binding: variable.binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: match variable.role {
                Role::Uniform => wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                Role::Read => wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                Role::Write(format) => wgpu::BindingType::StorageTexture {
                    access: wgpu::StorageTextureAccess::WriteOnly,
                    format: format.wgpu(),
                    view_dimension: wgpu::TextureViewDimension::D2,
                },
            },
            count: None,
        })
        .collect();
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(&entry.name),
            entries: &entries,
        })
}

fn pipeline(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    module: &wgpu::ShaderModule,
    entry: &EntryPoint,
) -> wgpu::ComputePipeline {
    let layout = gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(&entry.name),
            bind_group_layouts: &[Some(layout)],
            immediate_size: 0,
        });
    gpu.device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(&entry.name),
            layout: Some(&layout),
            module,
            entry_point: Some(&entry.name),
            compilation_options: Default::default(),
            cache: None,
        })
}

fn bind_group<'r>(
    gpu: &Gpu,
    shader: &Shader,
    entry: &EntryPoint,
    layout: &wgpu::BindGroupLayout,
    resource: impl Fn(&str, Role) -> wgpu::BindingResource<'r>,
) -> wgpu::BindGroup {
    let entries: Vec<wgpu::BindGroupEntry> = entry
        .variables
        .iter()
        .map(|variable| &shader.variables[*variable])
        .map(|variable| wgpu::BindGroupEntry {
            binding: variable.binding,
            resource: resource(&variable.name, variable.role),
        })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(&entry.name),
        layout,
        entries: &entries,
    })
}
