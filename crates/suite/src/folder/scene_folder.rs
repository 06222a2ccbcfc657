//! The folder of a scene's files, below an output folder.

use std::path::{Path, PathBuf};

use tracer::Scene;

use crate::Error;

/// Names the folder of a scene's files below `out`.
pub fn scene_folder(out: &Path, scene: &Scene) -> PathBuf {
    out.join(&scene.name)
}

/// Refuses a folder that holds a scene itself: our pictures may have the names of its textures.
pub(crate) fn refuse_scene(folder: &Path) -> Result<(), Error> {
    match folder.join("scene.toml").exists() {
        false => Ok(()),
        true => Err(Error::Usage(format!(
            "{} holds a scene, whose files would be overwritten; allowed: an output folder that holds none, such as out",
            folder.display()
        ))),
    }
}
