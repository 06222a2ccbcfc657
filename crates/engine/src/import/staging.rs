//! Scene folders that appear complete or not at all.

use std::fs;
use std::path::Path;

use frame::FileError;
use measure::Error;
use scene::Scene;

use crate::files::refuse;

/// An imported scene.
pub struct Imported {
    /// Sentence about what the scene exposes.
    pub exposes: String,
    /// Triangles of the model and the set.
    pub triangles: usize,
    /// Sentences about what was decided or not read.
    pub notes: Vec<String>,
    /// Lines about keys and losses, for the table that the command prints.
    pub lines: Vec<String>,
}

/// What was written into a folder.
pub struct Written {
    /// The scene, loaded from the folder.
    pub scene: Scene,
    /// As those of an import, beside the scene's own.
    pub notes: Vec<String>,
    pub lines: Vec<String>,
}

/// Makes a new folder by writing it elsewhere first.
pub fn make_folder(
    out: &Path,
    write: impl FnOnce(&Path) -> Result<Written, Error>,
) -> Result<Imported, Error> {
    check_new(out)?;
    let parent = match out.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let fail = |source| FileError::io(parent, "write", source);
    fs::create_dir_all(parent).map_err(fail)?;
    let staging = tempfile::tempdir_in(parent).map_err(fail)?;
    // The inner folder is renamed at the end; the temporary one is always removed.
    let folder = staging.path().join("scene");

    let Written {
        scene,
        notes,
        lines,
    } = write(&folder)?;
    fs::rename(&folder, out).map_err(|source| FileError::io(out, "write", source))?;
    let [staged, out] = [&folder, out].map(|path| path.display().to_string());
    let own = scene.notes.iter().map(|note| note.replace(&staged, &out));
    Ok(Imported {
        notes: own.chain(notes).collect(),
        exposes: scene.exposes,
        triangles: (scene.meshes.iter()).map(|mesh| mesh.triangles.len()).sum(),
        lines,
    })
}

/// Refuses a folder that exists, or with a name that no scene may have.
fn check_new(out: &Path) -> Result<(), Error> {
    if out.exists() {
        return refuse!(out, "exists already; name a folder that is new");
    }
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    let is_allowed = |letter: char| letter.is_ascii_alphanumeric() || "_-".contains(letter);
    if !name.is_empty() && name.chars().all(is_allowed) {
        Ok(())
    } else {
        refuse!(
            out,
            "the folder's name becomes the scene's name; allowed are letters, digits, _ and -"
        )
    }
}
