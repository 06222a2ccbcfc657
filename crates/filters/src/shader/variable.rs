//! Resource variables of kernels: uniforms, and the textures that they read and write.

use shader_import::{FileFault, WgslText};
use wgpu::naga::{
    AddressSpace, GlobalVariable, Handle, ImageClass, ImageDimension, Module, ResourceBinding,
    ScalarKind, StorageAccess, TypeInner,
};

use super::block::UniformBlock;
use super::sampling::Sampling;
use super::texel::Format;
use crate::Expression;

/// A resource variable.
#[derive(Clone, Debug)]
pub(crate) struct Variable {
    pub name: String,
    /// Texture that it reads or writes, or its uniform.
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
    /// `texture_2d` of `f32`, `u32` or `i32`.
    Read(ScalarKind),
    /// `texture_storage_2d<format, write>`.
    Write(Format),
    /// `var<uniform>`, with the index of its block among the shader's.
    Block(usize),
    /// `sampler`.
    Sampler(Sampling),
}

/// Names the texture that a variable writes: `<texture>_out` writes `<texture>`, and `output`
/// itself.
pub(crate) fn written_texture(variable: &str) -> &str {
    variable.strip_suffix("_out").unwrap_or(variable)
}

/// Finds the role of a variable, and adds the block of a uniform; refuses one that nothing can be
/// bound to.
pub(super) fn find_variable(
    source: &WgslText,
    module: &Module,
    handle: Handle<GlobalVariable>,
    blocks: &mut Vec<UniformBlock>,
) -> Result<Variable, FileFault> {
    let variable = &module.global_variables[handle];
    let name = variable.name.clone().unwrap_or_default();
    let line = source.line(module, handle);
    let refuse = |reason: String| source.fault(Some(line), format!("\"{name}\" {reason}"));
    let ResourceBinding { group, binding } =
        variable.binding.expect("only bound variables are listed");
    if group != 0 {
        return Err(refuse(format!(
            "is in group {group}; only @group(0) is bound"
        )));
    }
    let role = match (variable.space, &module.types[variable.ty].inner) {
        (AddressSpace::Uniform, _) => {
            let prefix = if name == "frame" { FRAME_PREFIX } else { "" };
            blocks.push(UniformBlock::by_name(module, variable.ty, prefix).map_err(refuse)?);
            Some(Role::Block(blocks.len() - 1))
        }
        (AddressSpace::Handle, inner) => find_image_role(inner),
        _ => None,
    };
    let role = role.ok_or_else(|| {
        refuse(format!(
            "cannot be bound; allowed: var<uniform>, texture_2d<f32>, texture_2d<u32>, texture_2d<i32>, and \
             texture_storage_2d<{}, write>",
            Format::list(" | ")
        ))
    })?;
    let resource = match role {
        Role::Write(_) => written_texture(&name),
        _ => &name,
    };
    Ok(Variable {
        resource: resource.to_owned(),
        name,
        binding,
        role,
        level: None,
        line: Some(line),
    })
}

/// First part of the names of numbers of the uniform `frame` of common.wgsl. No parameter's name
/// contains it.
pub(crate) const FRAME_PREFIX: &str = "frame.";

/// Finds the role of a texture; none for one that cannot be bound.
pub(crate) fn find_image_role(inner: &TypeInner) -> Option<Role> {
    let TypeInner::Image {
        dim: ImageDimension::D2,
        arrayed: false,
        class,
    } = inner
    else {
        return None;
    };
    match *class {
        ImageClass::Sampled { kind, multi: false } => {
            let known = [ScalarKind::Float, ScalarKind::Uint, ScalarKind::Sint];
            known.contains(&kind).then_some(Role::Read(kind))
        }
        ImageClass::Storage { format, access } if access == StorageAccess::STORE => {
            let mut known = Format::ALL.iter();
            let known = known.find(|known| known.stored() == format);
            known.map(|format| Role::Write(*format))
        }
        _ => None,
    }
}
