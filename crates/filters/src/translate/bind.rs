//! Bindings of a shader, as filter.toml explains them, put in the places that the suite binds.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use wgpu::naga::back::pipeline_constants::process_overrides;
use wgpu::naga::compact::{KeepUnused, compact};
use wgpu::naga::valid::{ModuleInfo, ValidationFlags, Validator};
use wgpu::naga::{
    AddressSpace, GlobalVariable, Handle, ImageClass, ImageDimension, Module, ResourceBinding,
    ShaderStage, StorageAccess, TypeInner,
};

use super::combined::Place;
use super::members::fill_block;
use super::module::Read;
use super::{explain, refuse};
use crate::filter::{Binding, BindingPlace, INPUTS, PassShader, Stage};
use crate::shader::{
    CAPABILITIES, Code, Role, Shader, Texel, UniformBlock, Variable, find_entry_points,
    find_image_role, written_texture,
};
use crate::{Filter, FilterError, Format};

/// Makes the shader of a pass: one entry point, and group 0 with a binding for each variable that it uses.
pub(super) fn bind(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    read: Read,
) -> Result<Shader, FilterError> {
    let Read {
        mut module,
        samplers,
    } = read;
    let mut declared: BTreeSet<BindingPlace> = (module.global_variables.iter())
        .filter_map(|(_, variable)| find_place(variable))
        .collect();
    // Samplers that were split from textures are explained where the textures are.
    let owners: BTreeMap<BindingPlace, BindingPlace> = (samplers.into_iter())
        .map(|(sampler, texture)| (bound_at(sampler), bound_at(texture)))
        .collect();
    declared.retain(|place| !owners.contains_key(place));
    check_places(filter, shader, path, &declared)?;
    validate(path, &module)?;
    keep_entry_point(shader, path, &mut module)?;
    set_constants(shader, path, &mut module)?;
    compact(&mut module, KeepUnused::No);
    let mut binder = Binder {
        filter,
        shader,
        path,
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
        let checked = entry.usage.check(&entry.name);
        checked.map_err(|reason| refuse(path, reason))?;
    }
    Ok(Shader {
        path: path.to_owned(),
        code: Code::Module(Box::new(module)),
        variables: binder.variables,
        blocks: binder.blocks,
        entry_points,
        ..Shader::default()
    })
}

fn bound_at((group, binding): Place) -> BindingPlace {
    BindingPlace::Bound { group, binding }
}

/// Refuses a binding of filter.toml that the shader does not have.
fn check_places(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    declared: &BTreeSet<BindingPlace>,
) -> Result<(), FilterError> {
    let Some(unknown) = (shader.bindings.iter()).find(|it| !declared.contains(&it.place)) else {
        return Ok(());
    };
    let places: Vec<String> = declared.iter().map(BindingPlace::to_string).collect();
    Err(FilterError::Folder {
        path: filter.lines.path.clone(),
        line: Some(unknown.line),
        reason: format!(
            "binding: {} has nothing at {}; it has: {}",
            path.display(),
            unknown.place,
            match places.is_empty() {
                true => "no bindings".to_owned(),
                false => places.join("; "),
            }
        ),
    })
}

/// Finds the place of a variable that has to be bound.
fn find_place(variable: &GlobalVariable) -> Option<BindingPlace> {
    match (&variable.binding, variable.space) {
        (_, AddressSpace::Immediate) => Some(BindingPlace::PushConstants),
        (Some(place), _) => Some(BindingPlace::Bound {
            group: place.group,
            binding: place.binding,
        }),
        (None, _) => None,
    }
}

fn validate(path: &Path, module: &Module) -> Result<ModuleInfo, FilterError> {
    let capabilities = CAPABILITIES | wgpu::naga::valid::Capabilities::IMMEDIATES;
    Validator::new(ValidationFlags::all(), capabilities)
        .validate(module)
        .map_err(|error| {
            refuse(
                path,
                format!(
                    "is not valid once translated: {}",
                    explain(error.as_inner())
                ),
            )
        })
}

/// Removes all entry points but the one of the pass.
fn keep_entry_point(
    shader: &PassShader,
    path: &Path,
    module: &mut Module,
) -> Result<(), FilterError> {
    let stage = match shader.stage {
        Stage::Compute => ShaderStage::Compute,
        Stage::Fragment => ShaderStage::Fragment,
    };
    let names: Vec<String> = (module.entry_points.iter())
        .map(|entry| format!("{} ({})", entry.name, name_stage(entry.stage)))
        .collect();
    module
        .entry_points
        .retain(|entry| entry.name == shader.entry && entry.stage == stage);
    match module.entry_points.len() {
        1 => Ok(()),
        _ => Err(refuse(
            path,
            format!(
                "has no {} entry point \"{}\"; it has: {}; filter.toml names it with `entry` and `stage`",
                name_stage(stage),
                shader.entry,
                match names.is_empty() {
                    true => "none".to_owned(),
                    false => names.join(", "),
                }
            ),
        )),
    }
}

/// Sets specialisation constants. Those that filter.toml does not name keep the value that the shader gives them.
fn set_constants(shader: &PassShader, path: &Path, module: &mut Module) -> Result<(), FilterError> {
    let mut names = Vec::new();
    for (_, constant) in module.overrides.iter() {
        let name = constant.name.clone().filter(|name| !name.is_empty());
        let number = constant.id.map(|id| id.to_string());
        names.push((name, number));
    }
    let is = |known: &Option<String>, name: &str| known.as_deref() == Some(name);
    for (name, _) in &shader.constants {
        if !(names.iter()).any(|(own, number)| is(own, name) || is(number, name)) {
            let known: Vec<String> = (names.into_iter())
                .filter_map(|(name, number)| name.or(number))
                .collect();
            return Err(refuse(
                path,
                format!(
                    "has no specialisation constant \"{name}\", which filter.toml sets; it has: {}",
                    match known.is_empty() {
                        true => "none".to_owned(),
                        false => known.join(", "),
                    }
                ),
            ));
        }
    }
    // A constant with a name and a number goes by its number.
    let values = shader.constants.iter().map(|(name, value)| {
        let numbered = names
            .iter()
            .find(|(own, number)| is(own, name) && number.is_some());
        let key = numbered.and_then(|(_, number)| number.clone());
        (key.unwrap_or(name.clone()), *value)
    });
    let info = validate(path, module)?;
    let set = process_overrides(module, &info, None, &values.collect());
    let set = set.map_err(|error| {
        refuse(
            path,
            format!(
                "specialisation constants: {}; `constants` of the pass sets them",
                explain(&error)
            ),
        )
    })?;
    *module = set.0.into_owned();
    Ok(())
}

fn name_stage(stage: ShaderStage) -> &'static str {
    match stage {
        ShaderStage::Compute => "compute",
        ShaderStage::Fragment => "fragment",
        ShaderStage::Vertex => "vertex",
        _ => "other",
    }
}

/// Variables of a shader, bound so far.
struct Binder<'a> {
    filter: &'a Filter,
    shader: &'a PassShader,
    path: &'a Path,
    blocks: Vec<UniformBlock>,
    variables: Vec<Variable>,
}

impl Binder<'_> {
    fn find(&self, place: BindingPlace) -> Option<&Binding> {
        self.shader.bindings.iter().find(|it| it.place == place)
    }

    /// Binds every variable that needs it in group 0; returns their handles. `owners` has the places that explain others.
    fn bind_all(
        &mut self,
        module: &mut Module,
        owners: &BTreeMap<BindingPlace, BindingPlace>,
    ) -> Result<Vec<Handle<GlobalVariable>>, FilterError> {
        let placed: Vec<(Handle<GlobalVariable>, BindingPlace)> = (module.global_variables.iter())
            .filter_map(|(handle, variable)| Some((handle, find_place(variable)?)))
            .collect();
        for (index, (handle, place)) in placed.iter().enumerate() {
            let explained_at = owners.get(place).copied().unwrap_or(*place);
            let bound = self.bind(module, *handle, explained_at);
            let variable = &mut module.global_variables[*handle];
            bound.map_err(|reason| self.refuse(variable, explained_at, &reason))?;
            variable.binding = Some(ResourceBinding {
                group: 0,
                binding: index as u32,
            });
            if variable.space == AddressSpace::Immediate {
                variable.space = AddressSpace::Uniform;
            }
        }
        Ok(placed.into_iter().map(|(handle, _)| handle).collect())
    }

    /// Makes an error of a variable. It names the line of filter.toml that explains the variable, or else the shader.
    fn refuse(&self, variable: &GlobalVariable, place: BindingPlace, reason: &str) -> FilterError {
        let named = match &variable.name {
            Some(name) if !name.is_empty() => format!("\"{name}\" at {place}"),
            _ => place.to_string(),
        };
        match self.find(place) {
            None => refuse(self.path, format!("{named}: {reason}")),
            Some(binding) => FilterError::Folder {
                path: self.filter.lines.path.clone(),
                line: Some(binding.line),
                reason: format!("binding: {named} of {}: {reason}", self.path.display()),
            },
        }
    }

    /// Adds a variable. `place` is that of the binding which explains it.
    fn bind(
        &mut self,
        module: &Module,
        handle: Handle<GlobalVariable>,
        place: BindingPlace,
    ) -> Result<(), String> {
        let variable = &module.global_variables[handle];
        let name = variable.name.clone().unwrap_or_default();
        let binding = self.find(place);
        let texture = || self.name_texture(binding, &name);
        let inner = &module.types[variable.ty].inner;
        let (role, resource) = match (variable.space, inner) {
            (AddressSpace::Uniform | AddressSpace::Immediate, _) => {
                let is_known = |name: &str| self.filter.knows_value(name);
                let block = fill_block(module, variable.ty, binding, &is_known)?;
                self.blocks.push(block);
                (Role::Block(self.blocks.len() - 1), String::new())
            }
            (AddressSpace::Handle, TypeInner::Sampler { comparison: false }) => {
                let sampling = binding.map(|binding| binding.sampling).unwrap_or_default();
                (Role::Sampler(sampling), String::new())
            }
            (
                AddressSpace::Handle,
                TypeInner::Image {
                    dim,
                    arrayed,
                    class,
                },
            ) => {
                let role = match (dim, arrayed) {
                    (ImageDimension::D2, false) => find_image_role(*class),
                    _ => None,
                };
                let role = role.ok_or_else(|| describe_image(*class))?;
                (role, texture()?)
            }
            _ => {
                return Err(
                    "is neither a texture, a sampler nor a uniform block; storage buffers and comparison samplers are not \
                     bound"
                        .into(),
                );
            }
        };
        self.check_texture(role, &resource)?;
        self.variables.push(Variable {
            name,
            resource,
            binding: self.variables.len() as u32,
            role,
            line: None,
        });
        Ok(())
    }

    /// Names the texture of a binding: the one that filter.toml names, or the one that the variable is called after.
    fn name_texture(&self, binding: Option<&Binding>, variable: &str) -> Result<String, String> {
        if let Some(texture) = binding.and_then(|binding| binding.texture.clone()) {
            return Ok(texture);
        }
        let called = written_texture(variable);
        match self.filter.has_texture(called) {
            true => Ok(called.to_owned()),
            false => Err(format!(
                "has no `texture`; add a [[pass.binding]] that names one; allowed: {}",
                self.filter.list_textures()
            )),
        }
    }

    /// Refuses a texture that does not fit its variable.
    fn check_texture(&self, role: Role, texture: &str) -> Result<(), String> {
        let declared = (self.filter.textures.iter()).find(|it| it.name == texture);
        let is_input = INPUTS.contains(&texture);
        match (role, declared) {
            (Role::Read(_) | Role::Write(_), None) if !self.filter.has_texture(texture) => {
                Err(format!(
                    "texture = \"{texture}\" names none; allowed: {}",
                    self.filter.list_textures()
                ))
            }
            (Role::Read(_), None) if texture == "output" => Err(
                "reads \"output\"; a pass reads what an earlier one wrote to a [[texture]]".into(),
            ),
            (Role::Write(_), None) if is_input => Err(format!(
                "writes \"{texture}\", which is an input; allowed: output, or a [[texture]]"
            )),
            (Role::Write(format), None) if !format.is_float() || format.components() != 4 => {
                Err(format!(
                    "writes \"output\" as {}; allowed: rgba32float or rgba16float",
                    format.name()
                ))
            }
            (Role::Read(texel), Some(declared)) if Texel::of(declared.format) != texel => {
                Err(format!(
                    "reads texture \"{texture}\" as {}; it is declared as {}",
                    match texel {
                        Texel::Float => "floats",
                        Texel::Uint => "whole numbers",
                    },
                    declared.format.name()
                ))
            }
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
}

/// Says why an image cannot be bound.
fn describe_image(class: ImageClass) -> String {
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
