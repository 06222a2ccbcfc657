//! Import of an OBJ file as a scene folder: the model on a stand, floor and wall, a camera framed
//! on it, and motion.

mod document;
mod model;
mod plan;
mod set;

use std::fs;
use std::path::Path;

use frame::{FileError, write_atomically};
use measure::Error;
use scene::load_scene;

use self::model::Model;
pub use self::model::Up;
pub use self::plan::{ImportPlan, Motions};
use crate::files::refuse;

/// Note about a model with materials of an opacity below 1.
const TRANSLUCENT: &str = "some materials have an opacity below 1, so that light passes through them: scene.toml has alpha = \"blended\"";

/// An imported scene.
pub struct Imported {
    /// Sentence about what the scene exposes.
    pub exposes: String,
    /// Triangles of the model and the set.
    pub triangles: usize,
    /// Sentences about what was decided or not read.
    pub notes: Vec<String>,
}

/// Makes the scene folder, complete or not at all.
pub fn import(plan: &ImportPlan) -> Result<Imported, Error> {
    plan.motions.check()?;
    check_new(&plan.out)?;
    let parent = match plan.out.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let fail = |source| FileError::io(parent, "write", source);
    fs::create_dir_all(parent).map_err(fail)?;
    let staging = tempfile::tempdir_in(parent).map_err(fail)?;
    // The inner folder is renamed at the end; the temporary one is always removed.
    let folder = staging.path().join("scene");

    let model = Model::copy(&plan.model, plan.plain, plan.up, &folder)?;
    set::write_set(&folder, &model)?;
    let document = document::scene_toml(plan, &model);
    write_atomically(&folder.join("scene.toml"), document.as_bytes())?;
    let scene = load_scene(&folder, None)?;

    fs::rename(&folder, &plan.out).map_err(|source| FileError::io(&plan.out, "write", source))?;
    let [staged, out] = [&folder, &plan.out].map(|path| path.display().to_string());
    let notes = scene.notes.iter().map(|note| note.replace(&staged, &out));
    let translucent = model.is_translucent.then(|| TRANSLUCENT.to_owned());
    Ok(Imported {
        notes: notes.chain(translucent).collect(),
        exposes: scene.exposes,
        triangles: (scene.meshes.iter()).map(|mesh| mesh.triangles.len()).sum(),
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
