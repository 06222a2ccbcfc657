//! Import of an OBJ file as a scene folder: the model on a stand, floor and wall behind it, a camera framed on it, and motion.

mod document;
mod folder;
mod model;
mod motion;
mod plan;
mod set;

use std::fs;
use std::path::Path;

use frame::FileError;
use suite::Error;
use tracer::load_scene;

use self::folder::{check_new, create};
use self::model::Model;
pub use self::model::Up;
pub use self::motion::Motions;
pub use self::plan::ImportPlan;

/// An imported scene.
pub struct Imported {
    /// Sentence that says what the scene exposes.
    pub exposes: String,
    /// Triangles of the model and the set.
    pub triangles: usize,
}

/// Makes the scene folder, whole or not at all.
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
    // The inner folder is renamed at the end; the temporary one vanishes whatever happens.
    let folder = staging.path().join("scene");
    create(&folder)?;

    let model = Model::copy(&plan.model, plan.plain, plan.up, &folder)?;
    set::write_set(&folder, &model)?;
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
