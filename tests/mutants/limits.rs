//! Limits that mutants are held to.

use std::collections::BTreeMap;

use cli::SceneChoice;
use judge::{Level, Outcome, SceneBounds, default_metrics, judge_scores};
use metrics::Metric;
use suite::{Case, Error, Run};
use tests::limits::calibrate_scene;
use tracer::{Scene, SceneId};

use crate::bench::{Bench, SEED};
use crate::journal::Journal;
use crate::subject::Subject;

/// Seeds that limits are calibrated with, if there are no shipped ones.
const CALIBRATED_WITH: [u64; 2] = [SEED, SEED + 1];

pub type Limits = BTreeMap<SceneId, SceneLimits>;

pub struct SceneLimits {
    pub deciding: SceneBounds,
    /// True if they are those of bounds.toml.
    pub are_shipped: bool,
    /// Limits on every metric that can have one, which tell what would notice a survivor; none until they are calibrated.
    pub widest: Option<SceneBounds>,
}

/// Finds the limits of a filter preset on every scene: those of bounds.toml if any of them is required at this size, or else those
/// that `calibrate` proposes.
pub fn find_limits(
    bench: &Bench,
    subject: &Subject,
    journal: &mut Journal,
) -> Result<Limits, Error> {
    let mut limits = Limits::new();
    for SceneChoice { scene, .. } in &bench.scenes {
        let shipped = &bench.bounds[&scene.id];
        let sound = &subject.sound;
        let bounded = shipped.of(&sound.filter.name, &sound.preset);
        let are_shipped = bounded.values().any(|bound| bound.level == Level::Required);
        let deciding = match are_shipped {
            true => shipped.clone(),
            false => {
                let metrics = default_metrics(shipped, &sound.filter.name, &sound.preset);
                let runs = measure_sound_runs(bench, subject, scene, journal)?;
                calibrate_scene(&runs, &metrics, &scene.id)
            }
        };
        let own = SceneLimits {
            deciding,
            are_shipped,
            widest: None,
        };
        limits.insert(scene.id.clone(), own);
    }
    Ok(limits)
}

pub fn widen_limits(
    bench: &Bench,
    subject: &Subject,
    limits: &mut Limits,
    journal: &mut Journal,
    due: &dyn Fn() -> bool,
) -> Result<(), Error> {
    let metrics: Vec<Metric> = (Metric::all().into_iter())
        .filter(|metric| metric.row().report_only.is_none())
        .collect();
    for choice in &bench.scenes {
        let scene = &choice.scene;
        let is_kept = |seed| {
            let place = subject.sound_place(&scene.id, seed);
            journal.sound.get(&place).is_some()
        };
        if CALIBRATED_WITH.into_iter().all(is_kept) || due() {
            let runs = measure_sound_runs(bench, subject, scene, journal)?;
            let own = limits.get_mut(&scene.id).expect("every scene has limits");
            own.widest = Some(calibrate_scene(&runs, &metrics, &scene.id));
        }
    }
    Ok(())
}

/// Refuses limits that the filter breaks without a change: all of its mutants would break them.
pub fn refuse_broken(subject: &Subject, case: &Case, limits: &SceneLimits) -> Result<(), Error> {
    let broken = find_broken(case, &limits.deciding);
    if broken.is_empty() {
        return Ok(());
    }
    Err(Error::Usage(format!(
        "{} breaks limits on {} without a change: {}; calibrate them anew",
        subject.name,
        case.scene,
        broken.join(", ")
    )))
}

fn measure_sound_runs(
    bench: &Bench,
    subject: &Subject,
    scene: &Scene,
    journal: &mut Journal,
) -> Result<Vec<Run>, Error> {
    (CALIBRATED_WITH.into_iter())
        .map(|seed| measure_sound(bench, subject, scene, seed, journal))
        .collect()
}

/// Measures the filter without a change, unless the journal has it.
fn measure_sound(
    bench: &Bench,
    subject: &Subject,
    scene: &Scene,
    seed: u64,
    journal: &mut Journal,
) -> Result<Run, Error> {
    let place = subject.sound_place(&scene.id, seed);
    if let Some(run) = journal.sound.get(&place) {
        return Ok(run.clone());
    }
    eprintln!(
        "{}: {} without a change, seed {seed}",
        scene.id, subject.name
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
    broken.map(|judged| judged.metric.to_string()).collect()
}
