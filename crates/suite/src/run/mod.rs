//! A finished run: its data, and the files that hold it.

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

use filters::AdapterDescription;
use frame::Alignment;
use serde::{Deserialize, Serialize};
use tracer::RenderSettings;

use self::case::Case;
use self::failure::Failure;
use self::overall::Overall;
use self::sequence::{Frames, Sequence};
use crate::render::settings::list_settings;

/// Version of the layout of `run.json`; it rises when a reader of the old one would misread the new one.
pub const FORMAT: u32 = 6;

/// A finished run: `run.json`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Run {
    /// [`FORMAT`].
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Words of the command line.
    pub command: Vec<String>,
    /// Adapter that the kernels ran on; none where every filter is a command.
    pub adapter: Option<AdapterDescription>,
    /// Settings of frames and truths.
    #[serde(flatten)]
    pub render: RenderSettings,
    /// The shutter alignment that every case is compared with beside its own, so that filters of several alignments have one
    /// score in common: centred where a filter declares that, or else trailing, or else leading.
    pub common_alignment: Alignment,
    /// Frames of each scene; left out where there is one.
    #[serde(default, skip_serializing_if = "Frames::is_one")]
    pub frames: Frames,
    /// Per scene the reference pictures, then one case per filter preset and form of the input, in the order they ran. Of a
    /// sequence the first frame.
    pub cases: Vec<Case>,
    /// Scores over all frames, one entry per case that no frame lacks.
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
}

impl Run {
    /// Finds the first setting that all cases of a run share and two runs do not, with both values.
    pub(crate) fn find_difference(&self, other: &Self) -> Option<(&'static str, String, String)> {
        let both = std::iter::zip(self.list_settings(), other.list_settings());
        let settings = both.map(|((setting, own), (_, its))| (setting, own, its));
        // A run of programs alone has no adapter, and goes with any.
        let adapters = self.adapter.as_ref().zip(other.adapter.as_ref());
        let adapters = adapters.map(|(own, its)| {
            let text = |it: &AdapterDescription| format!("{} ({})", it.name, it.driver);
            ("adapter and driver", text(own), text(its))
        });
        settings.chain(adapters).find(|(_, own, its)| own != its)
    }

    fn list_settings(&self) -> Vec<(&'static str, String)> {
        // A single frame is shown at no rate; run.json leaves it out.
        let Frames { count, per_second } = match self.frames.is_one() {
            true => Frames::default(),
            false => self.frames,
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
