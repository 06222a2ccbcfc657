//! Compiled kernels of a filter, for blurs of every size and with any settings.

use super::binding::{create_layout, create_pipeline};
use super::device::Gpu;
use super::limits::Limits;
use super::place::Place;
use super::uploaded_input::UploadedInput;
use crate::printable::escape_controls;
use crate::shader::{count_loop_iterations, run_on_large_stack};
use crate::{Filter, FilterError, Input};

/// The compiled kernels of one filter, from which [`Blur::with_kernels`](super::Blur::with_kernels) makes blurs without compiling again.
#[derive(Debug)]
pub struct Kernels<'g> {
    pub(super) gpu: &'g Gpu,
    pub(super) filter: Filter,
    /// Kernels in the order of the filter's passes.
    pub(super) passes: Vec<Compiled>,
    /// Binding of the buffer of loop iterations, if they are counted.
    pub(super) counted_at: Option<u32>,
}

/// The kernel of one pass.
#[derive(Debug)]
pub(super) struct Compiled {
    pub layout: wgpu::BindGroupLayout,
    pub pipeline: wgpu::ComputePipeline,
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
        let shader = &filter.shader;
        let counted_at = gpu.loop_limit.map(|_| shader.find_free_binding());
        let source = match (gpu.loop_limit, counted_at) {
            (Some(limit), Some(binding)) => {
                count_loop_iterations(&shader.source, binding, limit.safe())
            }
            _ => wgpu::ShaderSource::Wgsl(shader.source.as_str().into()),
        };
        let module = gpu.catch_errors(place("kernels"), || {
            gpu.device
                .create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some(&filter.name),
                    source,
                })
        });
        let module = module.map_err(|error| explain("kernels", error))?;
        let passes = (filter.passes.iter())
            .map(|pass| {
                let entry = filter.entry_point(pass);
                let compiled = gpu.catch_errors(place(&pass.entry), || {
                    let layout = create_layout(gpu, shader, entry, counted_at);
                    let pipeline = create_pipeline(gpu, &layout, &module, entry);
                    Compiled { layout, pipeline }
                });
                compiled.map_err(|error| explain(&pass.entry, error))
            })
            .collect::<Result<_, _>>()?;
        Ok(Self {
            gpu,
            filter: filter.clone(),
            passes,
            counted_at,
        })
    }

    /// Uploads an input once, for any number of blurs of this filter.
    pub fn upload(&self, input: &Input) -> Result<UploadedInput, FilterError> {
        UploadedInput::new(self.gpu, &self.filter, input)
    }
}

/// Makes an error of what wgpu or the driver says of a pass or of all kernels; it names the file and the adapter.
fn refuse(gpu: &Gpu, filter: &Filter, pass: &str, reason: String) -> FilterError {
    let line = (filter.shader.entry_point(pass)).and_then(|entry| entry.line);
    let line = line.map_or(String::new(), |line| format!(":{line}"));
    let path = filter.shader.path.display();
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
