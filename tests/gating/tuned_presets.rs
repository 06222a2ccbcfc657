//! Tuned presets against published ones, on scenes that the tuning did not use.

use std::path::Path;

use cli::{Programs, paired_table, select_filters, select_scenes};
use judge::{SceneBounds, read_bounds};
use suite::Monitor;
use tests::open_gpu;
use tracer::{RenderSettings, Scene};
use tune::{
    Evaluator, LEAST_BLEED, PairedComparison, Preference, compare_candidates, render_scenes,
};

const TUNED: [&str; 2] = ["jump_flood", "mcguire"];

/// Loads the shipped scenes except some.
fn scenes_but(left_out: &[String]) -> Vec<(Scene, SceneBounds)> {
    let root = tests::scenes();
    let all = select_scenes(&root, &[]).unwrap().into_iter();
    all.filter(|choice| !left_out.contains(&choice.scene.id.to_string()))
        .map(|choice| {
            let bounds = read_bounds(&root, &choice.folder, None).unwrap();
            (choice.scene, bounds)
        })
        .collect()
}

/// Settings of the truths. docs/tune.md gives results of more samples. Both presets see the same noise, which only hides differences,
/// and so few samples give the same verdict.
fn render() -> RenderSettings {
    RenderSettings {
        samples_per_pixel: 32,
        ..RenderSettings::default()
    }
}

/// Compares a filter's tuned preset with the one that the search started from, on the scenes that it did not use. Lengths in pixels
/// are as written, or scaled to the picture, as users have them.
fn compare(name: &str, as_written: bool) -> (PairedComparison, String) {
    let gpu = open_gpu();
    let render = render();
    // Truths stay from one run of the tests to the next.
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tuned");
    let choice = select_filters(&[format!("{name}:tuned")], None, &[], Programs::Refused)
        .unwrap()
        .remove(0)
        .as_written(as_written);
    let mut presets = choice.filter.presets.iter();
    let tuned = presets.find_map(|preset| preset.tuned.as_ref()).unwrap();
    let scenes = scenes_but(&tuned.scenes);
    assert!(
        scenes.len() >= 9,
        "{name}: too few scenes are left to prove anything on"
    );
    let alignment = choice.filter.alignment;
    let rendered = render_scenes(&scenes, alignment, &render, &out, Monitor::SILENT).unwrap();
    let mut evaluator =
        Evaluator::new(Some(&gpu), &choice, &rendered, true, Monitor::SILENT).unwrap();
    let [published, own] =
        [&tuned.from, "tuned"].map(|preset| choice.preset_at(preset, render.width).unwrap());
    let paired = compare_candidates(&mut evaluator, &published, &own).unwrap();
    let table = paired_table(&paired, [&tuned.from, "tuned"]);
    println!("{name}\n{table}");
    (paired, table)
}

#[test]
fn tuned_presets_beat_published_ones_on_held_out_scenes() {
    for name in TUNED {
        let (written, table) = compare(name, true);
        assert_eq!(written.flip.verdict, Preference::Second, "{name}\n{table}");
        let bleed = written.bleed.expect("some scenes have bleed");
        assert!(bleed.is_no_worse(LEAST_BLEED), "{name}\n{table}");
        // Scaled to these small pictures, the lengths of `paper` are so short that it hardly bleeds.
        let (scaled, table) = compare(name, false);
        assert_eq!(scaled.flip.verdict, Preference::Second, "{name}\n{table}");
    }
}
