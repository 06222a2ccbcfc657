//! Limits that mutants are held to.

use std::collections::BTreeMap;

use metrics::Metric;
use suite::{Case, Decision, Error, Level, Run, SceneBounds, judge};
use tests::limits::calibrate_scene;

use crate::bench::{Bench, SEED};
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
    /// Run of the filter without a change.
    pub sound: Run,
}

/// Finds the limits of a filter preset on every scene: those of bounds.toml if any of them is required at this size, or else those
/// that `calibrate` proposes for the same metrics. Refuses limits that the filter breaks without a change.
pub fn find_limits(bench: &Bench, subject: &Subject) -> Result<Limits, Error> {
    let mut limits = Limits::new();
    let all: Vec<Metric> = (Metric::all().into_iter())
        .filter(|metric| metric.report_only().is_none())
        .collect();
    for choice in &bench.scenes {
        let scene = &choice.scene.name;
        eprintln!("{scene}: {} without a change", subject.name);
        let runs = (CALIBRATED_WITH.into_iter())
            .map(|seed| bench.measure(&choice.scene, vec![subject.sound.clone()], seed))
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
        let sound = runs.into_iter().next().expect("there are two");
        let broken = find_broken(&sound, &sound.cases, &deciding);
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
            sound,
        };
        limits.insert(scene.clone(), own);
    }
    Ok(limits)
}

/// Lists the metrics of a run's cases whose required limits are broken.
pub fn find_broken(run: &Run, cases: &[Case], bounds: &SceneBounds) -> Vec<String> {
    let run = Run {
        cases: cases.to_vec(),
        ..run.clone()
    };
    let scenes = cases
        .iter()
        .map(|case| (case.scene.clone(), bounds.clone()));
    let findings = judge(&run, &scenes.collect()).into_iter();
    let broken = findings.filter(|finding| finding.decision() == Decision::Broken);
    broken.map(|finding| finding.metric).collect()
}
