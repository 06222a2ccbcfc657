//! Loading of filters, from a folder or built in.

mod agreement;
mod stages;

use std::path::Path;

use frame::{FileError, read_bounded};
use include_dir::{Dir, include_dir};
use shader_import::{MAX_MODULE_BYTES, stays_below};

use crate::bind::import_stages;
use crate::shader::{Shader, hash_code};
use crate::{Filter, FilterError, manifest};

static BUILTIN: Dir = include_dir!("$CARGO_MANIFEST_DIR/../../shaders");

/// The largest filter.toml that is read, in bytes.
pub const MAX_MANIFEST_BYTES: u64 = 1 << 20;

/// The largest WGSL file that is read, in bytes. The largest built-in one is a tenth of it.
pub const MAX_KERNEL_BYTES: u64 = 256 << 10;

impl Filter {
    /// Reads and checks a filter folder: `filter.toml` and, unless it is a command, the WGSL file
    /// that it names. Both are regular files of at most [`MAX_MANIFEST_BYTES`] and
    /// [`MAX_KERNEL_BYTES`].
    pub fn load(folder: &Path) -> Result<Self, FilterError> {
        let read = |path: &Path, limit| {
            // A device, a FIFO or a folder is refused later, with a better message.
            if path.is_file() && !stays_below(folder, path) {
                let reason = "is a link to a file outside of the filter's folder; copy the file in its place";
                return Err(FilterError::in_file(path, None, reason));
            }
            read_bytes(path, limit)
        };
        let path = folder.join("filter.toml");
        let manifest = as_text(&path, read(&path, MAX_MANIFEST_BYTES)?)?;
        let mut filter = parse_filter(folder, &manifest, read)?;
        filter.folder = Some(folder.to_owned());
        Ok(filter)
    }

    /// Loads a built-in filter.
    pub fn builtin(name: &str) -> Result<Self, FilterError> {
        let folder = BUILTIN.get_dir(name).ok_or_else(|| {
            FilterError::Refused(format!(
                "no built-in filter is called \"{name}\"; allowed: {}; a folder of your own is given by its path, such as ./{name}",
                Self::builtin_names().join(", ")
            ))
        })?;
        let manifest = builtin_text(&folder.path().join("filter.toml"));
        parse_filter(folder.path(), manifest, |path, _| {
            Ok(builtin_text(path).into())
        })
    }

    /// Lists the built-in filters in alphabetical order.
    pub fn builtin_names() -> Vec<String> {
        let mut names: Vec<String> = BUILTIN
            .dirs()
            .map(|folder| folder.path().display().to_string())
            .collect();
        names.sort();
        names
    }
}

/// Returns the text of a file of a built-in filter.
fn builtin_text(path: &Path) -> &'static str {
    let file = BUILTIN.get_file(path);
    file.and_then(|file| file.contents_utf8())
        .unwrap_or_else(|| panic!("{} is embedded as text", path.display()))
}

/// Reads filter.toml or the kernels of a loaded filter again.
pub(crate) fn read_text(filter: &Filter, path: &Path) -> Result<String, FilterError> {
    match filter.folder {
        None => Ok(builtin_text(path).to_owned()),
        Some(_) => as_text(path, read_bytes(path, MAX_MANIFEST_BYTES)?),
    }
}

fn parse_filter(
    folder: &Path,
    manifest: &str,
    read_file: impl Fn(&Path, u64) -> Result<Vec<u8>, FilterError>,
) -> Result<Filter, FilterError> {
    let mut filter = manifest::parse(&folder.join("filter.toml"), manifest)?;
    if filter.command.is_some() {
        return Ok(filter);
    }
    let path = folder.join(format!("{}.wgsl", filter.name));
    let mut shaders = Vec::new();
    if filter.passes.iter().any(|pass| pass.shader.is_none()) {
        let text = as_text(&path, read_file(&path, MAX_KERNEL_BYTES)?)?;
        shaders.push(Shader::parse(&path, &text)?);
    }
    for index in 0..filter.passes.len() {
        if let Some(shader) = &filter.passes[index].shader {
            let read_shader = |file: &Path| {
                let path = folder.join(file);
                let bytes = read_file(&path, MAX_MODULE_BYTES)?;
                Ok((path, bytes))
            };
            let mut stages = import_stages(&filter, shader, &read_shader)?;
            let mut entries = stages.iter().flat_map(|stage| &stage.entry_points);
            let is_noisy = entries.any(|entry| entry.draws_noise);
            (stages[0].entry_points.iter_mut()).for_each(|entry| entry.draws_noise = is_noisy);
            let pass = &mut filter.passes[index];
            pass.shaders = (shaders.len()..shaders.len() + stages.len()).collect();
            shaders.extend(stages);
        }
    }
    filter.content_hash = hash_content(manifest, &shaders);
    filter.shaders = shaders;
    filter.check_agreement()?;
    Ok(filter)
}

/// Hashes filter.toml and the kernels.
fn hash_content(manifest: &str, shaders: &[Shader]) -> String {
    let mut hasher = blake3::Hasher::new();
    hasher.update(hash_code(manifest.as_bytes()).as_bytes());
    for shader in shaders {
        hasher.update(shader.code_hash.as_bytes());
    }
    hasher.finalize().to_hex().to_string()
}

/// Reads a file of a filter folder.
fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>, FilterError> {
    read_bounded(path, limit).map_err(|error| {
        let holds = "a filter folder holds filter.toml, and <name>.wgsl or the shaders that its passes name";
        let reason = match error {
            FileError::Io { source, .. } => format!("cannot be read: {source}; {holds}"),
            FileError::Broken { reason, .. } | FileError::Foreign { reason, .. } => reason,
        };
        FilterError::in_file(path, None, reason)
    })
}

fn as_text(path: &Path, bytes: Vec<u8>) -> Result<String, FilterError> {
    String::from_utf8(bytes).map_err(|error| {
        let place = error.utf8_error().valid_up_to();
        let reason = format!("is not UTF-8 from byte {place} on; save it as UTF-8");
        FilterError::in_file(path, None, reason)
    })
}
