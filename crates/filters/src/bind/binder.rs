//! Bindings of a shader, as filter.toml explains them, put in the places that the suite binds.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use shader_import::{OpenModule, Stage, keep_entry_point, validate};
use wgpu::naga::valid::GlobalUse;
use wgpu::naga::{
    AddressSpace, GlobalVariable, Handle, Module, ResourceBinding, StorageAccess, TypeInner,
};

use super::members::fill_block;
use super::places::{explains, is_globals, name_place, name_variable};
use super::textures::{check_texture, describe_image};
use crate::filter::{Binding, BindingPlace, PassShader};
use crate::shader::{
    Role, Shader, UniformBlock, Variable, find_entry_points, find_image_role, written_texture,
};
use crate::{Filter, FilterError};

/// Makes the shader of a pass: one entry point, and one group with a binding for each variable that
/// it uses. A vertex stage has group 1, any other group 0.
pub(super) fn bind(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    open: OpenModule,
    constants: &[(String, f64)],
) -> Result<Shader, FilterError> {
    let OpenModule {
        mut module,
        owners,
        by_rows,
    } = open;
    keep_entry_point(&shader.file, path, &mut module, constants)?;
    narrow_buffers(path, &mut module)?;
    let mut binder = Binder {
        filter,
        shader,
        path,
        by_rows,
        blocks: Vec::new(),
        variables: Vec::new(),
    };
    let handles = binder.bind_all(&mut module, &owners)?;
    let info = validate(path, &module)?;
    let mut entry_points =
        find_entry_points(&module, &info, &handles, &binder.variables, &|_| None);
    for entry in &mut entry_points {
        let mut blocks = binder.blocks.iter();
        entry.draws_noise = blocks.any(|block| block.reads("frame_index"));
        entry.writes.extend(shader.targets.iter().cloned());
        entry.keeps_unwritten = true;
        let checked = entry.usage.check(&entry.name);
        checked.map_err(|reason| FilterError::in_file(path, None, reason))?;
    }
    Ok(Shader {
        path: path.to_owned(),
        module: Arc::new(module),
        variables: binder.variables,
        blocks: binder.blocks,
        entry_points,
        ..Shader::default()
    })
}

/// Makes storage buffers read-only; refuses those that the shader writes.
fn narrow_buffers(path: &Path, module: &mut Module) -> Result<(), FilterError> {
    let is_buffer =
        |variable: &GlobalVariable| matches!(variable.space, AddressSpace::Storage { .. });
    if !(module.global_variables.iter()).any(|(_, variable)| is_buffer(variable)) {
        return Ok(());
    }
    let info = validate(path, module)?;
    let used = info.get_entry_point(0);
    for (handle, variable) in module.global_variables.iter_mut() {
        let is_written = used[handle].intersects(GlobalUse::WRITE | GlobalUse::ATOMIC);
        if let (true, true, Some(place)) = (is_buffer(variable), is_written, variable.binding) {
            let reason = format!(
                "{}: is a storage buffer that the shader writes; allowed: buffers that it only reads, filled from `values`; \
                 write a [[texture]] instead",
                name_variable(variable, &name_place(place))
            );
            return Err(FilterError::in_file(path, None, reason));
        }
        if let AddressSpace::Storage { access } = &mut variable.space {
            *access = StorageAccess::LOAD;
        }
    }
    Ok(())
}

/// Variables of a shader, bound so far.
struct Binder<'a> {
    filter: &'a Filter,
    shader: &'a PassShader,
    path: &'a Path,
    by_rows: BTreeSet<(String, u32)>,
    blocks: Vec<UniformBlock>,
    variables: Vec<Variable>,
}

impl Binder<'_> {
    /// Binds every variable that needs it; returns their handles. `owners` has the places that
    /// explain others.
    fn bind_all(
        &mut self,
        module: &mut Module,
        owners: &BTreeMap<ResourceBinding, ResourceBinding>,
    ) -> Result<Vec<Handle<GlobalVariable>>, FilterError> {
        let placed: Vec<(Handle<GlobalVariable>, ResourceBinding)> =
            (module.global_variables.iter())
                .filter_map(|(handle, variable)| Some((handle, variable.binding?)))
                .collect();
        for (index, (handle, place)) in placed.iter().enumerate() {
            let variable = &module.global_variables[*handle];
            let is_split = owners.contains_key(place);
            let place = &name_place(*owners.get(place).unwrap_or(place));
            let mut bindings = self.shader.bindings.iter();
            let binding = bindings.find(|binding| explains(binding, module, variable, place));
            self.bind(module, *handle, binding, is_split)
                .map_err(|reason| self.refuse(module, variable, place, binding, &reason))?;
            let variable = &mut module.global_variables[*handle];
            variable.binding = Some(ResourceBinding {
                group: u32::from(self.shader.file.stage == Stage::Vertex),
                binding: index as u32,
            });
        }
        Ok(placed.into_iter().map(|(handle, _)| handle).collect())
    }

    /// Makes an error of a variable. It names the line of filter.toml that explains the variable,
    /// or else the shader.
    fn refuse(
        &self,
        module: &Module,
        variable: &GlobalVariable,
        place: &BindingPlace,
        binding: Option<&Binding>,
        reason: &str,
    ) -> FilterError {
        let named = if is_globals(module, variable) {
            "its uniforms outside of any block, which a [[pass.binding]] with globals = true explains".into()
        } else {
            name_variable(variable, place)
        };
        match binding {
            None => FilterError::in_file(self.path, None, format!("{named}: {reason}")),
            Some(binding) => FilterError::in_file(
                &self.filter.lines.path,
                binding.line,
                format!("binding: {named} of {}: {reason}", self.path.display()),
            ),
        }
    }

    /// Adds a variable, and what filter.toml says about it. `is_split` is true for one that was
    /// split from another.
    fn bind(
        &mut self,
        module: &Module,
        handle: Handle<GlobalVariable>,
        binding: Option<&Binding>,
        is_split: bool,
    ) -> Result<(), String> {
        let variable = &module.global_variables[handle];
        let name = variable.name.clone().unwrap_or_default();
        let inner = &module.types[variable.ty].inner;
        let (role, resource) = match (variable.space, inner) {
            (AddressSpace::Uniform | AddressSpace::Storage { .. }, _) => {
                let mut block =
                    fill_block(self.filter, module, variable.ty, binding, &self.by_rows)?;
                block.is_storage = variable.space != AddressSpace::Uniform;
                self.blocks.push(block);
                (Role::Block(self.blocks.len() - 1), String::new())
            }
            (AddressSpace::Handle, TypeInner::Sampler { comparison: false }) => {
                let sampling = binding.map(|binding| binding.sampling).unwrap_or_default();
                (Role::Sampler(sampling), String::new())
            }
            (AddressSpace::Handle, TypeInner::Image { .. }) => {
                if self.shader.file.stage == Stage::Vertex {
                    return Err("is a texture of a vertex stage; allowed there: uniform blocks and push constants".into());
                }
                let role = find_image_role(inner).ok_or_else(|| describe_image(inner))?;
                (role, self.name_texture(binding, &name)?)
            }
            _ => {
                return Err(
                    "is neither a texture, a sampler, a uniform block nor a storage buffer; comparison samplers are not bound"
                        .into(),
                );
            }
        };
        // An image that is read and written reads the output as it was before the pass.
        if !(is_split && resource == "output") {
            check_texture(self.filter, role, &resource)?;
        }
        let level = binding.and_then(|binding| binding.level.clone());
        let has_mips = (self.filter.texture(&resource)).is_some_and(|texture| texture.mips > 1);
        if level.is_some() && !has_mips {
            return Err(format!(
                "has a `level`, and \"{resource}\" has no mip levels; give its [[texture]] `mips`, or leave `level` out"
            ));
        }
        self.variables.push(Variable {
            name,
            resource,
            level,
            binding: self.variables.len() as u32,
            role,
            line: None,
        });
        Ok(())
    }

    /// Names the texture of a binding: the one that filter.toml names, or the one that the variable
    /// is named after.
    fn name_texture(&self, binding: Option<&Binding>, variable: &str) -> Result<String, String> {
        if let Some(texture) = binding.and_then(|binding| binding.texture.clone()) {
            return Ok(texture);
        }
        let called = written_texture(variable);
        if self.filter.has_texture(called) {
            Ok(called.to_owned())
        } else {
            Err(format!(
                "has no `texture`; add a [[pass.binding]] that names one; allowed: {}",
                self.filter.list_textures()
            ))
        }
    }
}
