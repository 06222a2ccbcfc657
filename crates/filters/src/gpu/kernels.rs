//! Compiled kernels of a filter, for blurs of every size and with any settings.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::binding::{Pipeline, create_layout, create_pipeline, create_samplers};
use super::device::Gpu;
use super::limits::Limits;
use super::place::Place;
use super::targets::list_target_formats;
use super::uploaded_input::UploadedInput;
use crate::printable::escape_controls;
use crate::shader::{Code, Shader, count_loop_iterations, run_on_large_stack};
use crate::{Filter, FilterError, Input};

/// The compiled kernels of one filter, from which [`Blur::with_kernels`](super::Blur::with_kernels) makes blurs without compiling again.
#[derive(Debug)]
pub struct Kernels<'g> {
    pub(super) gpu: &'g Gpu,
    pub(super) filter: Filter,
    /// Kernels in the order of the filter's passes.
    pub(super) passes: Vec<Compiled>,
}

/// The kernel of one pass.
#[derive(Debug)]
pub(super) struct Compiled {
    pub layout: wgpu::BindGroupLayout,
    pub pipeline: Pipeline,
    /// Samplers by the index of their variables.
    pub samplers: BTreeMap<usize, wgpu::Sampler>,
    /// Binding of the buffer of loop iterations, if they are counted.
    pub counted_at: Option<u32>,
}

impl<'g> Kernels<'g> {
    /// Compiles every pass. Fails for a filter that is a command, for one that asks for more than the adapter grants, and if the
    /// driver refuses.
    pub fn compile(gpu: &'g Gpu, filter: &Filter) -> Result<Self, FilterError> {
        if filter.command.is_some() {
            return Err(FilterError::Command {
                filter: filter.name.clone(),
                reason: "it is a command and has no kernels that an adapter could run".into(),
            });
        }
        Limits::of(gpu).check(filter)?;
        let compiled = run_on_large_stack(|| Self::compile_here(gpu, filter));
        compiled.unwrap_or_else(|panic| {
            let reason = format!("wgpu fails on it: {panic}");
            Err(refuse(gpu, filter, "kernels", reason))
        })
    }

    fn compile_here(gpu: &'g Gpu, filter: &Filter) -> Result<Self, FilterError> {
        let place = |pass| Place {
            filter: &filter.name,
            pass,
        };
        let explain = |pass: &str, error| match error {
            FilterError::Gpu { reason, .. } => refuse(gpu, filter, pass, reason),
            error => error,
        };
        let compile_shader = |shader: &Shader| {
            let counted_at = gpu.loop_limit.map(|_| shader.find_free_binding());
            let source = match (gpu.loop_limit, counted_at, &shader.code) {
                (Some(limit), Some(binding), code) => {
                    count_loop_iterations(code, binding, limit.safe())
                }
                (_, _, Code::Wgsl(text)) => wgpu::ShaderSource::Wgsl(text.as_str().into()),
                (_, _, Code::Module(module)) => {
                    wgpu::ShaderSource::Naga(Cow::Owned((**module).clone()))
                }
            };
            let module = gpu.catch_errors(place("kernels"), || {
                gpu.device
                    .create_shader_module(wgpu::ShaderModuleDescriptor {
                        label: Some(&filter.name),
                        source,
                    })
            });
            Ok((
                module.map_err(|error| explain("kernels", error))?,
                counted_at,
            ))
        };
        let modules = (filter.shaders.iter())
            .map(compile_shader)
            .collect::<Result<Vec<_>, FilterError>>()?;
        let passes = (filter.passes.iter())
            .map(|pass| {
                let shader = filter.shader(pass);
                let (module, counted_at) = &modules[pass.shader_index];
                let entry = filter.entry_point(pass);
                let targets = list_target_formats(filter, pass);
                let compiled = gpu.catch_errors(place(&pass.entry), || {
                    let layout = create_layout(gpu, shader, entry, *counted_at);
                    let pipeline = create_pipeline(gpu, &layout, module, entry, &targets);
                    Compiled {
                        layout,
                        pipeline,
                        samplers: create_samplers(gpu, shader, entry),
                        counted_at: *counted_at,
                    }
                });
                compiled.map_err(|error| explain(&pass.entry, error))
            })
            .collect::<Result<_, _>>()?;
        Ok(Self {
            gpu,
            filter: filter.clone(),
            passes,
        })
    }

    /// Uploads an input once, for any number of blurs of this filter.
    pub fn upload(&self, input: &Input) -> Result<UploadedInput, FilterError> {
        UploadedInput::new(self.gpu, &self.filter, input)
    }
}

/// Makes an error of what wgpu or the driver says of a pass or of all kernels; it names the file and the adapter.
fn refuse(gpu: &Gpu, filter: &Filter, pass: &str, reason: String) -> FilterError {
    let known = filter.passes.iter().find(|known| known.entry == pass);
    let line = known.and_then(|known| filter.entry_point(known).line);
    let line = line.map_or(String::new(), |line| format!(":{line}"));
    let shader = known.map_or(&filter.shaders[0], |known| filter.shader(known));
    let path = shader.path.display();
    let lines = reason
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty());
    let lines: Vec<String> = lines.map(escape_controls).collect();
    FilterError::Gpu {
        filter: filter.name.clone(),
        pass: pass.to_owned(),
        reason: format!(
            "{path}{line} is refused by adapter \"{}\": {}",
            gpu.adapter.name,
            lines.join(" ")
        ),
    }
}
