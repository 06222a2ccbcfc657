//! Textures that fit the variables of a shader.

use wgpu::naga::{ImageClass, ScalarKind, StorageAccess, TypeInner};

use crate::shader::Role;
use crate::{Filter, Format};

/// Refuses a texture that does not fit its variable.
pub(crate) fn check_texture(filter: &Filter, role: Role, texture: &str) -> Result<(), String> {
    let declared = filter.texture(texture).map(|declared| declared.format);
    match (role, declared) {
        (Role::Block(_) | Role::Sampler(_), _) => Ok(()),
        (_, None) if !filter.has_texture(texture) => Err(format!(
            "texture = \"{texture}\" names none; allowed: {}",
            filter.list_textures()
        )),
        (Role::Read(_), None) if texture == "output" => {
            Err("reads \"output\"; a pass reads what an earlier one wrote to a [[texture]]".into())
        }
        (Role::Read(ScalarKind::Uint | ScalarKind::Sint), None) => {
            Err("holds floats: texture_2d<f32>".into())
        }
        (Role::Read(kind), Some(format)) if format.kind() != kind => Err(format!(
            "does not fit the declared format {}, which is read as texture_2d<{}>",
            format.name(),
            match format.kind() {
                ScalarKind::Uint => "u32",
                ScalarKind::Sint => "i32",
                _ => "f32",
            }
        )),
        (Role::Write(_), None) if texture != "output" => Err(format!(
            "writes \"{texture}\", which is an input; allowed: output, or a [[texture]]; an image that is read and written is \
             texture = \"output\", which begins as a copy of color"
        )),
        (Role::Write(Format::Rgba32Float | Format::Rgba16Float), None) => Ok(()),
        (Role::Write(written), None) => Err(format!(
            "writes \"output\" as {}; allowed: rgba32float or rgba16float",
            written.name()
        )),
        (Role::Write(written), Some(format)) if format != written => Err(format!(
            "writes texture \"{texture}\" as {}; it is declared as {}",
            written.name(),
            format.name()
        )),
        _ => Ok(()),
    }
}

/// Says why an image cannot be bound.
pub(super) fn describe_image(inner: &TypeInner) -> String {
    match inner {
        TypeInner::Image {
            class: ImageClass::Storage { access, .. },
            ..
        } if access.contains(StorageAccess::LOAD | StorageAccess::STORE) => {
            "is a storage image that is both read and written, or passed to a function; read it through a texture of its \
             own"
                .into()
        }
        TypeInner::Image {
            class: ImageClass::Depth { .. },
            ..
        } => {
            "is a depth texture that is sampled with a comparison or has layers or several samples; read depth through \
             texture_depth_2d or texture_2d<f32>"
                .into()
        }
        _ => format!(
            "cannot be bound; allowed: two-dimensional textures of floats or of whole numbers, and storage textures of {}",
            Format::list(", ")
        ),
    }
}
