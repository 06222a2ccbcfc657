//! Passes of one filter, settings and size, bound to their textures and ready to be dispatched.

use super::binding::create_bind_group;
use super::dependence::{find_color_dependent, find_noise_dependent};
use super::device::Gpu;
use super::kernels::Kernels;
use super::loop_counts::LoopCounts;
use super::place::Place;
use super::targets::Targets;
use super::transfer::Target;
use super::uniforms::{FrameUniform, Uniforms};
use crate::{FilterError, Format, Pass, Repeat, Settings};

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
}

/// One dispatch.
#[derive(Debug)]
pub(super) struct Dispatch {
    pub entry: String,
    pub pipeline: wgpu::ComputePipeline,
    pub bind_group: wgpu::BindGroup,
    pub workgroups: [u32; 2],
    /// Bytes of the textures that it reads and of those that it writes, each counted once and whole.
    pub bytes: u64,
    /// True if its result changes with the colour image.
    pub depends_on_color: bool,
    /// True if its result changes with the frame's index.
    pub depends_on_noise: bool,
    /// True if it writes the output.
    pub writes_output: bool,
    iteration: u32,
    iterations: u32,
}

impl Dispatch {
    /// Adds the dispatch to the commands of an encoder.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bind_group, &[]);
        let [x, y] = self.workgroups;
        pass.dispatch_workgroups(x, y, 1);
    }
}

impl BoundPasses {
    /// Makes textures and uniforms, and binds every pass to them.
    pub fn new(
        kernels: &Kernels,
        settings: &Settings,
        size: [u32; 2],
    ) -> Result<Self, FilterError> {
        let Kernels {
            gpu,
            filter,
            passes,
            counted_at,
        } = kernels;
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
        let mark = gpu.catch_errors(place_of("textures"), || create_mark(gpu, size))?;
        let dependence = find_color_dependent(filter)
            .into_iter()
            .zip(find_noise_dependent(filter));
        let mut dispatches = Vec::new();
        let bound = filter.passes.iter().zip(passes).zip(dependence);
        for ((pass, compiled), (depends_on_color, depends_on_noise)) in bound {
            let entry = filter.entry_point(pass);
            let over = pass.over.as_deref().unwrap_or("output");
            let over = targets.current(over).texture.size();
            // Texels that one workgroup covers.
            let [group_width, group_height] = match pass.workgroup_per_texel {
                true => [1, 1],
                false => [entry.workgroup_size[0], entry.workgroup_size[1]],
            };
            let place = place_of(&pass.entry);
            let repeats = times(pass);
            for iteration in 0..repeats {
                let frame = uniforms.bind_frame(dispatches.len());
                let counted = (loop_counts.as_ref())
                    .zip(*counted_at)
                    .map(|(counts, binding)| {
                        let resource = counts.bind_dispatch(dispatches.len());
                        wgpu::BindGroupEntry { binding, resource }
                    });
                let bind_group = gpu.catch_errors(place, || {
                    create_bind_group(
                        gpu,
                        &filter.shader,
                        entry,
                        &compiled.layout,
                        counted,
                        |variable| match variable.name.as_str() {
                            "frame" => frame.clone(),
                            "parameters" => uniforms.parameters.as_entire_binding(),
                            _ => wgpu::BindingResource::TextureView(
                                &targets.of_variable(entry, variable).view,
                            ),
                        },
                    )
                })?;
                dispatches.push(Dispatch {
                    entry: pass.entry.clone(),
                    pipeline: compiled.pipeline.clone(),
                    bind_group,
                    workgroups: [
                        over.width.div_ceil(group_width),
                        over.height.div_ceil(group_height),
                    ],
                    bytes: targets.sum_bytes(&filter.shader, entry),
                    depends_on_color,
                    depends_on_noise,
                    writes_output: entry.writes.contains("output"),
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
    pub fn upload_frame(&self, gpu: &Gpu, frame: FrameUniform) {
        for (index, dispatch) in self.dispatches.iter().enumerate() {
            let frame = FrameUniform {
                iteration: dispatch.iteration,
                iterations: dispatch.iterations,
                ..frame
            };
            self.uniforms.upload_frame(gpu, index, frame);
        }
    }
}

/// Bits of every component of a pixel that no pass has written: a NaN that no arithmetic makes.
pub(super) const MARK: u32 = 0x7fd3_5a17;

/// Creates a texture like the output that holds nothing but the mark.
fn create_mark(gpu: &Gpu, [width, height]: [u32; 2]) -> Target {
    let target = gpu.create_target("mark", width, height, Format::Rgba32Float);
    let components = width as usize * height as usize * 4;
    gpu.upload(&target, &vec![f32::from_bits(MARK); components]);
    target
}
