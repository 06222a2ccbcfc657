//! Tuned presets against published ones, on scenes that the tuning did not use.

use std::path::Path;

use cli::{Programs, paired_table, select_filters, select_scenes};
use suite::{
    Evaluator, LEAST_BLEED, Monitor, Preference, SceneBounds, compare_candidates, read_bounds,
    render_scenes,
};
use tests::open_gpu;
use tracer::{RenderSettings, Scene};

const TUNED: [&str; 2] = ["jump_flood", "mcguire"];

/// Loads the shipped scenes except some.
fn scenes_but(left_out: &[String]) -> Vec<(Scene, SceneBounds)> {
    let root = tests::scenes();
    let all = select_scenes(&root, &[]).unwrap().into_iter();
    all.filter(|choice| !left_out.contains(&choice.scene.name))
        .map(|choice| {
            let bounds = read_bounds(&root, &choice.folder, None).unwrap();
            (choice.scene, bounds)
        })
        .collect()
}

#[test]
fn tuned_presets_beat_published_ones_and_bleed_no_more_on_held_out_scenes() {
    let gpu = open_gpu();
    let render = RenderSettings {
        // docs/tune.md gives the result of 256 samples. Both presets see the same noise, which only hides differences, and an
        // eighth of the samples gives the same verdict.
        samples_per_pixel: 32,
        ..RenderSettings::default()
    };
    // Truths stay from one run of the tests to the next.
    let out = Path::new(env!("CARGO_TARGET_TMPDIR")).join("tuned");
    for name in TUNED {
        let choice = select_filters(&[format!("{name}:tuned")], None, &[], Programs::Refused)
            .unwrap()
            .remove(0);
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
        let published = choice.filter.settings(Some(&tuned.from)).unwrap();
        let paired = compare_candidates(&mut evaluator, &published, &choice.settings).unwrap();
        let table = paired_table(&paired, [&tuned.from, "tuned"]);
        println!("{name}\n{table}");
        assert_eq!(paired.flip.verdict, Preference::Second, "{name}\n{table}");
        let bleed = paired.bleed.expect("some scenes have bleed");
        assert!(bleed.is_no_worse(LEAST_BLEED), "{name}\n{table}");
    }
}
