//! Resource variables of kernels: uniforms, and the textures that they read and write.

use wgpu::naga::{
    AddressSpace, GlobalVariable, Handle, ImageClass, ImageDimension, Module, ScalarKind,
    StorageAccess, StorageFormat, TypeInner,
};

use super::source::Source;
use super::texel::{Format, Texel};
use crate::FilterError;

/// A resource variable.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    pub name: String,
    pub binding: u32,
    pub role: Role,
    /// Line in the WGSL file, from 1.
    pub line: usize,
}

/// Use of a resource variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// `var<uniform>`.
    Uniform,
    /// `texture_2d<f32>` or `texture_2d<u32>`.
    Read(Texel),
    /// `texture_storage_2d<format, write>`.
    Write(Format),
}

/// Names the texture that a variable writes: `<texture>_out` writes `<texture>`, and `output` itself.
pub(crate) fn written_texture(variable: &str) -> &str {
    variable.strip_suffix("_out").unwrap_or(variable)
}

/// Finds the role of a variable; refuses one that nothing can be bound to.
pub(super) fn find_variable(
    source: &Source,
    module: &Module,
    handle: Handle<GlobalVariable>,
) -> Result<Variable, FilterError> {
    let variable = &module.global_variables[handle];
    let name = variable.name.clone().unwrap_or_default();
    let line = source.line(module, handle);
    let binding = variable.binding.expect("only bound variables are listed");
    if binding.group != 0 {
        return Err(source.at(
            Some(line),
            format!(
                "\"{name}\" is in group {}; only @group(0) is bound",
                binding.group
            ),
        ));
    }
    let role = match (&variable.space, &module.types[variable.ty].inner) {
        (AddressSpace::Uniform, _) => Some(Role::Uniform),
        (
            AddressSpace::Handle,
            TypeInner::Image {
                dim: ImageDimension::D2,
                arrayed: false,
                class,
            },
        ) => find_image_role(*class),
        _ => None,
    };
    let role = role.ok_or_else(|| {
        source.at(
            Some(line),
            format!(
                "\"{name}\" cannot be bound; allowed: var<uniform>, texture_2d<f32>, texture_2d<u32>, and \
                 texture_storage_2d<r32uint | r32float | rg32float | rgba32float, write>"
            ),
        )
    })?;
    Ok(Variable {
        name,
        binding: binding.binding,
        role,
        line,
    })
}

fn find_image_role(class: ImageClass) -> Option<Role> {
    match class {
        ImageClass::Sampled {
            kind: ScalarKind::Float,
            multi: false,
        } => Some(Role::Read(Texel::Float)),
        ImageClass::Sampled {
            kind: ScalarKind::Uint,
            multi: false,
        } => Some(Role::Read(Texel::Uint)),
        ImageClass::Storage { format, access } if access == StorageAccess::STORE => {
            let format = match format {
                StorageFormat::R32Uint => Format::R32Uint,
                StorageFormat::R32Float => Format::R32Float,
                StorageFormat::Rg32Float => Format::Rg32Float,
                StorageFormat::Rgba32Float => Format::Rgba32Float,
                _ => return None,
            };
            Some(Role::Write(format))
        }
        _ => None,
    }
}
