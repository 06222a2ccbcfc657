//! Selection of scenes and filters by their names, as the command line has them.

mod filters;
mod path;
mod scenes;

pub use self::filters::{Programs, select_filters};
pub use self::scenes::{SceneChoice, select_scenes};
