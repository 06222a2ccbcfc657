//! Shipped scenes for unit tests.

use std::path::Path;

use crate::load::load_scene;
use crate::scene::Scene;

/// Loads a shipped scene by its name.
pub(crate) fn load_test_scene(name: &str) -> Scene {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    load_scene(folder.join(name), None).expect("the shipped scenes load")
}
