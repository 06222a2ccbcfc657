//! The passes of one filter, settings and size, bound to their textures: what a run only has to dispatch.

use super::adapter::Gpu;
use super::binding::bind_group;
use super::iterations::Iterations;
use super::kernels::Kernels;
use super::targets::Targets;
use super::transfer::{Place, Target};
use super::uniforms::{FrameUniform, Uniforms};
use crate::wiring::{color_dependent, noise_dependent};
use crate::{FilterError, Format, Pass, Repeat, Settings};

/// Everything of a filter that lives on the GPU.
#[derive(Debug)]
pub(super) struct Plan {
    /// In the order in which they run.
    pub steps: Vec<Step>,
    /// How long each of them may take, in seconds.
    pub time_limit: f64,
    /// Loop iterations of every dispatch, where they are counted.
    pub iterations: Option<Iterations>,
    /// What the output holds until a pass has written it.
    pub mark: Target,
    targets: Targets,
    uniforms: Uniforms,
}

/// One dispatch.
#[derive(Debug)]
pub(super) struct Step {
    pub entry: String,
    pub pipeline: wgpu::ComputePipeline,
    pub bind_group: wgpu::BindGroup,
    pub workgroups: [u32; 2],
    /// Of the textures that it reads and of those that it writes, each counted once and whole.
    pub bytes: u64,
    /// Whether its result changes with the colour image.
    pub depends_on_color: bool,
    /// Whether its result changes with the frame's index.
    pub depends_on_noise: bool,
    /// Whether it writes the output.
    pub writes_output: bool,
    iteration: u32,
    iterations: u32,
}

impl Step {
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.bind_group, &[]);
        let [x, y] = self.workgroups;
        pass.dispatch_workgroups(x, y, 1);
    }
}

impl Plan {
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
        let place = |pass| Place {
            filter: &filter.name,
            pass,
        };
        let mut targets = Targets::new(gpu, filter, settings, size)?;
        let times = |pass: &Pass| match &pass.repeat {
            Repeat::Times(times) => *times,
            Repeat::Parameter(name) => settings.count(name),
        };
        let dispatches: u32 = filter.passes.iter().map(times).sum();
        let uniforms = gpu.guarded(place("uniforms"), || {
            Uniforms::new(gpu, &settings.bytes(filter), dispatches)
        })?;
        let iterations = (gpu.loop_limit)
            .map(|limit| gpu.guarded(place("counts"), || Iterations::new(gpu, limit, dispatches)))
            .transpose()?;
        let mark = gpu.guarded(place("textures"), || marked(gpu, size))?;
        let dependence = color_dependent(filter)
            .into_iter()
            .zip(noise_dependent(filter));
        let mut steps = Vec::new();
        let bound = filter.passes.iter().zip(passes).zip(dependence);
        for ((pass, compiled), (depends_on_color, depends_on_noise)) in bound {
            let entry = filter.entry_point(pass);
            let over = pass.over.as_deref().unwrap_or("output");
            let over = targets.current(over).texture.size();
            // How many texels one workgroup covers.
            let [group_width, group_height] = match pass.workgroup_per_texel {
                true => [1, 1],
                false => [entry.workgroup_size[0], entry.workgroup_size[1]],
            };
            let place = place(&pass.entry);
            let repeats = times(pass);
            for iteration in 0..repeats {
                let frame = uniforms.frame(steps.len());
                let counted = (iterations.as_ref())
                    .zip(*counted_at)
                    .map(|(counts, binding)| {
                        let resource = counts.of_dispatch(steps.len());
                        wgpu::BindGroupEntry { binding, resource }
                    });
                let bind_group = gpu.guarded(place, || {
                    bind_group(
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
                steps.push(Step {
                    entry: pass.entry.clone(),
                    pipeline: compiled.pipeline.clone(),
                    bind_group,
                    workgroups: [
                        over.width.div_ceil(group_width),
                        over.height.div_ceil(group_height),
                    ],
                    bytes: targets.bytes(&filter.shader, entry),
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
            steps,
            time_limit: filter.time_limit,
            iterations,
            mark,
            targets,
            uniforms,
        })
    }

    /// Copies the mark to the output where every pass that writes it is due: what is left of it was not written.
    pub fn mark_output(&self, gpu: &Gpu, due: impl Fn(&Step) -> bool) {
        let mut writers = self.steps.iter().filter(|step| step.writes_output);
        if writers.all(due) {
            gpu.copy(&self.mark, self.target("output"));
        }
    }

    /// A texture by name, as the last pass leaves it.
    pub fn target(&self, name: &str) -> &Target {
        self.targets.current(name)
    }

    /// Writes the uniform `frame` of every dispatch.
    pub fn upload_frame(&self, gpu: &Gpu, frame: FrameUniform) {
        for (index, step) in self.steps.iter().enumerate() {
            let frame = FrameUniform {
                iteration: step.iteration,
                iterations: step.iterations,
                ..frame
            };
            self.uniforms.upload_frame(gpu, index, frame);
        }
    }
}

/// The bits of every component of a pixel that no pass has written: a NaN that no arithmetic makes.
pub(super) const MARK: u32 = 0x7fd3_5a17;

/// A texture like the output that holds nothing but the mark.
fn marked(gpu: &Gpu, [width, height]: [u32; 2]) -> Target {
    let target = gpu.target("mark", width, height, Format::Rgba32Float);
    let components = width as usize * height as usize * 4;
    gpu.upload(&target, &vec![f32::from_bits(MARK); components]);
    target
}
