//! Passes of one filter, settings and size, bound to their textures and ready to be dispatched.

use std::collections::BTreeMap;

use half::f16;

use super::binding::create_bind_group;
use super::dependence::{find_color_dependent, find_noise_dependent};
use super::device::Gpu;
use super::dispatch::Dispatch;
use super::kernels::Specialised;
use super::levels::{Levels, WrittenLevels};
use super::loop_counts::LoopCounts;
use super::place::Place;
use super::targets::Targets;
use super::transfer::Target;
use super::uniforms::{FrameValues, Uniforms};
use crate::shader::{Role, UniformBlock};
use crate::{Filter, FilterError, Format, Pass, Repeat, Settings};

/// Everything of a filter that lives on the GPU.
#[derive(Debug)]
pub(super) struct BoundPasses {
    /// Dispatches in the order in which they run.
    pub dispatches: Vec<Dispatch>,
    /// Longest time that each may take, in seconds.
    pub time_limit: f64,
    /// Loop iterations of every dispatch, if they are counted.
    pub loop_counts: Option<LoopCounts>,
    /// Content of the output until a pass has written it.
    pub mark: Target,
    targets: Targets,
    uniforms: Uniforms,
    /// Values of the parameters, and of the convention, by name.
    values: BTreeMap<String, f64>,
}

impl BoundPasses {
    /// Makes textures and uniforms, and binds every pass to them.
    pub fn new(
        gpu: &Gpu,
        kernels: &Specialised,
        settings: &Settings,
        size: [u32; 2],
    ) -> Result<Self, FilterError> {
        let Specialised { filter, passes, .. } = kernels;
        let values = settings.list_numbers(filter);
        let place_of = |pass| Place {
            filter: &filter.name,
            pass,
        };
        let mut targets = Targets::new(gpu, filter, settings, size)?;
        let times = |pass: &Pass| match &pass.repeat {
            Repeat::Times(times) => *times,
            Repeat::Parameter(name) => settings.count(name),
        };
        let count: u32 = filter.passes.iter().map(times).sum();
        let uniforms = gpu.catch_errors(place_of("uniforms"), || {
            Uniforms::new(gpu, &settings.encode(filter), count)
        })?;
        let loop_counts = (gpu.loop_limit)
            .map(|limit| {
                gpu.catch_errors(place_of("counts"), || LoopCounts::new(gpu, limit, count))
            })
            .transpose()?;
        let format = targets.current("output").format;
        let mark = gpu.catch_errors(place_of("textures"), || create_mark(gpu, size, format))?;
        let dependence = find_color_dependent(filter)
            .into_iter()
            .zip(find_noise_dependent(filter));
        let mut dispatches = Vec::new();
        let mut ready = WrittenLevels::default();
        let bound = filter.passes.iter().zip(passes).zip(dependence);
        for ((pass, compiled), (depends_on_color, depends_on_noise)) in bound {
            let entry = filter.entry_point(pass);
            let drawn = pass
                .shader
                .as_ref()
                .map_or(&[][..], |shader| &shader.targets);
            let over = drawn.first().map(String::as_str).or(pass.over.as_deref());
            let over = over.unwrap_or("output");
            let shader = filter.shader(pass);
            // Texels that one workgroup covers.
            let [group_width, group_height] = match pass.workgroup_per_texel || entry.is_fragment()
            {
                true => [1, 1],
                false => [entry.workgroup_size[0], entry.workgroup_size[1]],
            };
            let place = place_of(&pass.entry);
            let repeats = times(pass);
            for iteration in 0..repeats {
                let value = |name: &str| match name {
                    "iteration" => f64::from(iteration),
                    "iterations" => f64::from(repeats),
                    name => values[name],
                };
                let levels = Levels::find(filter, pass, &targets, &value);
                let levels = levels.map_err(|reason| place.refuse(reason))?;
                // A small texture has fewer levels.
                if !levels.are_there(&targets) {
                    continue;
                }
                let checked = levels.check(shader, entry, &targets, &ready);
                checked.map_err(|reason| place.refuse(reason))?;
                levels.add_to(&mut ready);
                let [width, height] = targets.size(over, levels.of_written(over));
                let frame = uniforms.bind_frame(dispatches.len());
                let counted =
                    (loop_counts.as_ref())
                        .zip(compiled.counted_at)
                        .map(|(counts, binding)| {
                            let resource = counts.bind_dispatch(dispatches.len());
                            wgpu::BindGroupEntry { binding, resource }
                        });
                let blocks = gpu.catch_errors(place, || create_blocks(gpu, &shader.blocks))?;
                let bind_group = gpu.catch_errors(place, || {
                    create_bind_group(
                        gpu,
                        shader,
                        entry,
                        &compiled.layout,
                        counted,
                        |index, variable| match variable.role {
                            Role::Uniform if variable.name == "frame" => frame.clone(),
                            Role::Uniform => uniforms.parameters.as_entire_binding(),
                            Role::Block(block) => blocks[block].1.as_entire_binding(),
                            Role::Sampler(_) => {
                                wgpu::BindingResource::Sampler(&compiled.samplers[&index])
                            }
                            Role::Read(_) | Role::Write(_) => wgpu::BindingResource::TextureView(
                                targets
                                    .of_variable(entry, variable)
                                    .view(levels.of_variable(index)),
                            ),
                        },
                    )
                })?;
                let vertex = filter.vertex_shader(pass).zip(filter.vertex_entry(pass));
                let vertex = vertex.zip(compiled.vertex_layout.as_ref());
                let corner_blocks = gpu.catch_errors(place, || {
                    vertex.map_or(Vec::new(), |((shader, _), _)| {
                        create_blocks(gpu, &shader.blocks)
                    })
                })?;
                let vertex_group = gpu.catch_errors(place, || {
                    vertex.map(|((shader, entry), layout)| {
                        create_bind_group(gpu, shader, entry, layout, None, |_, variable| {
                            match variable.role {
                                Role::Block(block) => corner_blocks[block].1.as_entire_binding(),
                                _ => unreachable!("a vertex stage has uniform blocks alone"),
                            }
                        })
                    })
                })?;
                let attachments = drawn.iter().map(|name| {
                    let target = targets.written(entry, name);
                    target.view(Some(levels.of_written(name))).clone()
                });
                dispatches.push(Dispatch {
                    entry: pass.entry.clone(),
                    pipeline: compiled.pipeline.clone(),
                    attachments: attachments.collect(),
                    copies: match entry.keeps_unwritten {
                        true => targets.list_exchanged(entry),
                        false => Vec::new(),
                    },
                    blocks: blocks.into_iter().chain(corner_blocks).collect(),
                    bind_group,
                    vertex_group,
                    workgroups: [width.div_ceil(group_width), height.div_ceil(group_height)],
                    bytes: sum_bytes(&targets, filter, pass, &levels),
                    depends_on_color,
                    depends_on_noise,
                    writes_output: entry.writes.contains("output"),
                    written: (entry.writes.iter())
                        .filter(|name| levels.of_written(name) == 0)
                        .map(|name| (name.clone(), targets.written(entry, name).clone()))
                        .collect(),
                    iteration,
                    iterations: repeats,
                });
                targets.exchange(entry);
            }
        }
        Ok(Self {
            dispatches,
            time_limit: filter.time_limit,
            loop_counts,
            mark,
            targets,
            uniforms,
            values,
        })
    }

    /// Copies the mark to the output if every pass that writes it is due. Pixels that keep the mark were not written.
    pub fn mark_output(&self, gpu: &Gpu, due: impl Fn(&Dispatch) -> bool) {
        let mut writers = self
            .dispatches
            .iter()
            .filter(|dispatch| dispatch.writes_output);
        if writers.all(due) {
            gpu.copy(&self.mark, self.target("output"));
        }
    }

    /// Finds a texture by name, as the last pass leaves it.
    pub fn target(&self, name: &str) -> &Target {
        self.targets.current(name)
    }

    /// Writes the uniform `frame` of every dispatch.
    pub fn upload_frame(&self, gpu: &Gpu, frame: FrameValues) {
        for (index, dispatch) in self.dispatches.iter().enumerate() {
            let frame = frame.of_run(dispatch.iteration, dispatch.iterations);
            self.uniforms.upload_frame(gpu, index, frame.uniform);
            for (block, buffer) in &dispatch.blocks {
                let bytes = block.encode(&|name| {
                    let of_rate = frame.value_of_rate(name);
                    match of_rate.or(self.values.get(name).copied()) {
                        Some(value) => value,
                        None => frame.value(name),
                    }
                });
                gpu.queue.write_buffer(buffer, 0, &bytes);
            }
        }
    }
}

/// Sums the bytes of the textures that a pass reads and of those that it writes, render targets included.
fn sum_bytes(targets: &Targets, filter: &Filter, pass: &Pass, levels: &Levels) -> u64 {
    let (shader, entry) = (filter.shader(pass), filter.entry_point(pass));
    let variables = (entry.variables.iter()).map(|index| (*index, &shader.variables[*index]));
    let bound = variables
        .filter(|(_, variable)| matches!(variable.role, Role::Read(_) | Role::Write(_)))
        .map(|(index, variable)| {
            let target = targets.of_variable(entry, variable);
            target.bytes(levels.of_variable(index))
        });
    let drawn = pass.shader.iter().flat_map(|shader| &shader.targets);
    let drawn = drawn.map(|name| {
        let level = levels.of_written(name);
        targets.written(entry, name).bytes(Some(level))
    });
    bound.chain(drawn).sum()
}

/// Creates a buffer for each uniform block.
fn create_blocks(gpu: &Gpu, blocks: &[UniformBlock]) -> Vec<(UniformBlock, wgpu::Buffer)> {
    let create = |block: &UniformBlock| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("block"),
            size: u64::from(block.bytes).next_multiple_of(16),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    };
    blocks
        .iter()
        .map(|block| (block.clone(), create(block)))
        .collect()
}

/// Returns every component of a pixel that no pass has written: a NaN that no arithmetic makes.
pub(super) fn mark_of(format: Format) -> f32 {
    match format {
        Format::Rgba16Float => f16::from_bits(0x7e5a).to_f32(),
        _ => f32::from_bits(0x7fd3_5a17),
    }
}

/// Creates a texture like the output that holds nothing but the mark.
fn create_mark(gpu: &Gpu, [width, height]: [u32; 2], format: Format) -> Target {
    let usage = wgpu::TextureUsages::empty();
    let target = gpu.create_target("mark", [width, height], 1, format, usage);
    let components = width as usize * height as usize * 4;
    gpu.upload(&target, &vec![mark_of(format); components]);
    target
}
