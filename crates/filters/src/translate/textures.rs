//! Textures that fit the variables of a shader.

use wgpu::naga::{ImageClass, StorageAccess};

use crate::filter::INPUTS;
use crate::shader::{Role, Texel};
use crate::{Filter, Format};

/// Refuses a texture that does not fit its variable.
pub(super) fn check_texture(filter: &Filter, role: Role, texture: &str) -> Result<(), String> {
    let declared = (filter.textures.iter()).find(|it| it.name == texture);
    let is_input = INPUTS.contains(&texture);
    match (role, declared) {
        (Role::Read(_) | Role::Write(_), None) if !filter.has_texture(texture) => Err(format!(
            "texture = \"{texture}\" names none; allowed: {}",
            filter.list_textures()
        )),
        (Role::Read(_), None) if texture == "output" => {
            Err("reads \"output\"; a pass reads what an earlier one wrote to a [[texture]]".into())
        }
        (Role::Write(_), None) if is_input => Err(format!(
            "writes \"{texture}\", which is an input; allowed: output, or a [[texture]]"
        )),
        (Role::Write(Format::Rgba32Float | Format::Rgba16Float), None) => Ok(()),
        (Role::Write(format), None) => Err(format!(
            "writes \"output\" as {}; allowed: rgba32float or rgba16float",
            format.name()
        )),
        (Role::Read(texel), Some(declared)) if Texel::of(declared.format) != texel => Err(format!(
            "reads texture \"{texture}\" as {}; it is declared as {}",
            match texel {
                Texel::Float => "floats",
                Texel::Uint => "whole numbers",
            },
            declared.format.name()
        )),
        (Role::Read(Texel::Uint), None) => Err(format!(
            "reads \"{texture}\" as whole numbers; it holds floats"
        )),
        (Role::Write(format), Some(declared)) if declared.format != format => Err(format!(
            "writes texture \"{texture}\" as {}; it is declared as {}",
            format.name(),
            declared.format.name()
        )),
        _ => Ok(()),
    }
}

/// Says why an image cannot be bound.
pub(super) fn describe_image(class: ImageClass) -> String {
    match class {
        ImageClass::Storage { access, .. }
            if access.contains(StorageAccess::LOAD | StorageAccess::STORE) =>
        {
            "is a storage image that is both read and written, or passed to a function; read it through a texture of its \
             own"
                .into()
        }
        ImageClass::Depth { .. } => {
            "is a depth texture or is sampled with a comparison; read depth through texture_2d<f32>".into()
        }
        _ => format!(
            "cannot be bound; allowed: two-dimensional textures of floats or of unsigned numbers, and storage textures of \
             {}",
            Format::ALL.map(Format::name).join(", ")
        ),
    }
}
