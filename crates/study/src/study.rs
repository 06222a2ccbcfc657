//! A study: the pictures of a run that people compare.

use std::collections::HashSet;
use std::fmt::Display;
use std::hash::Hash;

use frame::Alignment;
use serde::{Deserialize, Serialize};
use suite::{Frames, MAX_FRAMES};
use tracer::SceneId;

/// Upper limit on the filters of one shutter that people compare.
pub const MAX_ASKED_FILTERS: usize = 64;
/// Upper limit on the scenes that people see.
pub const MAX_ASKED_SCENES: usize = 256;
/// Time per question, in seconds: a guess, made before anybody answered.
pub const SECONDS_PER_QUESTION: f64 = 8.0;

/// The pictures that people compare, and their identity. Equal studies ask about equal pictures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Study {
    /// Width of the pictures in pixels.
    pub width: u32,
    /// Height of the pictures in pixels.
    pub height: u32,
    /// Frames of each clip, and how fast they play; a clip of one frame is a picture.
    pub frames: Frames,
    /// Scenes, each with clips of every filter.
    pub scenes: Vec<SceneId>,
    /// Shutters, whose filters are compared with one another.
    pub shutters: Vec<StudyShutter>,
    /// Largest number of pairs in a session, checks not counted.
    pub most_pairs: usize,
    /// BLAKE3 hash of all pictures.
    pub pictures: String,
}

/// Filters of one shutter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudyShutter {
    /// Alignment of the shutter. Filters of two shutters have two truths, and are not compared.
    pub alignment: Alignment,
    /// Names of the filters, as run.json has them: `jump_flood:paper`.
    pub filters: Vec<String>,
    /// Hashes of the truths' inputs, per scene and frame.
    pub truth_hashes: Vec<Vec<String>>,
    /// Numbers of the scenes where the truth clearly differs from the sharp frame.
    #[serde(rename = "telling_scenes")]
    pub blurred_scenes: Vec<usize>,
}

impl Study {
    /// Returns the hash of the study.
    pub fn id(&self) -> String {
        let text = serde_json::to_string(self).expect("a study is plain data");
        blake3::hash(text.as_bytes()).to_hex().to_string()
    }

    /// Counts the pairs of a session that asks about every pair of filters on every scene.
    pub fn all_pairs(&self) -> usize {
        let pairs =
            |shutter: &StudyShutter| shutter.filters.len() * (shutter.filters.len() - 1) / 2;
        self.scenes.len() * self.shutters.iter().map(pairs).sum::<usize>()
    }

    /// Counts the fewest pairs that compare every filter: one round per shutter.
    pub fn fewest_pairs(&self) -> usize {
        let filters = self.shutters.iter().map(|shutter| shutter.filters.len());
        filters.map(|count| round_size(count, 1)).sum()
    }

    /// Refuses an invalid study; the error says what is wrong and what is allowed.
    pub fn check(&self) -> Result<(), String> {
        if !(1..=MAX_ASKED_SCENES).contains(&self.scenes.len()) {
            return Err(format!(
                "has this many scenes: {}; allowed: 1 to {MAX_ASKED_SCENES}",
                self.scenes.len()
            ));
        }
        refuse_twice("scene", &self.scenes)?;
        let rate = self.frames.per_second;
        if !(1..=MAX_FRAMES).contains(&self.frames.count) || !rate.is_finite() || rate <= 0.0 {
            return Err(format!(
                "has {} frames at {} per second; allowed: 1 to {MAX_FRAMES}, above 0 per second",
                self.frames.count, rate
            ));
        }
        let alignments = self.shutters.iter().map(|own| own.alignment);
        refuse_twice("shutter", alignments)?;
        if self.shutters.is_empty() {
            return Err("asks about no filter; allowed: two or more of one shutter".to_owned());
        }
        (self.shutters.iter()).try_for_each(|own| self.check_shutter(own))?;
        match self.most_pairs >= self.fewest_pairs() {
            true => Ok(()),
            false => Err(format!(
                "allows {} pairs in a session; allowed: {} or more, so that every filter is shown",
                self.most_pairs,
                self.fewest_pairs()
            )),
        }
    }

    fn check_shutter(&self, own: &StudyShutter) -> Result<(), String> {
        let alignment = &own.alignment;
        if !(2..=MAX_ASKED_FILTERS).contains(&own.filters.len()) {
            return Err(format!(
                "has this many filters of the {alignment} shutter: {}; allowed: 2 to {MAX_ASKED_FILTERS}",
                own.filters.len()
            ));
        }
        refuse_twice("filter", &own.filters)?;
        if let Some(name) = own.filters.iter().find(|name| name.starts_with('[')) {
            return Err(format!(
                "asks about a filter \"{name}\"; brackets mark the truth and the sharp frame"
            ));
        }
        let frames = self.frames.count as usize;
        let are_whole = own.truth_hashes.iter().all(|hashes| hashes.len() == frames);
        if !are_whole || own.truth_hashes.len() != self.scenes.len() {
            return Err(format!("lacks hashes of truths of the {alignment} shutter"));
        }
        let is_scene = |scene: &usize| *scene < self.scenes.len();
        match !own.blurred_scenes.is_empty() && own.blurred_scenes.iter().all(is_scene) {
            true => Ok(()),
            false => Err(format!(
                "has no scene on which the truth of the {alignment} shutter differs from the sharp frame"
            )),
        }
    }
}

/// Counts the pairs of a round: filters in a circle, each compared with the one at this distance.
pub(super) fn round_size(filters: usize, distance: usize) -> usize {
    match 2 * distance == filters {
        true => distance,
        false => filters,
    }
}

fn refuse_twice<T: Eq + Hash + Display>(
    what: &str,
    names: impl IntoIterator<Item = T>,
) -> Result<(), String> {
    let mut seen = HashSet::new();
    match names.into_iter().find_map(|name| seen.replace(name)) {
        None => Ok(()),
        Some(name) => Err(format!("asks about the {what} \"{name}\" twice")),
    }
}
