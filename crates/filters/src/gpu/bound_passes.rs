//! Passes of one filter, settings and size, bound to their textures and ready to be dispatched.

use std::collections::BTreeMap;

use half::f16;

use super::dependence::{Dependence, find_dependences};
use super::device::Gpu;
use super::dispatch::Dispatch;
use super::kernels::{Compiled, Specialised};
use super::levels::{Levels, WrittenLevels};
use super::loop_counts::LoopCounts;
use super::targets::Targets;
use super::transfer::Target;
use super::uniforms::FrameValues;
use super::waiting::Turn;
use crate::shader::{Role, UniformBlock, Variable};
use crate::{Filter, FilterError, Format, Pass, Settings};

/// Everything of a filter that is on the GPU.
#[derive(Debug)]
pub(super) struct BoundPasses {
    /// Dispatches in the order in which they run.
    pub dispatches: Vec<Dispatch>,
    /// Loop iterations of every dispatch, if they are counted.
    pub loop_counts: Option<LoopCounts>,
    /// Content of the output until a pass has written it: marks, or the colours if it is read, too.
    pub mark: Target,
    /// The copy of the output that the first pass finds.
    first_output: Target,
    targets: Targets,
    /// Values of the parameters by name.
    parameters: BTreeMap<String, f64>,
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
        let targets = Targets::new(gpu, filter, settings, size)?;
        let times = |pass: &Pass| settings.count(&pass.repeat);
        let count: u32 = filter.passes.iter().map(times).sum();
        let counts = (gpu.loop_limit).map(|limit| {
            gpu.catch_errors(filter.place("counts"), || {
                LoopCounts::new(gpu, limit, count)
            })
        });
        let format = targets.current("output").format;
        let first_output = targets.current("output").clone();
        let mark = gpu.catch_errors(filter.place("textures"), || create_mark(gpu, size, format))?;
        let mut binder = Binder {
            gpu,
            filter,
            values: settings.list_numbers(filter),
            targets,
            loop_counts: counts.transpose()?,
            ready: WrittenLevels::default(),
            dispatches: Vec::new(),
        };
        let dependences = find_dependences(filter);
        for ((pass, compiled), depends_on) in filter.passes.iter().zip(passes).zip(dependences) {
            binder.bind_pass(pass, compiled, times(pass), depends_on)?;
        }
        Ok(Self {
            dispatches: binder.dispatches,
            loop_counts: binder.loop_counts,
            mark,
            first_output,
            targets: binder.targets,
            parameters: settings.list_parameters(filter).collect(),
        })
    }

    /// Copies the mark to the output if every dispatch that writes it is wanted. Pixels that keep
    /// the mark were not written.
    pub fn mark_output(&self, gpu: &Gpu, turn: &mut Turn, is_wanted: impl Fn(&Dispatch) -> bool) {
        let mut writers = (self.dispatches.iter()).filter(|dispatch| dispatch.writes("output"));
        if writers.all(is_wanted) {
            gpu.copy(turn, &self.mark, &self.first_output);
        }
    }

    /// Finds a texture by name, as the last pass leaves it.
    pub fn target(&self, name: &str) -> &Target {
        self.targets.current(name)
    }

    /// Writes the uniform blocks of every dispatch.
    pub fn upload_frame(&self, gpu: &Gpu, frame: FrameValues) {
        for dispatch in &self.dispatches {
            let frame = frame.of_run(dispatch.iteration, dispatch.iterations);
            let value = |name: &str| match self.parameters.get(name) {
                Some(value) => *value,
                None => frame.value(name),
            };
            for (block, buffer) in &dispatch.blocks {
                gpu.queue().write_buffer(buffer, 0, &block.encode(&value));
            }
        }
    }
}

/// Passes of a filter, bound so far.
struct Binder<'a> {
    gpu: &'a Gpu,
    filter: &'a Filter,
    /// Values of the parameters, and of the convention, by name.
    values: BTreeMap<String, f64>,
    targets: Targets,
    loop_counts: Option<LoopCounts>,
    ready: WrittenLevels,
    dispatches: Vec<Dispatch>,
}

/// Bind groups of a dispatch, and its uniform blocks with their buffers.
type Groups = (Vec<wgpu::BindGroup>, Vec<(UniformBlock, wgpu::Buffer)>);

impl Binder<'_> {
    /// Binds every run of a pass.
    fn bind_pass(
        &mut self,
        pass: &Pass,
        compiled: &Compiled,
        iterations: u32,
        depends_on: Dependence,
    ) -> Result<(), FilterError> {
        let (gpu, filter) = (self.gpu, self.filter);
        let (shader, entry) = (filter.shader(pass), filter.entry_point(pass));
        let place = filter.place(&pass.entry);
        for iteration in 0..iterations {
            let value = |name: &str| match name {
                "iteration" => f64::from(iteration),
                "iterations" => f64::from(iterations),
                name => self.values[name],
            };
            let levels = Levels::find(filter, pass, &self.targets, &value);
            let levels = levels.map_err(|reason| place.refuse(reason))?;
            // A small texture has fewer levels.
            if !levels.are_there(&self.targets) {
                continue;
            }
            let ready = levels.write(shader, entry, &self.targets, &mut self.ready);
            ready.map_err(|reason| place.refuse(reason))?;
            let (groups, blocks) =
                gpu.catch_errors(place, || self.bind_stages(pass, compiled, &levels))?;
            let targets = &self.targets;
            let attachments = pass.list_targets().map(|name| {
                let target = targets.written(entry, name);
                target.view(Some(levels.of_written(name))).clone()
            });
            self.dispatches.push(Dispatch {
                entry: pass.entry.clone(),
                pipeline: compiled.pipeline.clone(),
                attachments: attachments.collect(),
                copies: if entry.keeps_unwritten {
                    targets.list_exchanged(entry)
                } else {
                    Vec::new()
                },
                blocks,
                groups,
                workgroups: count_workgroups(targets, filter, pass, &levels),
                bytes: sum_bytes(targets, filter, pass, &levels),
                depends_on_color: depends_on.color,
                depends_on_noise: depends_on.noise,
                written: (entry.writes.iter())
                    .filter(|name| levels.of_written(name) == 0)
                    .map(|name| (name.clone(), targets.written(entry, name).clone()))
                    .collect(),
                iteration,
                iterations,
            });
            self.targets.exchange(entry);
        }
        Ok(())
    }

    /// Binds the stages of a pass for the next dispatch.
    fn bind_stages(&self, pass: &Pass, compiled: &Compiled, levels: &Levels) -> Groups {
        let mut groups = Vec::new();
        let mut all_blocks = Vec::new();
        for (stage, (shader, entry)) in compiled.stages.iter().zip(self.filter.stages(pass)) {
            let blocks = create_blocks(self.gpu, &shader.blocks);
            let counts = self.loop_counts.as_ref();
            let counts = counts.map(|counts| counts.bind_dispatch(self.dispatches.len()));
            let resource = |index, variable: &Variable| match variable.role {
                Role::Block(block) => blocks[block].1.as_entire_binding(),
                Role::Sampler(_) => wgpu::BindingResource::Sampler(&stage.samplers[&index]),
                Role::Read(_) | Role::Write(_) => {
                    let target = self.targets.of_variable(entry, variable);
                    wgpu::BindingResource::TextureView(target.view(levels.of_variable(index)))
                }
            };
            groups.push(stage.bind(self.gpu, shader, entry, counts, resource));
            all_blocks.extend(blocks);
        }
        (groups, all_blocks)
    }
}

/// Counts the workgroups of a dispatch along x and y.
fn count_workgroups(targets: &Targets, filter: &Filter, pass: &Pass, levels: &Levels) -> [u32; 2] {
    let over = pass.list_targets().chain(&pass.over).next();
    let over = over.map_or("output", String::as_str);
    let entry = filter.entry_point(pass);
    let [width, height] = targets.size(over, levels.of_written(over));
    // Texels that one workgroup covers.
    let [x, y] = if pass.workgroup_per_texel || entry.is_fragment() {
        [1, 1]
    } else {
        [entry.workgroup_size[0], entry.workgroup_size[1]]
    };
    [width.div_ceil(x), height.div_ceil(y)]
}

/// Sums the bytes of the textures that a pass reads and of those that it writes, render targets
/// included.
fn sum_bytes(targets: &Targets, filter: &Filter, pass: &Pass, levels: &Levels) -> u64 {
    let (shader, entry) = (filter.shader(pass), filter.entry_point(pass));
    let variables = (entry.variables.iter()).map(|index| (*index, &shader.variables[*index]));
    let bound = variables
        .filter(|(_, variable)| matches!(variable.role, Role::Read(_) | Role::Write(_)))
        .map(|(index, variable)| {
            let target = targets.of_variable(entry, variable);
            target.bytes(levels.of_variable(index))
        });
    let attached = pass.list_targets().map(|name| {
        let level = levels.of_written(name);
        targets.written(entry, name).bytes(Some(level))
    });
    bound.chain(attached).sum()
}

/// Creates a buffer for each uniform block.
fn create_blocks(gpu: &Gpu, blocks: &[UniformBlock]) -> Vec<(UniformBlock, wgpu::Buffer)> {
    let create = |block: &UniformBlock| {
        let usage = if block.is_storage {
            wgpu::BufferUsages::STORAGE
        } else {
            wgpu::BufferUsages::UNIFORM
        };
        let usage = usage | wgpu::BufferUsages::COPY_DST;
        let bytes = block.buffer_bytes() as u64;
        (block.clone(), gpu.create_buffer("block", bytes, usage))
    };
    blocks.iter().map(create).collect()
}

/// Returns every component of a pixel that no pass has written: a NaN that no arithmetic makes.
pub(super) fn mark_of(format: Format) -> f32 {
    match format {
        Format::Rgba16Float => f16::from_bits(0x7e5a).to_f32(),
        _ => f32::from_bits(0x7fd3_5a17),
    }
}

/// Creates a texture like the output, filled with the mark.
fn create_mark(gpu: &Gpu, [width, height]: [u32; 2], format: Format) -> Target {
    let usage = wgpu::TextureUsages::empty();
    let target = gpu.create_target("mark", [width, height], 1, format, usage);
    let components = width as usize * height as usize * 4;
    gpu.upload(&target, &vec![mark_of(format); components]);
    target
}
