//! Plan of a tuning.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::str::FromStr;
use std::time::Duration;

use tracer::{Family, Scene};

use super::Space;
use crate::judge::bounds::SceneBounds;
use crate::{Error, FilterChoice, Monitor, RenderSettings};

/// What a trial is judged by, each kept apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// `flip_moving`; always measured.
    Flip,
    /// `bleed_lateral` of the worst scene.
    Bleed,
    /// GPU time.
    Cost,
}

impl Objective {
    /// The word of the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flip => "flip",
            Self::Bleed => "bleed",
            Self::Cost => "cost",
        }
    }
}

impl FromStr for Objective {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        [Self::Flip, Self::Bleed, Self::Cost]
            .into_iter()
            .find(|it| it.name() == word)
            .ok_or_else(|| "allowed: flip, bleed, cost".to_owned())
    }
}

/// What a tuning is asked to do.
pub struct TunePlan {
    /// The filter with the values to start from.
    pub choice: FilterChoice,
    /// What may change.
    pub space: Space,
    /// Scenes to tune on, each with its bounds.
    pub scenes: Vec<(Scene, SceneBounds)>,
    /// Scenes that are looked at once, after all is decided.
    pub sealed: Vec<(Scene, SceneBounds)>,
    /// How scenes to tune on are rendered.
    pub render: RenderSettings,
    /// How sealed ones are.
    pub sealed_render: RenderSettings,
    /// What is measured.
    pub objectives: Vec<Objective>,
    /// The largest cost of the choice, as a ratio to the start's.
    pub cost_at_most: Option<f64>,
    /// The largest lateral bleed of the choice's worst scene, as a ratio to the start's.
    pub bleed_at_most: Option<f64>,
    /// How many trials the journal is to hold.
    pub budget: usize,
    /// When to begin no more trials.
    pub time: Option<Duration>,
    /// Whether candidates that are clearly worse after six scenes are dropped.
    pub race: bool,
    /// Of the search's randomness.
    pub seed: u64,
    /// Where files go.
    pub out: PathBuf,
    /// What is told of the progress, and what ends the work.
    pub monitor: Monitor,
}

impl TunePlan {
    /// Whether an objective is measured.
    pub fn measures(&self, objective: Objective) -> bool {
        self.objectives.contains(&objective)
    }

    /// Refuses what cannot be done, before anything is rendered.
    pub fn check(&self) -> Result<(), Error> {
        if self.budget == 0 {
            return Err(Error::Usage(
                "--budget 0: allowed is 1 or more; the first trial is the start itself".to_owned(),
            ));
        }
        let limits = [
            ("--cost-at-most", self.cost_at_most, Objective::Cost),
            ("--bleed-at-most", self.bleed_at_most, Objective::Bleed),
        ];
        for (option, limit, objective) in limits {
            if limit.is_some() && !self.measures(objective) {
                return Err(Error::Usage(format!(
                    "{option}: {0} is not measured; add it: --objective flip,{0}",
                    objective.name()
                )));
            }
        }
        if self.measures(Objective::Cost) && self.choice.filter.command.is_some() {
            return Err(Error::Usage(format!(
                "--objective cost: filter {} is a program, which no GPU can time; leave cost out",
                self.choice.filter.name
            )));
        }
        check_scenes("--scenes", &self.scenes)?;
        let both = self.sealed.iter().find(|(sealed, _)| {
            let own = self.scenes.iter();
            own.map(|(scene, _)| folder_name(&scene.name))
                .any(|name| name == folder_name(&sealed.name))
        });
        match both {
            Some((scene, _)) => Err(Error::Usage(format!(
                "--sealed {}: the scene is tuned on, and so proves nothing; name it in one of --scenes and --sealed",
                scene.name
            ))),
            None => Ok(()),
        }
    }

    /// The scenes of each family.
    pub fn families(&self) -> BTreeMap<&'static str, Vec<&str>> {
        let mut families: BTreeMap<&'static str, Vec<&str>> = BTreeMap::new();
        for (scene, _) in &self.scenes {
            let family: Family = scene.family;
            families.entry(family.name()).or_default().push(&scene.name);
        }
        families
    }
}

fn check_scenes(option: &str, scenes: &[(Scene, SceneBounds)]) -> Result<(), Error> {
    if scenes.is_empty() {
        return Err(Error::Usage(format!(
            "{option}: no scene is left to tune on; name at least one"
        )));
    }
    Ok(())
}

/// A scene's name without its variant.
fn folder_name(name: &str) -> &str {
    name.split('@').next().unwrap_or(name)
}

/// Scenes in an order in which families take turns, so that the first few stand for all.
pub fn interleaved(scenes: Vec<(Scene, SceneBounds)>) -> Vec<(Scene, SceneBounds)> {
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
