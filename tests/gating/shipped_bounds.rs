//! Shipped bounds: the identity breaks one in every scene with motion, the mean of 64 sub-frames
//! breaks none, and the most compared filters keep their required ones.

use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use cli::{Programs, SceneChoice, select_filters, select_scenes};
use frame::{Alignment, Size};
use gate::check;
use judge::{
    Decision, JudgedScore, Level, Outcome, SceneBounds, judge, judge_scores, read_bounds,
    size_for_bounds,
};
use measure::{FilterChoice, Monitor, Rendering, RunPlan, measure_scenes};
use metrics::Reference;
use scene::Scene;
use tests::{open_gpu, settings};

/// A scene with a quick truth, in which things pass one another.
const FEW: [&str; 1] = ["two_spheres"];

/// Scenes in which nothing moves farther than the bounds allow. The tests of the catalogue show by
/// changed pixels what these scenes expose.
const HARDLY_MOVING: [&str; 1] = ["creep"];

/// Filters with required bounds, and metrics that each scene limits for them.
const GUARDED: &str = "jump_flood:paper jump_flood:corrected mcguire:paper guertin:paper";
const REQUIRED: [&str; 2] = ["flip_moving", "bleed_lateral"];

/// Size of the required bounds.
const SIZE: Size = Size::new(160, 90);

/// Locks and returns the folder of truths, which are kept between runs of the tests: two tests that
/// need the same truths render them once.
fn lock_truths() -> (PathBuf, MutexGuard<'static, ()>) {
    static IN_USE: Mutex<()> = Mutex::new(());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("truths/160x90_256/seed_1");
    let lock = IN_USE.lock().unwrap_or_else(PoisonError::into_inner);
    (folder, lock)
}

/// Selects scenes with their bounds; all if no names are given.
fn select(names: &[&str]) -> Vec<(Scene, SceneBounds)> {
    let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    let choices = select_scenes(tests::scenes(), &names).unwrap().into_iter();
    let with_bounds = |choice: SceneChoice| {
        let bounds = read_bounds(tests::scenes(), &choice.folder, Some(SIZE)).unwrap();
        (choice.scene, bounds)
    };
    choices.map(with_bounds).collect()
}

fn guarded() -> Vec<FilterChoice> {
    let names: Vec<String> = GUARDED.split(' ').map(str::to_owned).collect();
    select_filters(&names, None, &[], Programs::Refused).unwrap()
}

/// Judges the instant itself, and the mean of 64 sub-frames.
fn judge_bars(scene: &Scene, bounds: &SceneBounds, out: &Path) -> [Vec<JudgedScore>; 2] {
    let rendering = Rendering {
        scene: scene.into(),
        settings: settings(SIZE.into(), 256),
        out,
        monitor: Monitor::SILENT,
    };
    let frame = rendering.frame().unwrap();
    let truth = rendering.truth(Alignment::Trailing).unwrap();
    let rung = rendering.ladder(&truth).read_or_render(64).unwrap();
    let reference = Reference::new(&frame, &truth, None, &scene.display.into()).unwrap();
    // Bounds for all filters, required or not.
    let bounds = bounds.of("identity", "default");
    let measured = [
        reference.measure(&frame.picture()).unwrap(),
        reference.measure_accumulation(&rung.rungs[0]).unwrap(),
    ];
    measured.map(|measured| judge_scores(&measured.scores, None, &bounds))
}

/// Formats the scores with an outcome.
fn list(judged: &[JudgedScore], outcome: Outcome) -> String {
    let chosen = judged.iter().filter(|one| one.outcome == outcome);
    let text = |one: &JudgedScore| {
        format!(
            "{} {:?}, limit {}; ",
            one.metric, one.measured, one.bound.limit
        )
    };
    chosen.map(text).collect()
}

fn check_bars(names: &[&str]) {
    let (out, _own) = lock_truths();
    let mut failures = String::new();
    for (scene, bounds) in select(names) {
        let [identity, accumulation] = judge_bars(&scene, &bounds, &out);
        let name = &scene.id;
        let is_broken = !list(&identity, Outcome::Broken).is_empty();
        if is_broken == HARDLY_MOVING.contains(&name.name.as_str()) {
            failures += &format!("{name}: does the identity break a bound? {is_broken}\n");
        }
        let broken = list(&accumulation, Outcome::Broken);
        let noisy = list(&identity, Outcome::TooNoisy);
        if !broken.is_empty() || !noisy.is_empty() {
            failures += &format!("{name}: 64 sub-frames break {broken}, too noisy for {noisy}\n");
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn the_identity_breaks_a_bound_and_64_subframes_break_none() {
    check_bars(&FEW);
}

#[test]
#[ignore = "prove: every scene"]
fn the_identity_breaks_a_bound_in_every_moving_scene_and_64_subframes_break_none() {
    check_bars(&[]);
}

#[test]
fn every_scene_requires_something_of_guarded_filters() {
    let scenes = select(&[]);
    assert!(scenes.len() >= 26, "the shipped scenes are missing");
    let size = size_for_bounds(scenes.iter().map(|(_, bounds)| bounds), &guarded(), None);
    assert_eq!(size.unwrap(), Some(SIZE));
    for (scene, bounds) in scenes {
        for filter in GUARDED.split(' ') {
            let (name, preset) = filter.split_once(':').unwrap();
            let bounds = bounds.of(name, preset);
            for metric in REQUIRED {
                let bound = bounds.get(&metric.parse().unwrap());
                let level = bound.map(|bound| bound.level);
                let what = format!("{}: {filter}'s {metric}", scene.id);
                assert_eq!(level, Some(Level::Required), "{what}");
            }
        }
    }
}

fn check_guarded(names: &[&str]) {
    let (scenes, bounds): (Vec<_>, Vec<_>) = select(names).into_iter().unzip();
    let names = scenes.iter().map(|scene| scene.id.clone());
    let bounds = names.zip(bounds).collect();
    let (out, _own) = lock_truths();
    let plan = RunPlan {
        scenes,
        filters: guarded(),
        render: settings(SIZE.into(), 256),
        out,
        intervals: true,
        // Equivalent sub-frames are not limited; `check` renders no ladder either.
        ladders: false,
        ..RunPlan::default()
    };
    let finished = measure_scenes(&plan, Some(&open_gpu()), Vec::new()).unwrap();
    let checked = check(&finished, judge(&finished, &bounds), Vec::new());
    let mut not_kept = checked.findings;
    not_kept.retain(|finding| finding.level == Level::Required);
    not_kept.retain(|finding| !matches!(finding.outcome, Outcome::Kept | Outcome::NotApplicable));
    assert_eq!(checked.decision, Decision::Pass, "{not_kept:#?}");
}

#[test]
fn guarded_filters_keep_their_required_bounds() {
    check_guarded(&FEW);
}

#[test]
#[ignore = "prove: every scene"]
fn guarded_filters_keep_their_required_bounds_on_every_scene() {
    check_guarded(&[]);
}
