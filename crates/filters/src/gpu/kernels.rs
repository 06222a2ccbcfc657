//! Compiled kernels of a filter, for blurs of every size and with any settings.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::sync::{Arc, Mutex};

use shader_import::falls_through_wrongly;
use wgpu::naga::ShaderStage;

use super::binding::{CompiledStage, Pipeline, create_pipeline};
use super::device::Gpu;
use super::limits::Limits;
use super::targets::list_target_formats;
use crate::bind::{list_constants, specialise};
use crate::shader::{
    Shader, Varying, count_loop_iterations, follow_interpolation, run_on_large_stack,
};
use crate::{Filter, FilterError, Pass, Settings};

/// The compiled kernels of one filter, from which [`Blur::with_kernels`](super::Blur::with_kernels)
/// makes blurs without compiling again.
#[derive(Debug)]
pub struct Kernels<'g> {
    pub(super) gpu: &'g Gpu,
    pub(super) filter: Filter,
    /// Values of specialisation constants that the filter's shaders have: those of the first
    /// preset.
    constants: Vec<Constants>,
    /// Kernels for these constants, then for other values of them.
    specialised: Mutex<Vec<Arc<Specialised>>>,
}

/// Values of specialisation constants of a pass, by name or number.
type Constants = Vec<(String, f64)>;

/// Kernels whose specialisation constants are set.
#[derive(Debug)]
pub(super) struct Specialised {
    /// Device that they were compiled for.
    device: wgpu::Device,
    /// Constants of each pass.
    constants: Vec<Constants>,
    pub filter: Filter,
    /// Kernels in the order of the filter's passes.
    pub passes: Vec<Compiled>,
}

/// The kernel of one pass.
#[derive(Clone, Debug)]
pub(super) struct Compiled {
    /// Its stages, in the order of [`Filter::stages`].
    pub stages: Vec<CompiledStage>,
    pub pipeline: Pipeline,
}

/// Upper limit on kernels that are cached for other values of specialisation constants.
const MAX_KEPT: usize = 16;

impl<'g> Kernels<'g> {
    /// Compiles every pass. Fails for a filter that is a command, for one that asks for more than
    /// the adapter grants, and if the driver refuses.
    pub fn compile(gpu: &'g Gpu, filter: &Filter) -> Result<Self, FilterError> {
        if filter.command.is_some() {
            return Err(FilterError::Command {
                filter: filter.name.clone(),
                reason: "it is a command and has no kernels that an adapter could run".into(),
            });
        }
        // An earlier filter may have lost the device.
        gpu.reopen_if_lost()?;
        let constants = list_all_constants(filter, &filter.settings(None)?);
        let first = compile(gpu, filter.clone(), constants.clone(), None)?;
        Ok(Self {
            gpu,
            filter: filter.clone(),
            constants,
            specialised: Mutex::new(vec![Arc::new(first)]),
        })
    }

    /// Returns the kernels with the specialisation constants that settings give them. Those of new
    /// values are compiled.
    pub(super) fn specialise(&self, settings: &Settings) -> Result<Arc<Specialised>, FilterError> {
        let constants = list_all_constants(&self.filter, settings);
        let lock = || (self.specialised.lock()).unwrap_or_else(|broken| broken.into_inner());
        self.gpu.reopen_if_lost()?;
        let device = self.gpu.device();
        let first = {
            let mut cached = lock();
            cached.retain(|known| known.device == device);
            if let Some(known) = cached.iter().find(|known| known.constants == constants) {
                return Ok(known.clone());
            }
            cached.first().cloned()
        };
        let mut filter = self.filter.clone();
        let changed = constants.iter().zip(&self.constants);
        for (pass, (values, cached)) in self.filter.passes.iter().zip(changed) {
            let Some(shader) = pass.shader.as_ref().filter(|_| values != cached) else {
                continue;
            };
            for (stage, index) in shader.stages().iter().zip(&pass.shaders) {
                let made = &self.filter.shaders[*index];
                filter.shaders[*index] = specialise(&self.filter, stage, made, settings)?;
            }
        }
        let made = Arc::new(compile(self.gpu, filter, constants, first.as_deref())?);
        let mut cached = lock();
        if cached.len() > MAX_KEPT {
            cached.remove(1);
        }
        cached.push(made.clone());
        Ok(made)
    }
}

/// Lists the specialisation constants of each pass.
fn list_all_constants(filter: &Filter, settings: &Settings) -> Vec<Constants> {
    let of_pass = |pass: &Pass| {
        let shader = pass.shader.as_ref();
        shader.map_or(Vec::new(), |shader| {
            list_constants(filter, shader, settings)
        })
    };
    filter.passes.iter().map(of_pass).collect()
}

/// Compiles the passes of a filter, except those with the same constants as in `known`.
fn compile(
    gpu: &Gpu,
    filter: Filter,
    constants: Vec<Constants>,
    known: Option<&Specialised>,
) -> Result<Specialised, FilterError> {
    Limits::of(gpu).check(&filter)?;
    let passes = run_on_large_stack(|| {
        let mut modules = BTreeMap::new();
        (filter.passes.iter().enumerate())
            .map(|(index, pass)| {
                match known.filter(|known| known.constants[index] == constants[index]) {
                    Some(known) => Ok(known.passes[index].clone()),
                    None => compile_pass(gpu, &filter, pass, &mut modules),
                }
            })
            .collect::<Result<_, FilterError>>()
    });
    let passes = passes.unwrap_or_else(|panic| {
        let reason = format!("wgpu fails on it: {panic}");
        Err(refuse(gpu, &filter, "kernels", &reason))
    })?;
    Ok(Specialised {
        device: gpu.device(),
        constants,
        filter,
        passes,
    })
}

/// Modules of shaders by their index, each with the binding of the buffer of loop iterations if
/// they are counted.
type Modules = BTreeMap<usize, (wgpu::ShaderModule, Option<u32>)>;

fn compile_pass(
    gpu: &Gpu,
    filter: &Filter,
    pass: &Pass,
    modules: &mut Modules,
) -> Result<Compiled, FilterError> {
    for index in &pass.shaders {
        if let Entry::Vacant(missing) = modules.entry(*index) {
            let read = &filter.entry_point(pass).inputs;
            missing.insert(compile_shader(gpu, filter, &filter.shaders[*index], read)?);
        }
    }
    let compiled = gpu.catch(|| {
        let stages = pass.shaders.iter().zip(filter.stages(pass));
        let stages = stages.map(|(index, (shader, entry))| {
            let (module, counted_at) = &modules[index];
            let stage = CompiledStage::new(gpu, shader, entry, module.clone(), *counted_at);
            (stage, entry)
        });
        let stages: Vec<_> = stages.collect();
        let formats = list_target_formats(filter, pass);
        let pipeline = create_pipeline(gpu, &stages, &formats, filter.convention.origin());
        let stages = stages.into_iter().map(|(stage, _)| stage).collect();
        Compiled { stages, pipeline }
    });
    gpu.check_loss(filter.place(&pass.entry))?;
    compiled.map_err(|reason| refuse(gpu, filter, &pass.entry, &reason))
}

/// Compiles a module. Its loops are counted if the adapter ends long ones, except in vertex stages,
/// which may store nothing; those are interpolated as their fragment shader reads them.
fn compile_shader(
    gpu: &Gpu,
    filter: &Filter,
    shader: &Shader,
    read: &[Varying],
) -> Result<(wgpu::ShaderModule, Option<u32>), FilterError> {
    if falls_through_wrongly(&shader.module) {
        return Err(filter.place("kernels").refuse(format!(
            "{}: a `case` falls through into the next one, in a `switch` in which several labels share a body; naga, which \
             writes it for the adapter, makes another jump of it; end the case with `break`, and write what follows once more",
            shader.path.display()
        )));
    }
    let mut entries = shader.entry_points.iter();
    let is_vertex = entries.any(|entry| entry.stage == ShaderStage::Vertex);
    let limit = gpu.loop_limit.filter(|_| !is_vertex);
    let counted_at = limit.map(|_| shader.find_free_binding());
    let mut module = match (limit, counted_at) {
        (Some(limit), Some(at)) => count_loop_iterations(&shader.module, at, limit.safe()),
        _ => (*shader.module).clone(),
    };
    if is_vertex {
        follow_interpolation(&mut module, read);
    }
    let source = wgpu::ShaderSource::Naga(Cow::Owned(module));
    let module = gpu.catch(|| {
        gpu.device()
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(&filter.name),
                source,
            })
    });
    gpu.check_loss(filter.place("kernels"))?;
    let module = module.map_err(|reason| refuse(gpu, filter, "kernels", &reason))?;
    Ok((module, counted_at))
}

/// Makes an error of what wgpu or the driver says of a pass or of all kernels; it names the file
/// and the adapter.
fn refuse(gpu: &Gpu, filter: &Filter, pass: &str, reason: &str) -> FilterError {
    let known = filter.passes.iter().find(|known| known.entry == pass);
    let line = known.and_then(|known| filter.entry_point(known).line);
    let line = line.map_or(String::new(), |line| format!(":{line}"));
    let shader = known.map_or(&filter.shaders[0], |known| filter.shader(known));
    let path = shader.path.display();
    let lines = reason.lines().map(str::trim);
    let lines: Vec<&str> = lines.filter(|line| !line.is_empty()).collect();
    filter.place(pass).refuse(format!(
        "{path}{line} is refused by adapter \"{}\": {}",
        gpu.adapter.name,
        lines.join(" ")
    ))
}
