//! Limits that mutants are held to.

use std::collections::BTreeMap;

use metrics::Metric;
use suite::{Case, Error, Level, Outcome, Run, SceneBounds, judge_scores};
use tests::limits::calibrate_scene;
use tracer::Scene;

use crate::bench::{Bench, SEED};
use crate::journal::Journal;
use crate::subject::Subject;

/// Seeds that limits are calibrated with, if there are no shipped ones.
const CALIBRATED_WITH: [u64; 2] = [SEED, SEED + 1];

/// Limits on one filter preset, by scene.
pub type Limits = BTreeMap<String, SceneLimits>;

/// Limits on one filter preset on one scene.
pub struct SceneLimits {
    /// Limits that decide.
    pub deciding: SceneBounds,
    /// True if they are those of bounds.toml.
    pub are_shipped: bool,
    /// Limits on every metric that can have one, which tell what would notice a survivor.
    pub widest: SceneBounds,
}

/// Finds the limits of a filter preset on every scene: those of bounds.toml if any of them is required at this size, or else those
/// that `calibrate` proposes for the same metrics. Refuses limits that the filter breaks without a change.
pub fn find_limits(
    bench: &Bench,
    subject: &Subject,
    journal: &mut Journal,
) -> Result<Limits, Error> {
    let mut limits = Limits::new();
    let all: Vec<Metric> = (Metric::all().into_iter())
        .filter(|metric| metric.report_only().is_none())
        .collect();
    for choice in &bench.scenes {
        let scene = &choice.scene.name;
        let runs = (CALIBRATED_WITH.into_iter())
            .map(|seed| measure_sound(bench, subject, &choice.scene, seed, journal))
            .collect::<Result<Vec<Run>, Error>>()?;
        let shipped = &bench.bounds[scene];
        let bounded = shipped.of(&subject.sound.filter.name, &subject.sound.preset);
        let are_shipped = bounded.values().any(|bound| bound.level == Level::Required);
        let deciding = match are_shipped {
            true => shipped.clone(),
            false => {
                let named = bounded
                    .keys()
                    .map(|name| name.parse().expect("it was read"));
                calibrate_scene(&runs, &named.collect::<Vec<Metric>>(), scene)
            }
        };
        let widest = calibrate_scene(&runs, &all, scene);
        let cases = runs[0].cases.iter().filter(|case| !case.is_reference);
        let broken: Vec<String> = cases
            .flat_map(|case| find_broken(case, &deciding))
            .collect();
        if !broken.is_empty() {
            return Err(Error::Usage(format!(
                "{} breaks limits on {scene} without a change: {}; calibrate them anew",
                subject.name,
                broken.join(", ")
            )));
        }
        let own = SceneLimits {
            deciding,
            are_shipped,
            widest,
        };
        limits.insert(scene.clone(), own);
    }
    Ok(limits)
}

/// Measures the filter without a change, unless the journal has it.
fn measure_sound(
    bench: &Bench,
    subject: &Subject,
    scene: &Scene,
    seed: u64,
    journal: &mut Journal,
) -> Result<Run, Error> {
    let place = (
        subject.key.clone(),
        format!("seed {seed}"),
        scene.name.clone(),
    );
    if let Some(run) = journal.sound.get(&place) {
        return Ok(run.clone());
    }
    eprintln!(
        "{}: {} without a change, seed {seed}",
        scene.name, subject.name
    );
    let mut run = bench.measure(scene, vec![subject.sound.clone()], seed)?;
    run.cases.retain(|case| !case.is_reference);
    journal.sound.add(place, run.clone());
    Ok(run)
}

/// Lists the metrics of a case whose required limits are broken.
pub fn find_broken(case: &Case, bounds: &SceneBounds) -> Vec<String> {
    let bounds = bounds.of(&case.filter, &case.preset);
    let judged = judge_scores(&case.scores, Some(&case.intervals), &bounds).into_iter();
    let broken = judged.filter(|judged| {
        judged.outcome == Outcome::Broken && judged.bound.level == Level::Required
    });
    broken.map(|judged| judged.metric).collect()
}
