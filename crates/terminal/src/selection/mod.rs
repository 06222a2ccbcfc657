//! Selection of scenes and filters by their names on the command line.

mod bounded_scenes;
mod filters;
mod names;
mod scenes;

pub use self::bounded_scenes::{load_scenes, read_scene_bounds};
pub use self::filters::{Programs, filter_folders, load_filters, select_filters};
pub use self::names::{choose_names, find_twin, is_pattern, match_names, suggest_names};
pub use self::scenes::{SceneChoice, select_ingested_scenes, select_scenes, split_scene};
