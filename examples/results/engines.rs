//! Engines with the presets that they ship, and their scores.

use std::collections::BTreeMap;

use judge::RankedFilter;
use measure::IDENTITY;
use serde::Deserialize;

use super::change::{Change, Gain};

/// Engines' shipped presets, without scores.
const ENGINES: &str = include_str!("../../results/engines.toml");

/// An engine with its shipped preset.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Engine {
    pub name: String,
    /// Preset that equals the engine's default, but for its length: 180 degrees.
    pub shape: String,
    /// What the engine's own length needs.
    pub shipped: Shipped,
    /// Measured smear as shipped, in degrees of the frame.
    pub length: u32,
    /// Measured smear of `shape`, in degrees of the frame.
    pub at_180: u32,
    /// The engine's own words on its length, with their place; or `none`.
    pub states: String,
    /// Commit that the preset follows.
    pub commit: String,
    /// Date of that commit.
    pub date: Option<String>,
    /// Date when that commit was compared with the engine's newest.
    pub compared: Option<String>,
    /// What its newest has instead, if that is another blur.
    pub moved_on: Option<String>,
    pub default: DefaultState,
    /// Place in its code that says so.
    pub default_at: String,
    /// Its mistake, in one sentence.
    pub wrong: String,
    /// The smallest change that the search found.
    pub change: Option<Change>,
    /// Page below results/findings with its code.
    pub finding: Option<String>,
    /// True if the preset is compared with a transcription only, since its shader runs nowhere
    /// here.
    #[serde(default)]
    pub transcription_alone: bool,
}

/// Whether an engine blurs without being asked to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum DefaultState {
    /// It blurs.
    On,
    /// It has a switch, or a strength, that is off.
    Off,
    /// It blurs once someone adds the effect.
    Added,
}

impl DefaultState {
    /// Answers whether it is off by default.
    pub fn text(self) -> &'static str {
        match self {
            Self::On => "no",
            Self::Off => "yes",
            Self::Added => "until added",
        }
    }
}

/// What the engine's own length needs on top of its preset.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Shipped {
    /// Exposure that is handed over, in frames at 60 per second; 1 for an engine that has none.
    pub exposure: f64,
    /// Values of parameters.
    #[serde(default)]
    pub values: BTreeMap<String, String>,
    /// True if it sees the camera's motion only.
    #[serde(default)]
    pub camera_moves: bool,
    /// True if its length depends on the size of the picture.
    #[serde(default)]
    pub full_size: bool,
}

impl Engine {
    /// Names its page on the site, below results: `engines/unity_hdrp_quality_medium.md`.
    pub fn page_name(&self) -> String {
        let name = self.name.to_lowercase();
        let words = name.split(|letter: char| !letter.is_ascii_alphanumeric());
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        format!("engines/{}.md", words.join("_"))
    }
}

/// Lists the engines of results/engines.toml.
pub fn list_engines() -> Vec<Engine> {
    #[derive(Deserialize)]
    struct File {
        engine: Vec<Engine>,
    }
    let file: File = toml::from_str(ENGINES).expect("engines.toml lists engines");
    file.engine
}

/// An engine with its scores.
pub struct Measured<'a> {
    pub engine: Engine,
    /// Scores of its shape; none if the file of results lacks them.
    pub shape: Option<Shape<'a>>,
    /// Gain of its change, if it has one.
    pub gain: Option<Gain>,
}

/// The scores of an engine's shape.
pub struct Shape<'a> {
    pub ranked: &'a RankedFilter,
    /// Mean FLIP of no blur, under the same shutter.
    pub none: f64,
}

/// Finds the scores of the engines, the worst against no blur first, and those without at the end.
pub fn measured(groups: &[Vec<RankedFilter>]) -> Vec<Measured<'_>> {
    let find = |name: &str| groups.iter().flatten().find(|filter| filter.name == name);
    let score = |engine: &Engine| {
        let ranked = find(&engine.shape)?;
        let group = (groups.iter()).find(|group| group[0].alignment == ranked.alignment)?;
        let none = group.iter().find(|filter| filter.filter == IDENTITY)?.mean;
        Some(Shape { ranked, none })
    };
    let measure = |engine: Engine| Measured {
        shape: score(&engine),
        gain: (engine.change.as_ref()).map(|change| Gain::read(&engine.shape, change)),
        engine,
    };
    let mut all: Vec<Measured> = list_engines().into_iter().map(measure).collect();
    let badness = |measured: &Measured| {
        let shape = measured.shape.as_ref();
        shape.map_or(f64::NEG_INFINITY, |shape| shape.ranked.mean / shape.none)
    };
    all.sort_by(|a, b| badness(b).total_cmp(&badness(a)));
    all
}
