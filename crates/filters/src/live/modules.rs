//! Modules of a filter as WGSL.

use naga::Module;
use naga::back::wgsl::{WriterFlags, write_string};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use serde::Serialize;

use super::LiveBinding;
use crate::gpu::make_triangle;
use crate::load::read_text;
use crate::shader::{COMMON, Varying, follow_interpolation};
use crate::{Filter, Pass};

/// A module: two texts, compiled as one.
#[derive(Clone, Debug, Serialize)]
pub(super) struct LiveModule {
    /// Kernels of the filter, or what naga makes of its shader.
    wgsl: String,
    /// Text that the program appends after a line break.
    appended: &'static str,
    /// True if a person may change the kernels.
    editable: bool,
}

/// The vertex stage of a fragment shader.
#[derive(Clone, Debug, Serialize)]
pub(super) struct LiveVertex {
    /// Index of its module.
    module: usize,
    entry: String,
    bindings: Vec<LiveBinding>,
}

/// Entry point of a translated module: naga would change some names.
pub(super) const ENTRY: &str = "entry_point";

/// Lists the modules, by their indices in the filter.
pub(super) fn list_modules(filter: &Filter) -> Result<Vec<LiveModule>, String> {
    let mut modules = Vec::new();
    for (index, shader) in filter.shaders.iter().enumerate() {
        let pass = filter.passes.iter().find(|it| it.shaders.contains(&index));
        let Some(pass) = pass.filter(|pass| pass.shader.is_some()) else {
            let text = read_text(filter, &shader.path).map_err(|error| error.to_string())?;
            modules.push(LiveModule {
                wgsl: text.trim_end().to_owned(),
                appended: COMMON,
                editable: true,
            });
            continue;
        };
        if shader.compiled.is_some() {
            return Err(
                "This page cannot run the filter: a parameter sets constants of its shaders."
                    .into(),
            );
        }
        let mut module = (*shader.module).clone();
        let kernel = match pass.shaders[0] == index {
            true => &filter.entry_point(pass).name,
            false => {
                follow_interpolation(&mut module, &filter.entry_point(pass).inputs);
                &shader.entry_points[0].name
            }
        };
        module.entry_points.retain(|entry| entry.name == *kernel);
        module.entry_points[0].name = ENTRY.to_owned();
        modules.push(LiveModule::translate(&module)?);
    }
    Ok(modules)
}

impl LiveModule {
    /// Writes a module of naga as WGSL.
    fn translate(module: &Module) -> Result<Self, String> {
        let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
        let info = validator
            .validate(module)
            .map_err(|error| error.to_string());
        let text = info.and_then(|info| {
            write_string(module, &info, WriterFlags::empty()).map_err(|error| error.to_string())
        });
        let wgsl = text.map_err(|reason| {
            format!("This page cannot run the filter: its shader is no WGSL: {reason}.")
        })?;
        Ok(Self {
            wgsl,
            appended: "",
            editable: false,
        })
    }

    /// Makes the triangle of a fragment shader without a vertex stage of its own.
    fn triangle(read: &[Varying]) -> Self {
        Self::translate(&make_triangle(read)).expect("the triangle is valid WGSL")
    }
}

impl LiveVertex {
    /// Finds the vertex stage of a pass; the program's own triangle becomes another module. None for a kernel.
    pub fn find(filter: &Filter, pass: &Pass, modules: &mut Vec<LiveModule>) -> Option<Self> {
        let stages = filter.stages(pass);
        if !stages[0].1.is_fragment() {
            return None;
        }
        if let Some((shader, entry)) = stages.get(1) {
            return Some(Self {
                module: pass.shaders[1],
                entry: ENTRY.to_owned(),
                bindings: LiveBinding::list(shader, entry),
            });
        }
        modules.push(LiveModule::triangle(&stages[0].1.inputs));
        Some(Self {
            module: modules.len() - 1,
            entry: "triangle".to_owned(),
            bindings: Vec::new(),
        })
    }
}
