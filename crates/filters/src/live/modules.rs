//! Modules of a filter as WGSL: `wgsl`, a line break and `appended` are compiled as one; those with
//! a `file` belong to the filter.

use naga::Module;
use naga::back::wgsl::{WriterFlags, write_string};
use naga::valid::{Capabilities, ValidationFlags, Validator};
use serde_json::{Value, json};

use super::bindings::list_bindings;
use crate::gpu::make_triangle;
use crate::load::read_text;
use crate::shader::{COMMON, follow_interpolation};
use crate::{Filter, Pass};

/// Entry point of a translated module: naga would change some names.
pub(super) const ENTRY: &str = "entry_point";

/// Names the file of a module in the folder that a page saves.
pub(super) fn file_name(filter: &Filter, index: usize) -> String {
    let stem = filter.shaders[index].path.file_stem().unwrap_or_default();
    let stem = stem.to_string_lossy();
    let number = format!("_{index}");
    if filter
        .passes
        .iter()
        .any(|pass| pass.shader.is_some() && pass.shaders.contains(&index))
    {
        format!("{}{number}.wgsl", stem.trim_end_matches(&number))
    } else {
        format!("{}.wgsl", filter.name)
    }
}

/// Lists the modules, by their indices in the filter.
pub(super) fn list_modules(filter: &Filter) -> Result<Vec<Value>, String> {
    let mut modules = Vec::new();
    for (index, shader) in filter.shaders.iter().enumerate() {
        let pass = filter
            .passes
            .iter()
            .find(|pass| pass.shaders.contains(&index));
        let Some(pass) = pass.filter(|pass| pass.shader.is_some()) else {
            let text = read_text(filter, &shader.path).map_err(|error| error.to_string())?;
            modules.push(json!({ "file": file_name(filter, index), "wgsl": text.trim_end(), "appended": COMMON }));
            continue;
        };
        if shader.compiled.is_some() {
            let reason =
                "This page cannot run the filter: a parameter sets constants of its shaders.";
            return Err(reason.into());
        }
        let mut module = (*shader.module).clone();
        let mut kernel = &filter.entry_point(pass).name;
        if pass.shaders[0] != index {
            follow_interpolation(&mut module, &filter.entry_point(pass).inputs);
            kernel = &shader.entry_points[0].name;
        }
        module.entry_points.retain(|entry| entry.name == *kernel);
        module.entry_points[0].name = ENTRY.to_owned();
        let text = translate(&module)?;
        modules.push(
            json!({ "file": file_name(filter, index), "wgsl": text.trim_end(), "appended": "" }),
        );
    }
    Ok(modules)
}

/// Writes a module of naga as WGSL.
fn translate(module: &Module) -> Result<String, String> {
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::all());
    let info = validator
        .validate(module)
        .map_err(|error| error.to_string());
    let text = info.and_then(|info| {
        write_string(module, &info, WriterFlags::empty()).map_err(|error| error.to_string())
    });
    text.map_err(|reason| {
        format!("This page cannot run the filter, because WGSL cannot say what its shader does: {reason}.")
    })
}

/// Describes the vertex stage of a fragment shader; the program's own triangle becomes another
/// module. None for a kernel.
pub(super) fn describe_vertex(
    filter: &Filter,
    pass: &Pass,
    modules: &mut Vec<Value>,
) -> Option<Value> {
    let stages = filter.stages(pass);
    let (_, entry) = stages[0];
    if !entry.is_fragment() {
        return None;
    }
    if let Some((shader, vertex)) = stages.get(1) {
        let bindings = list_bindings(shader, vertex);
        return Some(json!({ "module": pass.shaders[1], "entry": ENTRY, "bindings": bindings }));
    }
    let triangle = translate(&make_triangle(&entry.inputs, filter.convention.origin()))
        .expect("it is valid WGSL");
    modules.push(json!({ "wgsl": triangle, "appended": "" }));
    Some(json!({ "module": modules.len() - 1, "entry": "triangle", "bindings": [] }))
}
