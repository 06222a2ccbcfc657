//! Formats of the textures that a shader stores to, changed in its module.

use std::sync::Arc;

use shader_import::engine_validator;
use wgpu::naga::{ImageClass, Module, ResourceBinding, Span, Type, TypeInner};

use super::declarations::Shader;
use super::texel::Format;
use super::variable::Role;

impl Shader {
    /// Returns the shader with other formats of the textures that it stores to: `choose` gets the
    /// name of each and the format that it has. None if the module is not valid then, such as one
    /// that hands its textures to functions.
    pub fn store_as(&self, choose: &dyn Fn(&str, Format) -> Format) -> Option<Self> {
        let mut stored = self.clone();
        let mut module = None;
        for variable in &mut stored.variables {
            let Role::Write(format) = variable.role else {
                continue;
            };
            let chosen = choose(&variable.resource, format);
            if chosen != format {
                variable.role = Role::Write(chosen);
                let module = module.get_or_insert_with(|| (*self.module).clone());
                set_format(module, variable.binding, chosen);
            }
        }
        if let Some(module) = module {
            engine_validator().validate(&module).ok()?;
            stored.module = Arc::new(module);
        }
        Some(stored)
    }

    /// Returns the format in which the shader stores a texture; none if it does not store it.
    pub fn stored_format(&self, texture: &str) -> Option<Format> {
        let mut written = self
            .variables
            .iter()
            .filter(|variable| variable.resource == texture);
        written.find_map(|variable| match variable.role {
            Role::Write(format) => Some(format),
            _ => None,
        })
    }
}

/// Sets the format of the storage texture at a binding of group 0.
fn set_format(module: &mut Module, binding: u32, format: Format) {
    let place = Some(ResourceBinding { group: 0, binding });
    let mut variables = module.global_variables.iter_mut();
    let Some((_, variable)) = variables.find(|(_, variable)| variable.binding == place) else {
        return;
    };
    let Type { name, mut inner } = module.types[variable.ty].clone();
    if let TypeInner::Image {
        class: ImageClass::Storage { format: stored, .. },
        ..
    } = &mut inner
    {
        *stored = format.stored();
        variable.ty = module.types.insert(Type { name, inner }, Span::UNDEFINED);
    }
}
