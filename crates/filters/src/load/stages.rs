//! Agreement of fragment shaders with their targets and their vertex stages.

use shader_import::Stage;

use crate::Filter;
use crate::filter::PassShader;
use crate::shader::{EntryPoint, Varying};

/// Refuses a fragment shader whose colours are not the render targets that filter.toml names.
pub(super) fn check_targets(
    filter: &Filter,
    shader: &PassShader,
    entry: &EntryPoint,
) -> Result<(), String> {
    if shader.file.stage == Stage::Compute {
        return Ok(());
    }
    let targets = &shader.targets;
    let wanted: Vec<u32> = (0..targets.len() as u32).collect();
    if entry.locations != wanted {
        return Err(format!(
            "the fragment shader writes colours to locations {:?}; filter.toml has {} in `targets`; allowed: one target for \
             each location, from 0",
            entry.locations,
            targets.join(", ")
        ));
    }
    let size = |name: &String| {
        filter
            .texture(name)
            .and_then(|texture| texture.divided_by.clone())
    };
    if let Some(other) = targets.iter().find(|name| size(name) != size(&targets[0])) {
        return Err(format!(
            "targets \"{}\" and \"{other}\" have different sizes; allowed: targets of one size",
            targets[0]
        ));
    }
    let has_mips = |name: &String| filter.texture(name).is_some_and(|texture| texture.mips > 1);
    match targets
        .iter()
        .find(|name| shader.level.is_some() && !has_mips(name))
    {
        Some(plain) => Err(format!(
            "level: target \"{plain}\" has no mip levels; give its [[texture]] `mips`, or leave `level` out"
        )),
        None => Ok(()),
    }
}

/// Refuses a vertex stage that wants vertices, or that leaves out what the fragment shader reads.
pub(super) fn check_vertex(vertex: &EntryPoint, fragment: &EntryPoint) -> Result<(), String> {
    let attributes: Vec<u32> = vertex.inputs.iter().map(|input| input.location).collect();
    if !attributes.is_empty() {
        return Err(format!(
            "vertex shader \"{}\" reads attributes at locations {:?}; there are no vertex buffers; allowed: one that makes \
             its three corners from the index of the vertex; or leave `vertex` out for a triangle of the program's own",
            vertex.name, attributes
        ));
    }
    let mut read = fragment.inputs.iter().map(|input| input.location);
    match read.find(|location| !vertex.locations.contains(location)) {
        Some(missing) => Err(format!(
            "the fragment shader reads location {missing}; vertex shader \"{}\" writes locations {:?}; allowed: one that \
             writes all that the other reads",
            vertex.name, vertex.locations
        )),
        None => Ok(()),
    }
}

/// Refuses a fragment shader that reads other numbers than the program's own triangle has.
pub(super) fn check_coordinates(fragment: &EntryPoint) -> Result<(), String> {
    let mut read = fragment.inputs.iter();
    match read.find(|input| input.count_floats().is_none()) {
        None => Ok(()),
        Some(Varying { location, .. }) => Err(format!(
            "the fragment shader reads no floats at location {location}; the program's triangle has texture coordinates there; \
             name a vertex stage by `vertex`, or read up to four floats"
        )),
    }
}
