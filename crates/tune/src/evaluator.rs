//! Scoring of candidates on scenes.

use std::collections::{BTreeMap, HashMap};
use std::sync::mpsc;

use filters::{Blur, FilterError, Gpu, Kernels, Settings, Value};
use frame::Size;
use measure::{Error, FilterChoice, Monitor, filter_input};
use serde::{Deserialize, Serialize};
use tracer::TraceError;

use crate::candidate::{Blurred, Candidate};
use crate::loss::{mean_log_ratio, worst_bleed};
use crate::target::{RenderedScene, SceneScore, SceneScores, Target};

/// Rounds that alternate between one candidate and the start; odd, so that the median is one of
/// them.
const ROUNDS: usize = 5;

/// A filter on scenes that are loaded once; remembers earlier scores.
pub struct Evaluator<'a> {
    /// Adapter that candidates run on; none if the filter is a program.
    gpu: Option<&'a Gpu>,
    /// The filter with tuning's start values.
    pub choice: FilterChoice,
    /// The scenes.
    pub targets: Vec<Target<'a>>,
    /// True if mattes are blurred as well, which doubles the time, about.
    bleed: bool,
    /// Monitor that can end the work.
    pub(crate) monitor: Monitor,
    /// The filter's kernels; none if it is a program.
    kernels: Option<Kernels<'a>>,
    /// Scores by scene for each candidate.
    memory: HashMap<String, SceneScores>,
}

impl<'a> Evaluator<'a> {
    /// Compiles the filter's kernels; measures nothing yet.
    pub fn new(
        gpu: Option<&'a Gpu>,
        choice: &FilterChoice,
        scenes: &'a [RenderedScene],
        bleed: bool,
        monitor: Monitor,
    ) -> Result<Self, Error> {
        let targets: Vec<Target> = (scenes.iter())
            .map(|scene| Target::new(scene, &choice.filter.name, &choice.preset))
            .collect::<Result<_, _>>()?;
        let kernels = match choice.filter.command {
            Some(_) => None,
            None => {
                let gpu = gpu.expect("an adapter was opened for the kernels");
                Some(Kernels::compile(gpu, &choice.filter)?)
            }
        };
        Ok(Self {
            gpu,
            choice: choice.clone(),
            targets,
            bleed,
            monitor,
            kernels,
            memory: HashMap::new(),
        })
    }

    /// Lists the indices of all scenes.
    pub(crate) fn all_scenes(&self) -> Vec<usize> {
        (0..self.targets.len()).collect()
    }

    /// Remembers earlier scores.
    pub(crate) fn remember(&mut self, settings: &Settings, scores: &SceneScores) {
        let known = self.memory.entry(memory_key(settings)).or_default();
        known.extend(scores.clone());
    }

    /// Scores one candidate on some scenes, by their indices. Calls `on_score` with each score as
    /// soon as it is known.
    ///
    /// # Errors
    /// The filter fails, or `on_score` returned false before all scenes had a score, which cancels
    /// the work.
    pub(crate) fn score(
        &mut self,
        settings: &Settings,
        scenes: &[usize],
        mut on_score: impl FnMut(usize, &SceneScore) -> bool,
    ) -> Result<SceneScores, Error> {
        let name = |scene: usize| &self.targets[scene].scene.name;
        let key = memory_key(settings);
        let mut scores = self.memory.get(&key).cloned().unwrap_or_default();
        let (known, missing): (Vec<usize>, Vec<usize>) =
            (scenes.iter()).partition(|scene| scores.contains_key(name(**scene)));
        let mut known = known.into_iter();
        if known.all(|scene| on_score(scene, &scores[name(scene)])) && !missing.is_empty() {
            let measured = self.measure(settings, &missing, &mut on_score)?;
            let named = (measured.into_iter()).map(|(scene, score)| (name(scene).clone(), score));
            scores.extend(named);
        }
        let selected = scenes.iter().map(|scene| {
            let name = name(*scene);
            Some((name.clone(), *scores.get(name)?))
        });
        let selected: Option<SceneScores> = selected.collect();
        self.memory.insert(key, scores);
        selected.ok_or(TraceError::Cancelled.into())
    }

    /// Blurs the scenes in turn while earlier pictures are being scored.
    fn measure(
        &self,
        settings: &Settings,
        scenes: &[usize],
        on_score: &mut impl FnMut(usize, &SceneScore) -> bool,
    ) -> Result<Vec<(usize, SceneScore)>, Error> {
        let (sender, receiver) = mpsc::channel();
        let mut measured = Vec::new();
        // All scenes are rendered at one size.
        let size = self.targets[scenes[0]].scene.frame.size();
        let kernels = self.kernels.as_ref();
        let mut candidate = Candidate::new(&self.choice.filter, settings, kernels, size)?;
        rayon::in_place_scope(|scope| {
            for scene in scenes {
                let target = &self.targets[*scene];
                let blurred = candidate.blur(&target.scene.frame, self.bleed)?;
                check_finite(&target.scene.name, &blurred)?;
                let sender = sender.clone();
                scope.spawn(move |_| {
                    let score = target.score(&blurred);
                    // The receiver outlives all work of this scope.
                    let _ = sender.send((*scene, score));
                });
                let ready: Vec<_> = receiver.try_iter().collect();
                let goes_on = ready.iter().all(|(scene, score)| on_score(*scene, score));
                measured.extend(ready);
                if !goes_on {
                    break;
                }
            }
            Ok::<(), Error>(())
        })?;
        drop(sender);
        for (scene, score) in receiver {
            on_score(scene, &score);
            measured.push((scene, score));
        }
        Ok(measured)
    }

    /// Times all passes of a candidate and of the start alternately on one scene, by its index, and
    /// returns the median ratio, after one round that does not count. None for a program, which no
    /// GPU can time.
    pub(crate) fn measure_cost(
        &self,
        settings: &Settings,
        scene: usize,
    ) -> Result<Option<f64>, FilterError> {
        let Some(gpu) = self.gpu else {
            return Ok(None);
        };
        let frame = &self.targets[scene].scene.frame;
        let Size { width, height } = frame.size();
        let blur = |settings| Blur::new(gpu, &self.choice.filter, settings, width, height);
        let color = [&frame.color];
        let input = filter_input(frame, &color);
        let (mut start, mut candidate) = (blur(&self.choice.settings)?, blur(settings)?);
        let (start, candidate) = (start.load(&input)?, candidate.load(&input)?);
        let mut ratios = Vec::new();
        for round in 0..=ROUNDS {
            let [before, after] = [&start, &candidate].map(|loaded| {
                let passes = loaded.time()?;
                Ok::<f64, FilterError>(passes.iter().map(|pass| pass.seconds).sum())
            });
            let ratio = after? / before?;
            ratios.extend((round > 0).then_some(ratio));
        }
        ratios.sort_by(f64::total_cmp);
        Ok(Some(ratios[ROUNDS / 2]))
    }
}

/// Scores of one candidate relative to the start, on the same scenes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Evaluation {
    /// Value of every parameter.
    pub values: BTreeMap<String, Value>,
    /// Mean over scenes of log(error / error of the start): below 0 is better.
    pub error: f64,
    /// Lateral bleed of the worst scene, in pixels.
    pub bleed: Option<f64>,
    /// GPU time relative to the start's.
    pub cost: Option<f64>,
    /// Scores per scene.
    pub scenes: SceneScores,
}

/// Evaluates a candidate on scenes by their indices. Calls `on_score` with each score as soon as it
/// is known; if that ends the evaluation early, by returning false, the result is an error.
pub fn evaluate_candidate(
    evaluator: &mut Evaluator,
    settings: &Settings,
    scenes: &[usize],
    cost: bool,
    on_score: impl FnMut(usize, &SceneScore) -> bool,
) -> Result<Evaluation, Error> {
    let start = evaluator.choice.settings.clone();
    let start = evaluator.score(&start, scenes, |_, _| true)?;
    let scores = evaluator.score(settings, scenes, on_score)?;
    Ok(Evaluation {
        values: settings.values.clone(),
        error: mean_log_ratio(&scores, &start, |_| true)
            .ok_or_else(|| Error::Refused("scenes: none is named; name at least one".to_owned()))?,
        bleed: worst_bleed(&scores),
        cost: match scenes.first() {
            Some(first) if cost => evaluator.measure_cost(settings, *first)?,
            _ => None,
        },
        scenes: scores,
    })
}

fn memory_key(settings: &Settings) -> String {
    serde_json::to_string(&settings.values).expect("values are plain data")
}

/// Refuses a picture that cannot be scored.
fn check_finite(scene: &str, Blurred { color, mattes }: &Blurred) -> Result<(), Error> {
    let mattes = mattes.iter().flatten().flat_map(|matte| &matte.pixels);
    let mut values = color.pixels.as_flattened().iter().chain(mattes);
    if values.all(|value| value.is_finite()) {
        Ok(())
    } else {
        Err(Error::Refused(format!(
            "{scene}: the filter's picture has infinite or NaN values"
        )))
    }
}
