//! Loading of filters: from a folder, or from those that the program brings along.

mod agreement;

use std::path::{Path, PathBuf};

use frame::{FileError, read_bounded};
use include_dir::{Dir, include_dir};

use crate::shader::Shader;
use crate::{Filter, FilterError, manifest};
use agreement::check_agreement;

static BUILTIN: Dir = include_dir!("$CARGO_MANIFEST_DIR/../../shaders");

/// The largest filter.toml that is read, in bytes.
pub const MAX_MANIFEST_BYTES: u64 = 1 << 20;

/// The largest WGSL file that is read, in bytes. The largest built-in one has a tenth of it.
pub const MAX_KERNEL_BYTES: u64 = 256 << 10;

impl Filter {
    /// Reads and checks a filter folder: `filter.toml` and, unless it is a command, the WGSL file that it names. Both are
    /// regular files of at most [`MAX_MANIFEST_BYTES`] and [`MAX_KERNEL_BYTES`].
    pub fn load(folder: &Path) -> Result<Self, FilterError> {
        let manifest = read_text(&folder.join("filter.toml"), MAX_MANIFEST_BYTES)?;
        parse_filter(folder, &manifest, |path| read_text(&path, MAX_KERNEL_BYTES))
    }

    /// Loads a filter that the program brings along.
    pub fn builtin(name: &str) -> Result<Self, FilterError> {
        let folder = BUILTIN
            .get_dir(name)
            .ok_or_else(|| FilterError::UnknownFilter {
                name: name.to_owned(),
                known: Self::builtin_names(),
            })?;
        let text = |path: &Path| {
            let file = BUILTIN.get_file(path);
            file.and_then(|file| file.contents_utf8())
                .unwrap_or_else(|| panic!("{} is embedded as text", path.display()))
                .to_owned()
        };
        let manifest = text(&folder.path().join("filter.toml"));
        parse_filter(folder.path(), &manifest, |path| Ok(text(&path)))
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

fn parse_filter(
    folder: &Path,
    manifest: &str,
    read_kernels: impl Fn(PathBuf) -> Result<String, FilterError>,
) -> Result<Filter, FilterError> {
    let mut filter = manifest::parse(&folder.join("filter.toml"), manifest)?;
    if filter.command.is_some() {
        return Ok(filter);
    }
    let path = folder.join(format!("{}.wgsl", filter.name));
    filter.shader = Shader::parse(&path, &read_kernels(path.clone())?)?;
    check_agreement(&filter)?;
    Ok(filter)
}

/// Reads a UTF-8 file of a filter folder.
fn read_text(path: &Path, limit: u64) -> Result<String, FilterError> {
    let refuse = |reason: String| FilterError::Folder {
        path: path.to_owned(),
        line: None,
        reason,
    };
    let bytes = read_bounded(path, limit).map_err(|error| {
        let holds = "a filter folder holds filter.toml and <name>.wgsl";
        refuse(match error {
            FileError::Io { source, .. } => format!("cannot be read: {source}; {holds}"),
            FileError::Broken { reason, .. } | FileError::Foreign { reason, .. } => reason,
        })
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let place = error.utf8_error().valid_up_to();
        refuse(format!(
            "is not UTF-8 from byte {place} on; save it as UTF-8"
        ))
    })
}
