//! Scenes with their bounds.

use frame::Size;
use judge::{BoundedScene, SceneBounds, read_bounds, read_bounds_beside_scenes};
use measure::Error;
use scene::{Location, SceneId};

use super::select_scenes;
use crate::output::print_scene_notes;

/// Loads the named scenes of the folder `root`, or all, with their bounds, including those for
/// pictures of `size`.
pub fn load_scenes(
    root: &Location,
    names: &[String],
    size: Option<Size>,
) -> Result<Vec<BoundedScene>, Error> {
    let choices = select_scenes(root, names)?;
    print_scene_notes(choices.iter().map(|choice| &choice.scene));
    (choices.into_iter())
        .map(|choice| {
            let bounds = read_scene_bounds(root, &choice.folder, &choice.scene.id, size)?;
            Ok(BoundedScene {
                scene: choice.scene,
                bounds,
            })
        })
        .collect()
}

/// Reads the bounds of a scene or a variant. A sealed one, or one at another frame rate, gets only
/// the bounds common to all scenes: the scene's own limits were measured at other speeds.
pub fn read_scene_bounds(
    root: &Location,
    folder: &Location,
    id: &SceneId,
    size: Option<Size>,
) -> Result<SceneBounds, Error> {
    if id.seal.is_some() || id.rate.is_some() {
        read_bounds_beside_scenes(root, size)
    } else {
        read_bounds(root, folder, size)
    }
}
