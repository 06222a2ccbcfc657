//! Shaders of engines, imported, and bound as filter.toml says.
//!
//! `shader_import` reads them as modules of naga. Nothing is taken on trust: each module is
//! validated after each change, and panics of the libraries are caught here.

mod binder;
#[cfg(test)]
mod deep;
mod members;
mod places;
mod textures;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use frame::read_bounded;
use shader_import::{
    Compiler, FileFault, Import, OpenModule, Pictures, ShaderFile, find_idle_name, read,
};
use wgpu::naga::{ResourceBinding, StorageFormat};

use crate::filter::{BindingPlace, PassShader, VerticalDirection};
use crate::shader::{Shader, guard, hash_code, try_each, written_texture};
use crate::{Filter, FilterError, Settings};
use binder::bind;
use places::check_places;

pub(crate) use textures::check_texture;

/// Function that reads a file of the filter's folder: its path, and its bytes.
pub(crate) type ReadFile<'a> = dyn Fn(&Path) -> Result<(PathBuf, Vec<u8>), FilterError> + 'a;

/// Imports and binds the stages of a pass, with the specialisation constants of its first preset.
pub(crate) fn import_stages(
    filter: &Filter,
    shader: &PassShader,
    read_file: &ReadFile,
) -> Result<Vec<Shader>, FilterError> {
    let stages = shader.stages().into_iter().map(|shader| {
        let (path, bytes) = read_file(&shader.file.path)?;
        Ok(Stage {
            shader,
            path,
            bytes,
        })
    });
    let stages = stages.collect::<Result<Vec<_>, FilterError>>()?;
    let path = &stages[0].path;
    let attempt = |compiler| {
        guard(path, "translates it", || {
            import_with(filter, &stages, compiler)
        })
    };
    let installed = stages[0].import(filter).list_installed()?;
    if installed.is_empty() {
        return attempt(None);
    }
    let installed = installed
        .into_iter()
        .map(|compiler| (compiler.program, compiler));
    let (mut made, by) = try_each(installed, |compiler| attempt(Some(compiler)))?;
    made[0].compiled_by = Some(by);
    Ok(made)
}

/// A stage of a pass, and the file of its shader.
struct Stage {
    shader: PassShader,
    path: PathBuf,
    bytes: Vec<u8>,
}

impl Stage {
    fn import<'a>(&'a self, filter: &'a Filter) -> Import<'a> {
        let folder = match filter.lines.path.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        };
        Import {
            shader: &self.shader.file,
            folder,
            path: &self.path,
            bytes: &self.bytes,
            pictures: Pictures {
                have_origin: filter.convention.origin.is_some(),
                velocity_is_up: filter.convention.velocity_y == Some(VerticalDirection::Up),
            },
            read_file: |path, limit| read_bounded(path, limit).map_err(|error| error.to_string()),
        }
    }
}

/// Imports and binds the stages of a pass by one compiler, if their language needs one.
fn import_with(
    filter: &Filter,
    stages: &[Stage],
    compiler: Option<&Compiler>,
) -> Result<Vec<Shader>, FilterError> {
    let shader = &stages[0].shader;
    let constants = list_constants(filter, shader, &filter.settings(None)?);
    let imports: Vec<Import> = stages.iter().map(|stage| stage.import(filter)).collect();
    let compile = |(stage, import): (&Stage, &Import)| {
        let compiled = import.compile(compiler)?;
        let open = open(filter, &stage.shader, &stage.path, &compiled, &constants)?;
        Ok((compiled, open))
    };
    let made = stages.iter().zip(&imports).map(compile);
    let made = made.collect::<Result<Vec<_>, FilterError>>()?;
    check_names(filter, &shader.file, &imports)?;
    let modules: Vec<&OpenModule> = made.iter().map(|(_, open)| open).collect();
    check_places(filter, shader, &stages[0].path, &modules)?;
    // Kept if a parameter changes the module.
    let is_open = (shader.constants.iter()).any(|(_, value)| value.reads_any(&|_| true));
    let bound = stages.iter().zip(made).map(|(stage, (compiled, open))| {
        Ok(Shader {
            code_hash: hash_code(&compiled),
            compiled: is_open.then(|| Arc::new(compiled)),
            ..bind(filter, &stage.shader, &stage.path, open, &constants)?
        })
    });
    bound.collect()
}

/// Refuses a macro or a condition that changes nothing.
fn check_names(filter: &Filter, shader: &ShaderFile, stages: &[Import]) -> Result<(), FilterError> {
    let Some(idle) = find_idle_name(stages)? else {
        return Ok(());
    };
    let reason = format!(
        "{}: {} changes nothing: neither {} nor a file that it includes names it; allowed: names that occur \
         there; correct it, or leave it out",
        idle.key,
        idle.name,
        shader.path.display()
    );
    Err(FilterError::in_file(&filter.lines.path, None, reason))
}

/// Reads a compiled shader of a pass.
fn open(
    filter: &Filter,
    shader: &PassShader,
    path: &Path,
    compiled: &[u8],
    constants: &[(String, f64)],
) -> Result<OpenModule, FileFault> {
    let find_format = |place, name: &str| find_stored_format(filter, shader, place, name);
    read(&shader.file, path, compiled, constants, &find_format)
}

/// Finds the format in which filter.toml has the texture that a shader stores to; none for a
/// texture that it does not name.
fn find_stored_format(
    filter: &Filter,
    shader: &PassShader,
    ResourceBinding { group, binding }: ResourceBinding,
    name: &str,
) -> Option<StorageFormat> {
    let place = BindingPlace::Bound { group, binding };
    let mut bindings = shader.bindings.iter();
    let explained = bindings.find(|binding| match &binding.place {
        BindingPlace::Named(wanted) => wanted == name,
        other => *other == place,
    });
    let texture = explained.and_then(|binding| binding.texture.as_deref());
    let texture = texture.unwrap_or_else(|| written_texture(name));
    let format = match (filter.texture(texture), texture) {
        (Some(declared), _) => Some(declared.format),
        (None, "output") => Some(filter.convention.output_format()),
        _ => None,
    };
    format.map(crate::Format::stored)
}

/// Makes an imported shader again, with the specialisation constants of settings.
pub(crate) fn specialise(
    filter: &Filter,
    shader: &PassShader,
    made: &Shader,
    settings: &Settings,
) -> Result<Shader, FilterError> {
    let Some(compiled) = &made.compiled else {
        return Ok(made.clone());
    };
    let specialised = guard(&made.path, "translates it", || {
        let constants = list_constants(filter, shader, settings);
        let open = open(filter, shader, &made.path, compiled, &constants)?;
        let bound = bind(filter, shader, &made.path, open, &constants)?;
        let format_of = |name: &str, format| made.stored_format(name).unwrap_or(format);
        Ok(bound
            .store_as(&format_of)
            .expect("these formats worked with other constants"))
    })?;
    Ok(Shader {
        code_hash: made.code_hash.clone(),
        compiled: made.compiled.clone(),
        compiled_by: made.compiled_by.clone(),
        ..specialised
    })
}

/// Lists the specialisation constants of a pass, by name or number, with the values that settings
/// give them.
pub(crate) fn list_constants(
    filter: &Filter,
    shader: &PassShader,
    settings: &Settings,
) -> Vec<(String, f64)> {
    let numbers = settings.list_numbers(filter);
    let constants = shader.constants.iter();
    constants
        .map(|(name, value)| (name.clone(), value.evaluate(&|name| numbers[name])))
        .collect()
}
