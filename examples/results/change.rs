//! The smallest change that mends an engine's blur, and what it gains by the search in
//! results/changes.

use std::fs;
use std::path::Path;

use serde::Deserialize;

/// A change of an engine's shape that results/changes has.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    /// What is set: `tile_size=64`.
    pub set: String,
    /// The change, as the beginning of a sentence.
    pub by: String,
}

/// What a change gains in FLIP, as the search printed it.
pub struct Gain {
    /// Mean, with the 95 % CI: `+0.0091 (+0.0021 to +0.0162)`.
    pub text: String,
    /// Scenes and size: `26 scenes at 160x90`.
    pub over: String,
    /// Name of the search's page in results/changes.
    pub page: String,
}

impl Gain {
    /// Returns the mean alone: `+0.0091`.
    pub fn mean(&self) -> &str {
        self.text.split(' ').next().unwrap_or_default()
    }

    /// Reads the gain of an engine's change.
    ///
    /// # Panics
    /// The search of this shape is not kept, or found another smallest change.
    pub fn read(shape: &str, change: &Change) -> Self {
        let page = format!("{}.md", shape.replace(':', "_"));
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../results/changes");
        let text = fs::read_to_string(folder.join(&page)).expect("a change has its search");
        let set = &change.set;
        let verdict = format!("\nsmallest change: `{set}`\n");
        assert!(text.contains(&verdict), "{page} has another than {set}");
        let cell = |begin: &str, at: usize| {
            let line = text.lines().find(|line| line.starts_with(begin))?;
            Some(line.split(" | ").nth(at)?.trim().to_owned())
        };
        let settings = text
            .lines()
            .find_map(|line| line.split_once(", 64 samples"));
        Self {
            text: cell(&format!("| `{set}` |"), 2).expect("the search's table has its change"),
            over: settings.expect("the page names its scenes").0.to_owned(),
            page,
        }
    }
}
