//! Scoring of candidates on scenes.

use std::collections::HashMap;
use std::sync::mpsc;

use filters::{Gpu, Settings};
use frame::{Image, Plane};
use suite::{Error, FilterChoice, Monitor};

use crate::candidate::{Candidate, SharedKernels};
use crate::rendered_scene::RenderedScene;
use crate::target::{SceneScore, Target};

/// A filter on scenes that are loaded once; scores that were measured before come from memory.
pub struct Evaluator<'a> {
    /// Adapter that candidates run on.
    pub gpu: Option<&'a Gpu>,
    /// The filter with the values that tuning starts from.
    pub choice: FilterChoice,
    /// The scenes.
    pub targets: Vec<Target<'a>>,
    /// True if mattes are blurred as well, which takes about twice the time.
    pub bleed: bool,
    /// Monitor that can end the work.
    pub monitor: Monitor,
    /// The filter's kernels; none if it is a program.
    shared: Option<SharedKernels<'a>>,
    /// Scores by candidate and scene.
    memory: HashMap<(String, usize), SceneScore>,
}

impl<'a> Evaluator<'a> {
    /// Compiles the filter's kernels and uploads the scenes; measures nothing yet.
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
        let shared = match choice.filter.command {
            Some(_) => None,
            None => {
                let gpu = gpu.expect("an adapter was opened for the kernels");
                Some(SharedKernels::compile(
                    gpu,
                    &choice.filter,
                    &targets,
                    bleed,
                )?)
            }
        };
        Ok(Self {
            gpu,
            choice: choice.clone(),
            targets,
            bleed,
            monitor,
            shared,
            memory: HashMap::new(),
        })
    }

    /// Takes over a score that was measured before; ignores scenes that are not loaded.
    pub fn remember(&mut self, settings: &Settings, scene: &str, score: SceneScore) {
        let index = self.targets.iter().position(|it| it.scene.name == scene);
        if let Some(index) = index {
            self.memory.insert((memory_key(settings), index), score);
        }
    }

    /// Scores one candidate on some scenes, by their indices, and returns the scores in that order. Calls `on_score` with
    /// each score as soon as it is known; if that returns false, the work ends and the scores so far are returned.
    pub fn score_candidate(
        &mut self,
        settings: &Settings,
        scenes: &[usize],
        mut on_score: impl FnMut(usize, &SceneScore) -> bool,
    ) -> Result<Vec<SceneScore>, Error> {
        let key = memory_key(settings);
        let mut found = Vec::new();
        let known = |scene: &usize| self.memory.get(&(key.clone(), *scene)).copied();
        let missing: Vec<usize> = (scenes.iter().copied())
            .filter(|scene| known(scene).is_none())
            .collect();
        let mut goes_on = true;
        for scene in scenes.iter().filter(|scene| !missing.contains(scene)) {
            let score = known(scene).expect("it is not missing");
            goes_on = goes_on && on_score(*scene, &score);
        }
        if goes_on && !missing.is_empty() {
            found = self.measure(settings, &missing, &mut on_score)?;
        }
        let measured = found.into_iter();
        self.memory
            .extend(measured.map(|(scene, score)| ((key.clone(), scene), score)));
        let scores = scenes.iter();
        Ok(scores
            .map_while(|scene| self.memory.get(&(key.clone(), *scene)).copied())
            .collect())
    }

    /// Blurs scene after scene while the pictures before are being scored.
    fn measure(
        &self,
        settings: &Settings,
        scenes: &[usize],
        on_score: &mut impl FnMut(usize, &SceneScore) -> bool,
    ) -> Result<Vec<(usize, SceneScore)>, Error> {
        let (sender, receiver) = mpsc::channel();
        let mut found = Vec::new();
        rayon::in_place_scope(|scope| {
            let mut candidate = Candidate {
                filter: &self.choice.filter,
                settings,
                shared: self.shared.as_ref(),
                monitor: self.monitor,
                runner: None,
            };
            for scene in scenes {
                let target = &self.targets[*scene];
                let (color, mattes) = candidate.blur((*scene, target), self.bleed)?;
                check_finite(&target.scene.name, &color, mattes.as_deref())?;
                let sender = sender.clone();
                scope.spawn(move |_| {
                    let score = target.score(&color, mattes.as_deref());
                    // The receiver outlives all work of this scope.
                    let _ = sender.send((*scene, score));
                });
                let ready: Vec<_> = receiver.try_iter().collect();
                let goes_on = ready.iter().all(|(scene, score)| on_score(*scene, score));
                found.extend(ready);
                if !goes_on {
                    break;
                }
            }
            Ok::<(), Error>(())
        })?;
        drop(sender);
        for (scene, score) in receiver {
            on_score(scene, &score);
            found.push((scene, score));
        }
        Ok(found)
    }
}

fn memory_key(settings: &Settings) -> String {
    serde_json::to_string(&settings.values).expect("values are plain data")
}

/// Refuses a picture that no score can be taken of.
fn check_finite(scene: &str, color: &Image, mattes: Option<&[Plane]>) -> Result<(), Error> {
    let mut values = (color.pixels.as_flattened().iter()).chain(
        mattes
            .unwrap_or_default()
            .iter()
            .flat_map(|matte| &matte.pixels),
    );
    match values.all(|value| value.is_finite()) {
        true => Ok(()),
        false => Err(Error::Usage(format!(
            "{scene}: the filter's picture holds values that are infinite or no numbers"
        ))),
    }
}
