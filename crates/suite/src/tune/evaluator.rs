//! Scores candidates on scenes.

use std::collections::HashMap;
use std::sync::mpsc;

use filters::{Gpu, Settings};
use frame::{Image, Plane};

use super::engine::Engine;
use super::shot::{SceneScore, Target};
use crate::{Error, FilterChoice, Monitor};

/// A filter on scenes that are loaded once; what was measured once is answered from memory.
pub struct Evaluator<'a> {
    /// What candidates run on.
    pub gpu: Option<&'a Gpu>,
    /// The filter with the values that tuning starts from.
    pub choice: FilterChoice,
    /// The scenes.
    pub targets: Vec<Target<'a>>,
    /// Whether mattes are blurred as well, which takes about twice the time.
    pub bleed: bool,
    /// What ends the work.
    pub monitor: Monitor,
    engine: Engine<'a>,
    /// By candidate and scene.
    memory: HashMap<(String, usize), SceneScore>,
}

impl<'a> Evaluator<'a> {
    /// Compiles the filter's kernels and takes the scenes to the GPU; nothing is measured yet.
    pub fn new(
        gpu: Option<&'a Gpu>,
        choice: FilterChoice,
        targets: Vec<Target<'a>>,
        bleed: bool,
        monitor: Monitor,
    ) -> Result<Self, Error> {
        Ok(Self {
            engine: Engine::new(gpu, &choice.filter, &targets, bleed, monitor)?,
            gpu,
            choice,
            targets,
            bleed,
            monitor,
            memory: HashMap::new(),
        })
    }

    /// Takes a score for granted; scenes of other names are of no interest.
    pub fn remember(&mut self, settings: &Settings, scene: &str, score: SceneScore) {
        let index = self.targets.iter().position(|it| it.shot.name == scene);
        if let Some(index) = index {
            self.memory.insert((key(settings), index), score);
        }
    }

    /// The scores of one candidate on some scenes, by their indices, in their order. `heard` is told of each as soon as it is
    /// known, and ends the work by returning false: what was scored until then is returned.
    pub fn scores(
        &mut self,
        settings: &Settings,
        scenes: &[usize],
        mut heard: impl FnMut(usize, &SceneScore) -> bool,
    ) -> Result<Vec<SceneScore>, Error> {
        let key = key(settings);
        let mut found = Vec::new();
        let known = |scene: &usize| self.memory.get(&(key.clone(), *scene)).copied();
        let missing: Vec<usize> = (scenes.iter().copied())
            .filter(|scene| known(scene).is_none())
            .collect();
        let mut goes_on = true;
        for scene in scenes.iter().filter(|scene| !missing.contains(scene)) {
            let score = known(scene).expect("it is not missing");
            goes_on = goes_on && heard(*scene, &score);
        }
        if goes_on && !missing.is_empty() {
            found = self.measured(settings, &missing, &mut heard)?;
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
    fn measured(
        &self,
        settings: &Settings,
        scenes: &[usize],
        heard: &mut impl FnMut(usize, &SceneScore) -> bool,
    ) -> Result<Vec<(usize, SceneScore)>, Error> {
        let (sender, receiver) = mpsc::channel();
        let mut found = Vec::new();
        rayon::in_place_scope(|scope| {
            let mut candidate = self.engine.candidate(settings);
            for scene in scenes {
                let target = &self.targets[*scene];
                let (color, mattes) = candidate.blur((*scene, target), self.bleed)?;
                check(&target.shot.name, &color, mattes.as_deref())?;
                let sender = sender.clone();
                scope.spawn(move |_| {
                    let score = target.score(&color, mattes.as_deref());
                    // The receiver outlives all work of this scope.
                    let _ = sender.send((*scene, score));
                });
                let ready: Vec<_> = receiver.try_iter().collect();
                let goes_on = ready.iter().all(|(scene, score)| heard(*scene, score));
                found.extend(ready);
                if !goes_on {
                    break;
                }
            }
            Ok::<(), Error>(())
        })?;
        drop(sender);
        for (scene, score) in receiver {
            heard(scene, &score);
            found.push((scene, score));
        }
        Ok(found)
    }
}

fn key(settings: &Settings) -> String {
    serde_json::to_string(&settings.values).expect("values are plain data")
}

/// Refuses a picture that no score can be taken of.
fn check(scene: &str, color: &Image, mattes: Option<&[Plane]>) -> Result<(), Error> {
    let finite = color.pixels.as_flattened().iter().all(|it| it.is_finite());
    let mattes = mattes.unwrap_or_default().iter();
    let all = finite
        && mattes
            .flat_map(|matte| &matte.pixels)
            .all(|it| it.is_finite());
    match all {
        true => Ok(()),
        false => Err(Error::Usage(format!(
            "{scene}: the filter's picture holds values that are no numbers"
        ))),
    }
}
