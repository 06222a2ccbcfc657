//! Engines with the presets that they ship, and their scores.

use judge::RankedFilter;
use serde::Deserialize;
use suite::IDENTITY;

/// Engines' shipped presets, without scores.
const ENGINES: &str = include_str!("../../results/engines.toml");

/// An engine with its shipped preset.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Engine {
    pub name: String,
    /// Preset that equals the engine's default.
    pub ships: String,
    /// Its mistake, in one sentence.
    pub wrong: String,
    /// The smallest measured change that improves most.
    pub change: Option<Change>,
    /// Page below results/findings with its code.
    pub finding: Option<String>,
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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Change {
    pub preset: String,
    /// The change, as the beginning of a sentence.
    pub by: String,
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
    pub shipped: &'a RankedFilter,
    /// Mean FLIP of no blur, under the same shutter.
    pub none: f64,
    /// Mean FLIP after the change.
    pub changed: Option<f64>,
}

/// Finds the scores of the engines, the worst against no blur first.
pub fn measured(groups: &[Vec<RankedFilter>]) -> Vec<Measured<'_>> {
    let find = |name: &str| groups.iter().flatten().find(|own| own.name == name);
    let measure = |engine: Engine| {
        let shipped = find(&engine.ships)?;
        let group = (groups.iter()).find(|group| group[0].alignment == shipped.alignment)?;
        let none = group.iter().find(|own| own.filter == IDENTITY)?.mean;
        let change = engine.change.as_ref();
        let changed = change.and_then(|change| Some(find(&change.preset)?.mean));
        Some(Measured {
            engine,
            shipped,
            none,
            changed,
        })
    };
    let mut all: Vec<Measured> = list_engines().into_iter().filter_map(measure).collect();
    let badness = |own: &Measured| own.shipped.mean / own.none;
    all.sort_by(|a, b| badness(b).total_cmp(&badness(a)));
    all
}
