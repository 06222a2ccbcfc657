//! Results: the essential scores of runs, as a file for version control.

use std::collections::{BTreeMap, HashSet};
use std::path::Path;

use frame::{Alignment, Size};
use measure::{Case, Error, IDENTITY, InputFormat, Run, read_text, refuse_failures, to_lines};
use metrics::Metric;
use scene::{Family, SceneId};
use serde::{Deserialize, Serialize};

use crate::groups::group_by;
use crate::numbers::round_to_digits;
use crate::ranking::filters::{RankedFilter, RankedScore, rank_by_score};
use crate::ranking::side_effects::SideEffects;

/// Version of the layout of a file of results.
const RESULTS_FORMAT: u32 = 3;

/// Significant digits of a score.
const DIGITS: usize = 5;

/// The scores of all filters on some scenes, at one picture size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Results {
    /// Version of the layout.
    pub format: u32,
    /// Program name and version.
    pub program: String,
    /// Adapter that the kernels ran on; none if every filter is a command.
    pub adapter: Option<String>,
    /// Picture size.
    pub size: Size,
    /// Mean samples per pixel of the truths.
    pub samples_per_pixel: u32,
    /// Shutter that FLIP* compares with.
    pub common_alignment: Alignment,
    /// Number of the scenes' sealed variants; none for the scenes themselves.
    pub seal: Option<u64>,
    /// One per scene and filter preset.
    pub scores: Vec<ResultScores>,
}

/// The scores of one filter preset on one scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ResultScores {
    /// Name of the scene, without the seal.
    pub scene: SceneId,
    /// Family of the scene.
    pub family: Option<Family>,
    /// Name of the filter alone.
    pub filter: String,
    /// `jump_flood:paper`, followed by everything unusual.
    pub name: String,
    /// Shutter alignment that it is scored against.
    pub alignment: Alignment,
    /// Noise floor of its FLIP.
    pub floor: f64,
    /// Scores of [`Metric::OF_MEANS`] by name, with five digits; omits those that do not apply.
    pub scores: BTreeMap<Metric, f64>,
}

impl Results {
    /// Joins runs of different scenes with the same settings. Leaves out references, input forms
    /// other than the full one, and scenes at another frame rate than their files'.
    ///
    /// # Errors
    /// There is no run, a case failed, two runs differ in size, samples, adapter or seal, or a case
    /// appears twice.
    pub fn from_runs(runs: &[Run]) -> Result<Self, Error> {
        let Some(first) = runs.first() else {
            return Err(Error::Refused("no run to take results from".to_owned()));
        };
        let seal = (first.cases.first()).and_then(|case| case.scene.seal);
        let mut results = Self::without_scores(first, seal);
        let mut known = HashSet::new();
        for run in runs {
            refuse_failures(&run.failures)?;
            for case in &run.cases {
                let header = Self::without_scores(run, case.scene.seal);
                results.refuse_other(&header, &case.scene)?;
                let is_plain = case.input == InputFormat::default() && case.rate.is_none();
                if case.is_reference || !is_plain {
                    continue;
                }
                if !known.insert(&case.id) {
                    return Err(Error::Refused(format!(
                        "{} is in two runs; allowed: each case once",
                        case.id
                    )));
                }
                results.scores.push(ResultScores::of(case));
            }
        }
        Ok(results)
    }

    /// Describes a run of scenes with a seal.
    fn without_scores(run: &Run, seal: Option<u64>) -> Self {
        Self {
            format: RESULTS_FORMAT,
            program: run.program.clone(),
            adapter: run.adapter.as_ref().map(|adapter| adapter.name.clone()),
            size: run.render.size(),
            samples_per_pixel: run.render.samples_per_pixel,
            common_alignment: run.common_alignment,
            seal,
            scores: Vec::new(),
        }
    }

    /// Refuses scores on a scene that were measured with other settings.
    fn refuse_other(&self, other: &Self, scene: &SceneId) -> Result<(), Error> {
        let settings = |results: &Self| {
            let none = || "none".to_owned();
            [
                ("pictures", results.size.to_string()),
                ("samples per pixel", results.samples_per_pixel.to_string()),
                ("shutter in common", results.common_alignment.to_string()),
                ("adapter", results.adapter.clone().unwrap_or_else(none)),
                (
                    "seal",
                    results.seal.map_or_else(none, |seed| seed.to_string()),
                ),
            ]
        };
        let mut both = std::iter::zip(settings(other), settings(self));
        match both.find(|(value, first)| value != first) {
            None => Ok(()),
            Some(((what, value), (_, first))) => Err(Error::Refused(format!(
                "{scene}: {what}: {value}, and the first run has {first}; allowed: runs that differ in their scenes and filters alone"
            ))),
        }
    }

    /// Adds newer scores: each replaces an older one of its case, or joins its scene.
    ///
    /// # Errors
    /// The newer results have another size, adapter or seal, truths with other samples, or a FLIP*
    /// against another shutter.
    pub fn update(&mut self, newer: Self) -> Result<(), Error> {
        let settings = |results: &Self| (results.file_name(), results.samples_per_pixel);
        let [(file, samples), (other, others)] = [settings(self), settings(&newer)];
        if (&file, samples) != (&other, others) {
            return Err(Error::Refused(format!(
                "{other} with {others} samples per pixel cannot go into {file} with {samples}; measure with the same settings, or \
                 all filters anew"
            )));
        }
        if self.common_alignment != newer.common_alignment {
            return Err(Error::Refused(format!(
                "FLIP* of the run is against a {} shutter and that of {file} against a {} one; measure a filter of that shutter too, in \
                 an empty folder",
                newer.common_alignment, self.common_alignment
            )));
        }
        self.program = newer.program;
        self.adapter = newer.adapter;
        for score in newer.scores {
            let is_same =
                |known: &ResultScores| known.scene == score.scene && known.name == score.name;
            if let Some(known) = self.scores.iter_mut().find(|known| is_same(known)) {
                *known = score;
                continue;
            }
            let last = (self.scores.iter()).rposition(|known| known.scene == score.scene);
            let place = last.map_or(self.scores.len(), |last| last + 1);
            self.scores.insert(place, score);
        }
        Ok(())
    }

    /// Reads a file of results.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let refuse = |reason: String| Error::Refused(format!("{}: {reason}", path.display()));
        let results: Self = serde_json::from_str(&read_text(path)?)
            .map_err(|error| refuse(format!("no results of this program: {error}")))?;
        match results.format {
            RESULTS_FORMAT => Ok(results),
            other => Err(refuse(format!(
                "has format {other}; allowed: {RESULTS_FORMAT}"
            ))),
        }
    }

    /// Reads every file of results in a folder, in the order of their names.
    pub fn read_all(folder: &Path) -> Result<Vec<Self>, Error> {
        let refuse =
            |error: std::io::Error| Error::Refused(format!("{}: {error}", folder.display()));
        let mut files = Vec::new();
        for entry in std::fs::read_dir(folder).map_err(refuse)? {
            let path = entry.map_err(refuse)?.path();
            if path
                .extension()
                .is_some_and(|extension| extension == "json")
            {
                files.push(path);
            }
        }
        files.sort();
        files.iter().map(|path| Self::read(path)).collect()
    }

    /// Formats a file of results: a line per case, so that a changed case changes one line.
    pub fn text(&self) -> String {
        to_lines(self) + "\n"
    }

    /// Names the file: `320x180_llvmpipe.json`, or `320x180_llvmpipe_seal1.json`.
    pub fn file_name(&self) -> String {
        let adapter = self.adapter.as_deref().unwrap_or("none");
        let word = adapter.split_whitespace().next().unwrap_or("none");
        let word = word.replace(|letter: char| !letter.is_ascii_alphanumeric(), "");
        let seal = (self.seal).map_or(String::new(), |seed| format!("_seal{seed}"));
        let size = self.size;
        format!("{size}_{}{seal}.json", word.to_lowercase())
    }

    /// Lists the scenes in their order.
    pub fn scenes(&self) -> Vec<&SceneId> {
        let scenes = group_by(&self.scores, |score| &score.scene).into_iter();
        scenes.map(|scores| &scores[0].scene).collect()
    }

    /// Finds the scene where a preset gains the least of what one frame allows: that of the lowest
    /// skill. A scene that no blur of one frame can mend has none. Without any skill, the scene of
    /// the worst FLIP; none if no FLIP is known.
    pub fn worst_of(&self, name: &str) -> Option<&ResultScores> {
        let error = |score: &&ResultScores| {
            let flip = score.score(Metric::FLIP)?;
            let skill = score.score(Metric::SKILL);
            Some((skill.is_some(), skill.map_or(flip, |skill| -skill)))
        };
        (self.scores.iter())
            .filter(|score| score.name == name && error(score).is_some())
            .max_by(|a, b| error(a).partial_cmp(&error(b)).expect("scores are numbers"))
    }

    /// Ranks the filter presets of each shutter by FLIP. The filter that does nothing has a place
    /// in both: its FLIP* is against a centred shutter, if any filter declares one.
    pub fn ranking(&self) -> Vec<Vec<RankedFilter>> {
        let centred = Alignment::Centred;
        let has_centred = self.common_alignment == centred;
        let unblurred = (self.scores.iter())
            .filter(|score| has_centred && score.filter == IDENTITY && score.alignment != centred)
            .filter_map(|score| score.ranked(centred, Metric::CommonFlip));
        let scores: Vec<RankedScore> = (self.scores.iter())
            .filter_map(|score| score.ranked(score.alignment, Metric::FLIP))
            .chain(unblurred)
            .collect();
        rank_by_score(&scores, &[], false)
    }
}

impl ResultScores {
    fn of(case: &Case) -> Self {
        let scores = (Metric::OF_MEANS.into_iter())
            .filter_map(|metric| Some((metric, rounded(case.estimate(metric)?))));
        Self {
            scene: SceneId {
                seal: None,
                ..case.scene.clone()
            },
            family: case.family,
            filter: case.filter.clone(),
            name: case.name(),
            alignment: case.alignment,
            floor: case.floor(Metric::FLIP).map_or(0.0, rounded),
            scores: scores.collect(),
        }
    }

    /// A score; none if it does not apply.
    pub fn score(&self, metric: Metric) -> Option<f64> {
        self.scores.get(&metric).copied()
    }

    fn ranked(&self, alignment: Alignment, metric: Metric) -> Option<RankedScore> {
        Some(RankedScore {
            scene: self.scene.clone(),
            filter: self.filter.clone(),
            name: self.name.clone(),
            alignment,
            value: self.score(metric)?,
            floor: self.floor,
            side_effects: SideEffects::of(|metric| self.score(metric)),
        })
    }
}

fn rounded(value: f64) -> f64 {
    round_to_digits(value, DIGITS)
}
