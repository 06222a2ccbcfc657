//! From an OBJ file to a scene folder: the model on a stand, a floor and a wall behind it, the camera framed on it, and motion
//! as asked.

mod document;
mod model;
mod motion;
mod set;

use std::fs;
use std::path::{Path, PathBuf};

use frame::FileError;
use tracer::load_scene;

use crate::Error;
use model::Model;
pub use model::Up;
pub use motion::Motions;

/// What is to be imported, and how.
pub struct ImportPlan {
    /// The OBJ file.
    pub model: PathBuf,
    /// The scene's folder, which does not exist yet.
    pub out: PathBuf,
    /// The model's axis that points up.
    pub up: Up,
    /// Leave the model's materials out: it is grey.
    pub plain: bool,
    /// What moves, and how fast.
    pub motions: Motions,
    /// In frames.
    pub exposure: f64,
}

/// What was imported.
pub struct Imported {
    /// What the scene exposes.
    pub exposes: String,
    /// The model's and the set's.
    pub triangles: usize,
}

/// Makes the folder, whole or not at all.
pub fn import(plan: &ImportPlan) -> Result<Imported, Error> {
    plan.motions.check()?;
    check_new(&plan.out)?;
    let parent = match plan.out.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    create(parent)?;
    let staging = tempfile::tempdir_in(parent)
        .map_err(|source| FileError::io(parent, "create a folder in", source))?;
    // A folder of its own, to be renamed: the temporary one vanishes whatever happens.
    let folder = staging.path().join("scene");
    create(&folder)?;

    let model = Model::copied(&plan.model, plan.plain, plan.up, &folder)?;
    set::write(&folder, &model)?;
    let document = document::scene_toml(plan, &model);
    let path = folder.join("scene.toml");
    fs::write(&path, document).map_err(|source| FileError::io(&path, "write", source))?;
    let scene = load_scene(&folder, None)?;

    fs::rename(&folder, &plan.out).map_err(|source| FileError::io(&plan.out, "write", source))?;
    Ok(Imported {
        exposes: scene.exposes,
        triangles: (scene.meshes.iter()).map(|mesh| mesh.triangles.len()).sum(),
    })
}

fn create(folder: &Path) -> Result<(), FileError> {
    fs::create_dir_all(folder).map_err(|source| FileError::io(folder, "create", source))
}

fn check_new(out: &Path) -> Result<(), Error> {
    if out.exists() {
        return Err(Error::Usage(format!(
            "--out {}: exists already; name a folder that is new",
            out.display()
        )));
    }
    // It becomes the scene's name.
    let name = out.file_name().unwrap_or_default().to_string_lossy();
    let allowed = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    match !name.is_empty() && name.chars().all(allowed) {
        true => Ok(()),
        false => Err(Error::Usage(format!(
            "--out {}: the folder's name is the scene's; allowed are letters, digits, _ and -",
            out.display()
        ))),
    }
}
