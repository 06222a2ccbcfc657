//! Places of a shader's variables, and the bindings of filter.toml that explain them.

use std::path::Path;

use shader_import::{OpenModule, PUSH_CONSTANTS};
use wgpu::naga::{AddressSpace, GlobalVariable, Module, ResourceBinding, TypeInner};

use crate::filter::{Binding, BindingPlace, PassShader};
use crate::shader::SamplerFilter;
use crate::{Filter, FilterError};

/// Names that compilers give to the block of uniforms outside of any block, or to its type.
const GLOBALS: [&str; 6] = [
    "$Global",
    "$Globals",
    "type.$Globals",
    "globalParams",
    "GlobalParams_std140",
    "gl_DefaultUniformBlock",
];

/// A variable of a stage that has to be bound.
struct Declared<'m> {
    module: &'m Module,
    variable: &'m GlobalVariable,
    /// Its place, or that of the variable that it was split from.
    place: BindingPlace,
    is_split: bool,
}

impl Declared<'_> {
    fn is_explained_by(&self, binding: &Binding) -> bool {
        explains(binding, self.module, self.variable, &self.place)
    }

    /// Lists the keys of a binding that mean something to it.
    fn list_keys(&self) -> &'static [&'static str] {
        let inner = &self.module.types[self.variable.ty].inner;
        match (self.variable.space, inner) {
            (AddressSpace::Uniform | AddressSpace::Storage { .. }, _) => &["values"],
            (_, TypeInner::Sampler { .. }) => &["sampler", "wrap", "mip_filter"],
            _ => &["texture", "level"],
        }
    }
}

/// Refuses a binding of filter.toml that none of the stages of a pass has, a second one for the
/// same variable, and a key that means nothing to its variable.
pub(super) fn check_places(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    stages: &[&OpenModule],
) -> Result<(), FilterError> {
    let declared = list_declared(stages);
    for (index, binding) in shader.bindings.iter().enumerate() {
        check_binding(filter, &shader.bindings[..index], binding, path, &declared).map_err(
            |reason| {
                let reason = format!("binding: {reason}");
                FilterError::in_file(&filter.lines.path, binding.line, reason)
            },
        )?;
    }
    Ok(())
}

/// Lists the variables of stages that have to be bound.
fn list_declared<'m>(stages: &[&'m OpenModule]) -> Vec<Declared<'m>> {
    let declared = stages.iter().flat_map(|open| {
        let OpenModule { module, owners, .. } = open;
        let placed = (module.global_variables.iter())
            .filter_map(|(_, variable)| Some((variable, variable.binding?)));
        placed.map(move |(variable, place)| Declared {
            module,
            variable,
            is_split: owners.contains_key(&place),
            place: name_place(*owners.get(&place).unwrap_or(&place)),
        })
    });
    declared.collect()
}

/// Checks a binding; `earlier` are those before it.
fn check_binding(
    filter: &Filter,
    earlier: &[Binding],
    binding: &Binding,
    path: &Path,
    declared: &[Declared],
) -> Result<(), String> {
    let path = path.display();
    let explained: Vec<&Declared> = (declared.iter())
        .filter(|variable| variable.is_explained_by(binding))
        .collect();
    let Some(first) = explained.first() else {
        let mut places: Vec<String> = (declared.iter().filter(|variable| !variable.is_split))
            .map(|variable| name_variable(variable.variable, &variable.place))
            .collect();
        places.sort_unstable();
        places.dedup();
        let places = if places.is_empty() {
            "no bindings".to_owned()
        } else {
            places.join("; ")
        };
        return Err(format!(
            "{path} has nothing at {}; it has: {places}",
            binding.place
        ));
    };
    let named = name_variable(first.variable, &first.place);
    let is_known = |known: &&Binding| {
        explained
            .iter()
            .any(|variable| variable.is_explained_by(known))
    };
    if let Some(known) = earlier.iter().find(is_known) {
        return Err(format!(
            "{named} of {path} is explained twice, first by line {}; keep one",
            known.line
        ));
    }
    let mut allowed: Vec<&str> = (explained.iter())
        .flat_map(|variable| variable.list_keys())
        .copied()
        .collect();
    allowed.dedup();
    if let Some(idle) = binding.keys.iter().find(|key| !allowed.contains(key)) {
        return Err(format!(
            "{named} of {path}: `{idle}` means nothing to it; allowed: {}",
            allowed.join(", ")
        ));
    }
    let has_mips = filter.textures.iter().any(|texture| texture.mips > 1);
    if binding.sampling.mip_filter == SamplerFilter::Linear && !has_mips {
        return Err(format!(
            "{named} of {path}: has mip_filter = \"linear\", and no [[texture]] has mip levels; give one `mips`, or leave \
             `mip_filter` out"
        ));
    }
    Ok(())
}

/// Returns true if a binding of filter.toml is meant for a variable at a place.
pub(super) fn explains(
    binding: &Binding,
    module: &Module,
    variable: &GlobalVariable,
    place: &BindingPlace,
) -> bool {
    match &binding.place {
        BindingPlace::Named(name) => variable.name.as_ref() == Some(name),
        BindingPlace::Globals => is_globals(module, variable),
        other => other == place,
    }
}

/// Returns true for the block that a compiler makes of uniforms outside of any block.
pub(super) fn is_globals(module: &Module, variable: &GlobalVariable) -> bool {
    let names = [&variable.name, &module.types[variable.ty].name];
    let mut names = names.into_iter().flatten();
    names.any(|name| GLOBALS.contains(&&name[..]))
}

/// Names a variable and its place for messages.
pub(super) fn name_variable(variable: &GlobalVariable, place: &BindingPlace) -> String {
    match &variable.name {
        Some(name) if !name.is_empty() => format!("\"{name}\" at {place}"),
        _ => place.to_string(),
    }
}

/// Returns the place of a variable as filter.toml names it.
pub(super) fn name_place(place: ResourceBinding) -> BindingPlace {
    match place {
        PUSH_CONSTANTS => BindingPlace::PushConstants,
        ResourceBinding { group, binding } => BindingPlace::Bound { group, binding },
    }
}
