//! Options of a tuning.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;

use judge::SceneBounds;
use measure::{Error, FilterChoice, Monitor};
use scene::Scene;
use tracer::RenderSettings;

use crate::loss::LEAST_BLEED;
use crate::selection::ChoiceLimits;
use crate::space::Space;
use crate::trial::{Objective, Trial};

/// Filter, scenes, limits and effort of a tuning.
pub struct TuneOptions {
    /// Filter with the values to start from.
    pub choice: FilterChoice,
    /// Parameters that may change.
    pub space: Space,
    /// Scenes to tune on, each with its bounds.
    pub scenes: Vec<(Scene, SceneBounds)>,
    /// Held-out scenes, evaluated once at the end.
    pub held_out: Vec<(Scene, SceneBounds)>,
    /// Render settings of the scenes to tune on.
    pub render: RenderSettings,
    /// Render settings of the held-out scenes.
    pub held_out_render: RenderSettings,
    /// Scores to measure.
    pub objectives: Vec<Objective>,
    /// Upper limit on the cost of the choice, as a ratio to the start's.
    pub cost_at_most: Option<f64>,
    /// Upper limit on the lateral bleed of the choice's worst scene, as a ratio to the start's.
    pub bleed_at_most: Option<f64>,
    /// Number of trials, including an interrupted tuning's; at least 1, which is the start itself.
    pub budget: usize,
    /// Time after which no trial begins.
    pub time: Option<Duration>,
    /// True to drop candidates that are clearly worse after six scenes.
    pub race: bool,
    /// Seed of the search.
    pub seed: u64,
    /// Folder for files.
    pub out: PathBuf,
    /// Monitor that shows progress and can end the work.
    pub monitor: Monitor,
}

impl TuneOptions {
    /// Returns true if an objective is measured.
    pub fn measures(&self, objective: Objective) -> bool {
        self.objectives.contains(&objective)
    }

    /// Refuses an impossible tuning before anything is rendered.
    pub fn check(&self) -> Result<(), Error> {
        assert!(self.budget > 0, "the first trial is the start itself");
        let limits = [
            (self.cost_at_most, Objective::Cost),
            (self.bleed_at_most, Objective::Bleed),
        ];
        for (limit, objective) in limits {
            if limit.is_some() && !self.measures(objective) {
                return Err(Error::Refused(format!(
                    "{0} has a limit and is not measured; add it to the objectives: flip,{0}",
                    objective.name()
                )));
            }
        }
        if self.measures(Objective::Cost) && self.choice.filter.command.is_some() {
            return Err(Error::Refused(format!(
                "objective cost: filter {} is a program, which no GPU can time; leave cost out",
                self.choice.filter.name
            )));
        }
        if self.scenes.is_empty() {
            return Err(Error::Refused(
                "no scene is left to tune on; name at least one that is not held out".to_owned(),
            ));
        }
        let is_tuned_on = |held_out: &Scene| {
            (self.scenes.iter()).any(|(scene, _)| scene.id.name == held_out.id.name)
        };
        let mut held_out = self.held_out.iter();
        match held_out.find(|(scene, _)| is_tuned_on(scene)) {
            Some((scene, _)) => Err(Error::Refused(format!(
                "scene {}: it is tuned on, and so proves nothing as a held-out scene; name it in one of the two lists",
                scene.id
            ))),
            None => Ok(()),
        }
    }

    /// Returns the limits of the choice, from the limits relative to the start, which is the first
    /// trial.
    pub fn choice_limits(&self, start: &Trial) -> ChoiceLimits {
        ChoiceLimits {
            cost: self.cost_at_most,
            bleed: (self.bleed_at_most.zip(start.bleed))
                .map(|(ratio, start)| ratio * start + LEAST_BLEED),
        }
    }

    /// Groups the scenes to tune on by family.
    pub fn families(&self) -> BTreeMap<&'static str, Vec<String>> {
        let mut families: BTreeMap<&'static str, Vec<String>> = BTreeMap::new();
        for (scene, _) in &self.scenes {
            let names = families.entry(scene.family.name()).or_default();
            names.push(scene.id.to_string());
        }
        families
    }
}

/// Orders scenes so that families alternate and the first few represent all.
pub fn interleave_families(scenes: Vec<(Scene, SceneBounds)>) -> Vec<(Scene, SceneBounds)> {
    let mut turns: BTreeMap<&'static str, usize> = BTreeMap::new();
    let mut keyed: Vec<_> = (scenes.into_iter())
        .map(|(scene, bounds)| {
            let turn = turns.entry(scene.family.name()).or_default();
            *turn += 1;
            (*turn, (scene, bounds))
        })
        .collect();
    keyed.sort_by_key(|(turn, _)| *turn);
    keyed.into_iter().map(|(_, scene)| scene).collect()
}
