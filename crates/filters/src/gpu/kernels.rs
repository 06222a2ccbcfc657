//! The kernels of a filter, compiled: what blurs of every size and of all settings share.

use super::adapter::Gpu;
use super::binding::{layout, pipeline};
use super::loops::count;
use super::resident::Resident;
use super::transfer::Place;
use crate::{Filter, FilterError, Input};

/// The compiled kernels of one filter, from which [`Blur::of`](super::Blur::of) makes blurs without compiling again.
#[derive(Debug)]
pub struct Kernels<'g> {
    pub(super) gpu: &'g Gpu,
    pub(super) filter: Filter,
    /// In the order of the filter's passes.
    pub(super) passes: Vec<Compiled>,
    /// Binding of the buffer of loop iterations, where they are counted.
    pub(super) counted_at: Option<u32>,
}

/// The kernel of one pass.
#[derive(Debug)]
pub(super) struct Compiled {
    pub layout: wgpu::BindGroupLayout,
    pub pipeline: wgpu::ComputePipeline,
}

impl<'g> Kernels<'g> {
    /// Compiles every pass. Refuses a filter that is a command, and what the driver refuses.
    pub fn compile(gpu: &'g Gpu, filter: &Filter) -> Result<Self, FilterError> {
        if filter.command.is_some() {
            return Err(FilterError::Command {
                filter: filter.name.clone(),
                reason: "it is a command and has no kernels that an adapter could run".into(),
            });
        }
        let place = |pass| Place {
            filter: &filter.name,
            pass,
        };
        let shader = &filter.shader;
        let counted_at = gpu.loop_limit.map(|_| shader.free_binding());
        let source = match (gpu.loop_limit, counted_at) {
            (Some(limit), Some(binding)) => count(&shader.source, binding, limit.safe()),
            _ => wgpu::ShaderSource::Wgsl(shader.source.as_str().into()),
        };
        let module = gpu.guarded(place("kernels"), || {
            gpu.device
                .create_shader_module(wgpu::ShaderModuleDescriptor {
                    label: Some(&filter.name),
                    source,
                })
        })?;
        let passes = (filter.passes.iter())
            .map(|pass| {
                let entry = filter.entry_point(pass);
                gpu.guarded(place(&pass.entry), || {
                    let layout = layout(gpu, shader, entry, counted_at);
                    let pipeline = pipeline(gpu, &layout, &module, entry);
                    Compiled { layout, pipeline }
                })
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
    pub fn keep(&self, input: &Input) -> Result<Resident, FilterError> {
        Resident::new(self.gpu, &self.filter, input)
    }
}
