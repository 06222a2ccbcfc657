//! Shipped scenes for unit tests.

use std::path::{Path, PathBuf};

use crate::load::load_scene;
use crate::model::Scene;

/// The folder of the shipped scenes.
pub(crate) fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

/// Loads a shipped scene by its name.
pub(crate) fn load_test_scene(name: &str) -> Scene {
    load_scene(scenes().join(name), None).expect("the shipped scenes load")
}
