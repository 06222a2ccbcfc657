//! Resource variables of kernels: uniforms, and the textures that they read and write.

use wgpu::naga::{
    AddressSpace, GlobalVariable, Handle, ImageClass, ImageDimension, Module, ScalarKind,
    StorageAccess, TypeInner,
};

use super::source::Source;
use super::texel::{Format, Texel};
use crate::FilterError;
use crate::filter::{Expression, Sampling};

/// A resource variable.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    pub name: String,
    /// Texture that it reads or writes, or the uniform that it is.
    pub resource: String,
    pub binding: u32,
    pub role: Role,
    /// The only mip level that it reads or writes; without one it reads all and writes 0.
    pub level: Option<Expression>,
    /// Line in the WGSL file, from 1.
    pub line: Option<usize>,
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
    /// Uniform block with that index among the shader's, which filter.toml explains.
    Block(usize),
    /// `sampler`.
    Sampler(Sampling),
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
                 texture_storage_2d<{}, write>",
                Format::ALL.map(Format::name).join(" | ")
            ),
        )
    })?;
    let resource = match role {
        Role::Write(_) => written_texture(&name).to_owned(),
        _ => name.clone(),
    };
    Ok(Variable {
        name,
        resource,
        binding: binding.binding,
        role,
        level: None,
        line: Some(line),
    })
}

/// Finds the role of a texture of two dimensions.
pub(crate) fn find_image_role(class: ImageClass) -> Option<Role> {
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
            let mut known = Format::ALL.into_iter();
            known
                .find(|known| known.stored() == format)
                .map(Role::Write)
        }
        _ => None,
    }
}
