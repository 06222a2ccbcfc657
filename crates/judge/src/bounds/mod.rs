//! Bounds: limits on the scores of a filter on a scene.

mod asked;
mod file;
mod known;
mod length;
mod sized;

use frame::Size;
use metrics::Metric;
use scene::{Location, Scene};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

use measure::{Error, Frames};

pub use asked::{bound_subframes, check_lengths, size_for_bounds};
pub use file::{BoundsFile, FilterBounds, Margin, read_bounds_file};
pub use known::{check_names, require_bounds};
pub use length::Length;
pub use sized::sized_bounds_file;

/// Name of the file of bounds, next to the scenes and next to one scene. [`sized_bounds_file`]
/// names those for one picture size.
pub const BOUNDS_FILE: &str = "bounds.toml";

/// Bounds by score.
pub type Bounds = BTreeMap<Metric, Bound>;

/// Limit on one score.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// Highest value allowed; lowest if higher is better; largest distance from the ideal if that
    /// is a value.
    pub limit: f64,
    /// Size of the pictures that it is for; none if for all.
    pub size: Option<Size>,
    /// Length of the sequence that it is for; none for a score of a single frame.
    pub length: Option<Length>,
    /// Reason in one line: what was measured, and how it leads to the limit.
    pub why: String,
    /// Consequence of breaking it.
    pub level: Level,
    /// File and line.
    pub place: String,
}

/// Consequence of breaking a bound.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Level {
    /// The check fails.
    #[default]
    Required,
    /// The report mentions it.
    Report,
}

/// A scene with its bounds.
#[derive(Clone, Debug)]
pub struct BoundedScene {
    /// The scene.
    pub scene: Scene,
    /// Its bounds.
    pub bounds: SceneBounds,
}

/// Bounds of one scene, for every filter.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneBounds {
    /// Bounds of all scenes, then this scene's own, which override them.
    pub files: Vec<BoundsFile>,
}

impl SceneBounds {
    /// Returns the bounds of a filter preset. A later bound overrides an earlier one of the same
    /// metric: first all scenes' file, then this scene's; in each the default, then the filter's,
    /// then its preset's.
    pub fn of(&self, filter: &str, preset: &str) -> Bounds {
        let full_name = format!("{filter}:{preset}");
        let mut bounds = Bounds::new();
        for file in &self.files {
            let of_filter = [filter, &full_name].map(|name| file.filters.get(name));
            let named = of_filter.into_iter().flatten().map(|table| &table.bounds);
            for table in std::iter::once(&file.default).chain(named) {
                bounds.extend(table.clone());
            }
        }
        bounds
    }

    /// Removes limits for other picture sizes.
    pub fn at(self, size: Size) -> Self {
        self.retain(|bound| bound.size.is_none_or(|bound_size| bound_size == size))
    }

    /// Removes limits on sequences of another length.
    pub fn over(self, frames: Frames) -> Self {
        self.retain(|bound| bound.length.is_none_or(|length| length.holds_for(frames)))
    }

    fn retain(mut self, is_kept: impl Fn(&Bound) -> bool) -> Self {
        for file in &mut self.files {
            for bounds in file.tables_mut() {
                bounds.retain(|_, bound| is_kept(bound));
            }
        }
        self
    }
}

/// Reads the bounds of all scenes and of this scene: `bounds.toml` if there is one, then, if a size
/// is given, the file for pictures of that size, which overrides the preceding `bounds.toml`.
pub fn read_bounds(
    root: impl Into<Location>,
    scene_folder: impl Into<Location>,
    size: Option<Size>,
) -> Result<SceneBounds, Error> {
    let root = root.into();
    let mut files = read_folder(&root, size)?;
    let beside_scene = read_folder(&scene_folder.into(), size)?;
    if let Some(margin) = (beside_scene.iter()).find_map(|file| file.margins.values().next()) {
        return Err(Error::Refused(format!(
            "{}: a margin is for all scenes together; it belongs into {}",
            margin.place,
            root.join(BOUNDS_FILE)
        )));
    }
    files.extend(beside_scene);
    Ok(SceneBounds { files })
}

/// Reads only the bounds of all scenes, as [`read_bounds`] does.
pub fn read_bounds_beside_scenes(
    root: impl Into<Location>,
    size: Option<Size>,
) -> Result<SceneBounds, Error> {
    let files = read_folder(&root.into(), size)?;
    Ok(SceneBounds { files })
}

/// Reads the files of bounds in one folder.
fn read_folder(folder: &Location, size: Option<Size>) -> Result<Vec<BoundsFile>, Error> {
    let any = folder.join(BOUNDS_FILE);
    let any = any.exists().then(|| read_bounds_file(&any));
    let sized = size.and_then(|size| {
        let file = folder.join(sized_bounds_file(size));
        file.exists().then(|| sized::read_sized_bounds(&file, size))
    });
    any.into_iter().chain(sized).collect()
}
