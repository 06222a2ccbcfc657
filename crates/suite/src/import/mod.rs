//! From an OBJ file to a scene folder: the model on a stand, a floor and a wall behind it, the camera framed on it, and motion
//! as asked.

mod document;
mod model;
mod motion;
mod set;

use std::fs;
use std::path::{Path, PathBuf};

use frame::FileError;
use tracer::{Scene, load_scene};

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

/// Makes the folder, whole or not at all, and loads what it made.
pub fn import(plan: &ImportPlan) -> Result<Scene, Error> {
    plan.motions.check()?;
    check_new(&plan.out)?;
    let parent = match plan.out.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let wrong = |path: &Path, action, source| FileError::Io {
        path: path.to_owned(),
        action,
        source,
    };
    fs::create_dir_all(parent).map_err(|error| wrong(parent, "create", error))?;
    let staging =
        tempfile::tempdir_in(parent).map_err(|error| wrong(parent, "create a folder in", error))?;

    let model = Model::copied(&plan.model, plan.plain, plan.up, staging.path())?;
    set::write(staging.path(), &model)?;
    let document = document::scene_toml(plan, &model);
    let path = staging.path().join("scene.toml");
    fs::write(&path, document).map_err(|error| wrong(&path, "write", error))?;
    load_scene(staging.path(), None)?;

    let staging = staging.keep();
    fs::rename(&staging, &plan.out).map_err(|error| wrong(&plan.out, "write", error))?;
    Ok(load_scene(&plan.out, None)?)
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
