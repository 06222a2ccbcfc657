//! A finished run: its data and its files.

pub mod case;
mod case_scores;
pub mod error_maps;
pub mod failure;
pub mod file;
pub mod layers;
pub mod overall;
mod scaling;
pub mod sequence;
pub mod stored;

use std::collections::BTreeMap;

use filters::AdapterDescription;
use frame::Alignment;
use scene::SceneId;
use serde::{Deserialize, Serialize};
use tracer::RenderSettings;

use self::case::Case;
use self::failure::Failure;
use self::overall::Overall;
use self::sequence::{Frames, Sequence};
use crate::render::settings::list_settings;

/// Version of the layout of `run.json`; it rises if a reader of the old one would misread the new
/// one.
pub const FORMAT: u32 = 7;

/// A finished run: `run.json`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Run {
    /// [`FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Words of the command line.
    pub command: Vec<String>,
    /// Adapter that the kernels ran on; none if every filter is a command.
    pub adapter: Option<AdapterDescription>,
    /// Settings of frames and truths.
    #[serde(flatten)]
    pub render: RenderSettings,
    /// Shutter alignment that every case is compared with in addition to its own, so that filters
    /// of several alignments have one score in common: centred if a filter declares that, or else
    /// trailing, or else leading.
    pub common_alignment: Alignment,
    /// Frames of each scene; left out if there is one.
    #[serde(default, skip_serializing_if = "Frames::is_one")]
    pub frames: Frames,
    /// Per scene the reference pictures, then one case per filter preset and input form, in the
    /// order of their runs. For a sequence, cases of the first frame.
    pub cases: Vec<Case>,
    /// Scores over all frames, one entry per case that every frame has.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sequences: Vec<Sequence>,
    /// Cases that failed, with their reasons; they have no scores.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub failures: Vec<Failure>,
    /// Means over the scenes.
    #[serde(default)]
    pub overall: Vec<Overall>,
    /// Number of cases that were measured before and read back; not in run.json.
    #[serde(skip)]
    pub read_back: usize,
    /// Seconds that each scene took, with its truths and all frames; not in run.json, and empty for
    /// a run that was read.
    #[serde(skip)]
    pub seconds: BTreeMap<SceneId, f64>,
}

impl Run {
    /// Finds the first shared setting of a run's cases that differs between two runs, with both
    /// values.
    pub(crate) fn find_difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        let both = std::iter::zip(self.list_settings(), other.list_settings());
        let settings =
            both.map(|((setting, value), (_, other_value))| (setting, value, other_value));
        // A run of programs only has no adapter, and matches any.
        let adapters = self.adapter.as_ref().zip(other.adapter.as_ref());
        let adapters = adapters.map(|(value, other_value)| {
            let text =
                |adapter: &AdapterDescription| format!("{} ({})", adapter.name, adapter.driver);
            ("adapter and driver", text(value), text(other_value))
        });
        settings
            .chain(adapters)
            .find(|(_, value, other_value)| value != other_value)
    }

    fn list_settings(&self) -> Vec<(&'static str, String)> {
        // A single frame has no frame rate; run.json leaves it out.
        let Frames { count, per_second } = if self.frames.is_one() {
            Frames::default()
        } else {
            self.frames
        };
        let mut settings = vec![
            ("program", self.program.clone()),
            ("common shutter", self.common_alignment.to_string()),
            (
                "number of frames",
                format!("{count} at {per_second} per second"),
            ),
        ];
        settings.extend(list_settings(&self.render));
        settings
    }
}
