//! Limits for mutants.

use judge::{Level, Outcome, SceneBounds, default_metrics, judge_scores};
use metrics::Metric;
use suite::{Case, Error, Run};
use tests::limits::calibrate_scene;
use tracer::Scene;

use crate::bench::SEED;
use crate::study::{Limits, Study};

/// Seeds that limits are calibrated with, if there are no shipped ones.
const CALIBRATED_WITH: [u64; 2] = [SEED, SEED + 1];

impl Study<'_, '_> {
    /// Finds the limits on every scene: those of bounds.toml if any of them is required at this size, or else `calibrate`'s proposals.
    pub fn find_limits(&mut self) -> Result<(), Error> {
        let sound = &self.subject.sound;
        for scene in self.bench.scenes.clone().iter() {
            let shipped = self.bench.bounds[&scene.id].clone();
            let bounded = shipped.of(&sound.filter.name, &sound.preset);
            let are_shipped = bounded.values().any(|bound| bound.level == Level::Required);
            let deciding = match are_shipped {
                true => shipped,
                false => {
                    let metrics = default_metrics(&shipped, &sound.filter.name, &sound.preset);
                    self.calibrate(scene, &metrics)?
                }
            };
            let own = Limits {
                deciding,
                are_shipped,
                widest: None,
            };
            self.limits.insert(scene.id.clone(), own);
        }
        Ok(())
    }

    /// Calibrates limits on every metric that can have one.
    pub fn widen_limits(&mut self) -> Result<(), Error> {
        let mut metrics = Metric::all();
        metrics.retain(|metric| metric.row().report_only.is_none());
        for scene in self.bench.scenes.clone().iter() {
            let is_kept = |seed| {
                let place = self.subject.sound_place(&scene.id, seed);
                self.journal.sound.get(&place).is_some()
            };
            if CALIBRATED_WITH.into_iter().all(is_kept) || (self.due)() {
                let widest = self.calibrate(scene, &metrics)?;
                let own = self
                    .limits
                    .get_mut(&scene.id)
                    .expect("every scene has limits");
                own.widest = Some(widest);
            }
        }
        Ok(())
    }

    fn calibrate(&mut self, scene: &Scene, metrics: &[Metric]) -> Result<SceneBounds, Error> {
        let runs = CALIBRATED_WITH.map(|seed| self.measure_sound(scene, seed));
        let runs = runs.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(calibrate_scene(&runs, metrics, &scene.id))
    }

    /// Measures the unchanged filter, unless the journal has it.
    fn measure_sound(&mut self, scene: &Scene, seed: u64) -> Result<Run, Error> {
        let place = self.subject.sound_place(&scene.id, seed);
        if let Some(run) = self.journal.sound.get(&place) {
            return Ok(run.clone());
        }
        let name = &self.subject.name;
        eprintln!("{}: {name} without a change, seed {seed}", scene.id);
        let filters = vec![self.subject.sound.clone()];
        let mut run = self.bench.measure(scene, filters, seed)?;
        run.cases.retain(|case| !case.is_reference);
        self.journal.sound.add(place, run.clone());
        Ok(run)
    }

    /// Refuses limits that the unchanged filter breaks: all of its mutants would break them.
    pub fn refuse_broken(&self, case: &Case) -> Result<(), Error> {
        let broken = find_broken(case, &self.limits[&case.scene].deciding);
        if broken.is_empty() {
            return Ok(());
        }
        Err(Error::Usage(format!(
            "{} breaks limits on {} without a change: {}; calibrate them anew",
            self.subject.name,
            case.scene,
            broken.join(", ")
        )))
    }
}

/// Lists the metrics of a case with broken required limits.
pub fn find_broken(case: &Case, bounds: &SceneBounds) -> Vec<String> {
    let bounds = bounds.of(&case.filter, &case.preset);
    let judged = judge_scores(&case.scores, Some(&case.intervals), &bounds).into_iter();
    let broken = judged.filter(|judged| {
        judged.outcome == Outcome::Broken && judged.bound.level == Level::Required
    });
    broken.map(|judged| judged.metric.to_string()).collect()
}
