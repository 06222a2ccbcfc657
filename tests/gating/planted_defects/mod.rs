//! Planted defects against the gate: each breaks a bound that the filter without it keeps.
//!
//! `calibrate` makes the bounds from the filters without defects, on small pictures of shipped scenes.

mod defects;

use std::path::PathBuf;

use cli::{Programs, select_filters, select_scenes};
use defects::{DEFECTS, Defect};
use filters::Gpu;
use judge::{Check, Decision, RunBounds, check, judge};
use metrics::Metric;
use suite::{Case, FilterChoice, Monitor, Run, RunPlan, measure_scenes, open_gpu};
use tests::filter_folder::copy_changed_filter;
use tests::limits::calibrate_scene;
use tracer::{RenderSettings, Scene, SceneId};

/// Scenes: one thing that slides, far and at an angle; two that pass one another; many that turn, fly and hide one
/// another; many that cross; some that leave the picture; thin ones.
const NAMES: [&str; 7] = [
    "sliding_panel@128px_0deg",
    "sliding_panel@64px_45deg",
    "two_spheres",
    "railing",
    "crossing",
    "frame_edge",
    "ornaments",
];

/// Metrics with bounds.
const METRICS: [&str; 17] = [
    "mse_moving",
    "flip_moving",
    "flip_p99_moving",
    "gather_spread",
    "flip_static",
    "label_tv",
    "bleed_lateral",
    "bleed_leading",
    "bleed_trailing",
    "lateral_growth",
    "row_gain",
    "row_loss",
    "misplacement",
    "extent",
    "energy",
    "deficit",
    "unity",
];

/// Seeds that the bounds are measured with, and the first of them to check with. Floors vary from seed to seed, and a
/// bound that is too strict for one seed would say nothing about defects.
const CALIBRATED_WITH: [u64; 2] = [1, 2];
const CHECKED_WITH: u64 = CALIBRATED_WITH[0];

/// Side of McGuire's tiles. It is to these small pictures what 20 pixels are to 320x180: trails reach from tile to
/// tile.
const SMALL_TILES: &str = "8";

/// Filters without defects.
const SOUND: [&str; 2] = ["mcguire:paper", "jump_flood:corrected"];

struct Sandbox {
    folder: tempfile::TempDir,
    gpu: Option<Gpu>,
    bounds: RunBounds,
}

impl Sandbox {
    /// Measures the filters without defects, and makes bounds from their scores.
    fn new(filters: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let shipped = choices(filters.iter().map(|name| (*name).to_owned()));
        let mut sandbox = Self {
            gpu: open_gpu(&shipped, None, Monitor::SILENT).unwrap(),
            bounds: RunBounds::new(),
            folder,
        };
        let runs: Vec<Run> = (CALIBRATED_WITH.into_iter())
            .map(|seed| sandbox.run(choices(filters.iter().map(|name| (*name).to_owned())), seed))
            .collect();
        let metrics = METRICS.map(|name| name.parse::<Metric>().unwrap());
        for name in NAMES {
            let scene = SceneId::new(name, None);
            let bounds = calibrate_scene(&runs, &metrics, &scene);
            sandbox.bounds.insert(scene, bounds);
        }
        sandbox
    }

    fn run(&self, filters: Vec<FilterChoice>, seed: u64) -> Run {
        let scenes: Vec<Scene> = select_scenes(tests::scenes(), &NAMES.map(str::to_owned))
            .unwrap()
            .into_iter()
            .map(|choice| choice.scene)
            .collect();
        let plan = RunPlan {
            scenes,
            filters,
            render: RenderSettings {
                width: 128,
                height: 72,
                samples_per_pixel: 64,
                seed,
                ..RenderSettings::default()
            },
            // Each seed has truths of its own.
            out: self.folder.path().join(format!("seed_{seed}")),
            intervals: true,
            // No limit is on equivalent sub-frames.
            ladders: false,
            ..RunPlan::default()
        };
        measure_scenes(&plan, self.gpu.as_ref(), Vec::new()).unwrap()
    }

    /// Runs all filters together, and checks each of them alone.
    fn checks(&self, filters: Vec<FilterChoice>) -> Vec<Check> {
        let count = filters.len();
        let run = self.run(filters, CHECKED_WITH);
        let cases: Vec<Case> =
            (run.cases.iter().filter(|case| !case.is_reference).cloned()).collect();
        assert_eq!(cases.len(), count * NAMES.len());
        (0..count)
            .map(|filter| {
                let own = cases.iter().skip(filter).step_by(count).cloned();
                let alone = Run {
                    cases: own.collect(),
                    ..run.clone()
                };
                check(&alone, judge(&alone, &self.bounds), Vec::new())
            })
            .collect()
    }

    /// Copies a shipped filter and plants a defect.
    fn plant(&self, defect: &Defect) -> PathBuf {
        let copy = self.folder.path().join("planted").join(defect.name);
        copy_changed_filter(defect.filter, &copy, |text| {
            assert_eq!(
                text.matches(defect.sound).count(),
                1,
                "{}: the kernels of {} hold this line once: {}",
                defect.name,
                defect.filter,
                defect.sound
            );
            text.replace(defect.sound, defect.broken)
        });
        copy
    }
}

/// Selects each filter by itself: copies have the names of their originals.
fn choices(words: impl Iterator<Item = String>) -> Vec<FilterChoice> {
    words
        .flat_map(|word| select_filters(&[word], None, &[], Programs::Refused).unwrap())
        .map(|mut choice| {
            if choice.filter.name == "mcguire" {
                let FilterChoice {
                    filter, settings, ..
                } = &mut choice;
                settings.set(filter, "tile_size", SMALL_TILES).unwrap();
            }
            choice
        })
        .collect()
}

/// Names the metrics whose bounds are broken, with their scenes.
fn broken_bounds(check: &Check) -> Vec<String> {
    (check.findings.iter())
        .filter(|finding| finding.decision() == Decision::Broken)
        .map(|finding| format!("{} on {}", finding.metric, finding.scene))
        .collect()
}

#[test]
fn every_planted_defect_breaks_a_bound_and_sound_filters_pass() {
    let sandbox = Sandbox::new(&SOUND);
    let planted = DEFECTS.iter().map(|defect| {
        let copy = sandbox.plant(defect);
        format!("{}:{}", copy.display(), defect.preset)
    });
    let words = SOUND.iter().map(|name| (*name).to_owned());
    let checks = sandbox.checks(choices(words.chain(planted)));
    let (sound, defective) = checks.split_at(SOUND.len());
    for check in sound {
        assert_eq!(
            check.decision,
            Decision::Pass,
            "{:#?}",
            broken_bounds(check)
        );
    }
    let mut slipped = Vec::new();
    for (defect, check) in DEFECTS.iter().zip(defective) {
        let broken = broken_bounds(check);
        println!(
            "{} {}, {} bounds: {}",
            defect.filter,
            defect.name,
            broken.len(),
            broken.join(", ")
        );
        if check.decision != Decision::Broken {
            slipped.push(defect.name);
        }
    }
    assert!(slipped.is_empty(), "slipped through: {slipped:?}");
}
