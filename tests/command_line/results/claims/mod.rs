//! Numbers in sentences about engines, against presets' parameters, measured lengths and quoted
//! lines.

mod changes;
mod eevee;
mod findings;
mod lengths;
mod mistakes;

use std::fs;

use filters::{Filter, Settings, Value};
use tests::root;

use super::engines::Engine;

/// Exposure of a shutter of 180 degrees, in frames.
const HALF_FRAME: f64 = 0.5;

/// A preset with its values.
struct Preset {
    filter: Filter,
    settings: Settings,
}

impl Preset {
    fn new(name: &str) -> Self {
        let (filter, preset) = name.split_once(':').unwrap();
        let filter = Filter::builtin(filter).unwrap();
        let settings = filter.settings(Some(preset)).unwrap();
        Self { filter, settings }
    }

    fn number(&self, parameter: &str) -> f64 {
        match &self.settings.values[parameter] {
            Value::Integer(value) => f64::from(*value),
            Value::Real(value) => *value,
            Value::Choice(value) => panic!("{parameter} is {value}"),
        }
    }

    /// Returns all that the preset says of itself: its text and how it differs from its source.
    fn text(&self) -> String {
        let name = &self.settings.preset;
        let preset = (self.filter.presets.iter()).find(|candidate| candidate.name == *name);
        let preset = preset.unwrap();
        let differs = preset.source.iter().flat_map(|origin| &origin.differs);
        let texts = differs.chain([&preset.doc]);
        texts.cloned().collect::<Vec<_>>().join(" ")
    }
}

/// Reads a value that an engine ships.
fn shipped(engine: &Engine, parameter: &str) -> f64 {
    engine.shipped.values[parameter].parse().unwrap()
}

/// Formats a number with at most two decimals: `0.4`.
fn short(number: f64) -> String {
    format!("{}", (100.0 * number).round() / 100.0)
}

/// Spells a small whole number.
fn word(number: f64) -> &'static str {
    match number as u32 {
        2 => "two",
        8 => "eight",
        10 => "ten",
        _ => panic!("spell {number} here"),
    }
}

/// Returns the numbers of a text, without dates, names and other words that hold digits.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '.' && c != '-');
    let words = words.map(|word| word.trim_matches(['.', '-']));
    let plain = words.filter(|word| word.chars().all(|c| c.is_ascii_digit() || c == '.'));
    plain.filter_map(|word| word.parse().ok()).collect()
}

/// Removes each of `phrases` from a text that must have it, and returns the numbers of the rest.
fn unheld(name: &str, text: &str, phrases: &[String]) -> Vec<f64> {
    let mut rest = text.to_owned();
    for phrase in phrases {
        assert!(text.contains(phrase), "{name}: no \"{phrase}\" in: {text}");
        rest = rest.replace(phrase, " ");
    }
    numbers(&rest)
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

/// Returns the window of Kino in the middle and at the end of a trail, by the line that its finding
/// quotes: `(1.2 - t)`.
fn kino_window() -> [String; 2] {
    let page = read("results/findings/unity-ppv2.md");
    let (before, _) = page.split_once(" - t);`").unwrap();
    let middle: f64 = before.rsplit('(').next().unwrap().parse().unwrap();
    [middle, middle - 1.0].map(short)
}

/// Returns the smear of Armory's mode Camera as shipped, in frames: from the pixel to the last of
/// its taps.
fn camera_trail(engine: &Engine) -> f64 {
    let taps = Preset::new(&engine.shape).number("samples");
    shipped(engine, "intensity") * (taps - 1.0) / taps
}
