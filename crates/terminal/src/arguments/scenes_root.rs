//! The folder of scenes: on disk, or the program's own.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PathBufValueParser, TypedValueParser};
use scene::Location;

/// Default folder of scenes.
const DEFAULT: &str = "scenes";

/// Choice of the folder of scenes.
#[derive(Clone, Debug, Args)]
pub struct RootArgs {
    /// Folder of scenes, and of bounds.toml with limits and margins; `built-in` means the program's
    /// own [default: scenes, or built-in if there is no such folder].
    #[arg(long, value_name = "FOLDER", value_parser = PathBufValueParser::new().map(scenes_root), default_value_t = default_scenes_root(), hide_default_value = true)]
    pub scenes_dir: Location,
}

/// Finds the default folder of scenes: `scenes`, or the program's own if there is no such folder.
pub fn default_scenes_root() -> Location {
    let folder = PathBuf::from(DEFAULT);
    if folder.exists() {
        folder.into()
    } else {
        Location::of_bundle(&catalogue::SCENES)
    }
}

/// Finds the folder that `--scenes-dir` names: the program's own scenes, or a path.
fn scenes_root(path: PathBuf) -> Location {
    if path.to_str() == Some(catalogue::SCENES.name) {
        Location::of_bundle(&catalogue::SCENES)
    } else {
        path.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_bare_name_means_the_scenes_of_the_program() {
        assert!(scenes_root("built-in".into()).bundle.is_some());
        for path in ["./built-in", "scenes", "built-in/fan"] {
            assert!(scenes_root(path.into()).bundle.is_none(), "{path}");
        }
    }
}
