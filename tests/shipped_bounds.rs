//! Image error and edge bleed of the filters that people will compare with stay where they were measured.

use std::path::Path;

use filters::Gpu;
use suite::{
    Decision, InputFormat, Kind, Level, Plan, RenderSettings, check, read_bounds, run,
    select_filters, select_scenes,
};

/// What is bounded there.
const GUARDED: [&str; 4] = [
    "jump_flood:paper",
    "jump_flood:corrected",
    "mcguire:paper",
    "guertin:paper",
];

/// Scenes with limits of their own.
const CALIBRATED: [&str; 5] = [
    "fan",
    "panel_over_texture",
    "railing",
    "sliding_panel",
    "two_spheres",
];

#[test]
fn guarded_filters_keep_what_is_required_of_them_on_calibrated_scenes() {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../scenes"));
    let gpu = Gpu::new(None).expect("this test runs filters");
    let scenes = select_scenes(root, &CALIBRATED.map(str::to_owned)).unwrap();
    let scenes = scenes.into_iter().map(|choice| {
        let bounds = read_bounds(root, &choice.folder).unwrap();
        (choice.scene, bounds)
    });
    let plan = Plan {
        scenes: scenes.collect(),
        filters: select_filters(&GUARDED.map(str::to_owned), None, &[]).unwrap(),
        inputs: vec![InputFormat::default()],
        jitter_frames: 0,
        render: RenderSettings::default(),
        // Truths are kept from one run of the tests to the next.
        out: Path::new(env!("CARGO_TARGET_TMPDIR")).join("truths"),
        intervals: true,
        evidence: false,
        quiet: true,
    };
    let run = run(&plan, Some(&gpu), Vec::new()).unwrap();
    let check = check(&run, Vec::new());
    for (scene, _) in &plan.scenes {
        for filter in GUARDED {
            for metric in ["flip_moving", "bleed_lateral"] {
                let required = check.findings.iter().any(|finding| {
                    (&finding.scene[..], &finding.filter[..]) == (&scene.name, filter)
                        && finding.metric == metric
                        && finding.level == Level::Required
                });
                assert!(
                    required,
                    "{}: nothing is required of {filter}'s {metric}",
                    scene.name
                );
            }
        }
    }
    let not_kept: Vec<String> = (check.findings.iter())
        .filter(|finding| finding.level == Level::Required)
        .filter(|finding| !matches!(finding.kind, Kind::Kept | Kind::NotApplicable))
        .map(|finding| {
            format!(
                "{} {} {} is {:?}: {:?} within {:?}, limit {}",
                finding.scene,
                finding.filter,
                finding.metric,
                finding.kind,
                finding.value,
                finding.interval,
                finding.limit
            )
        })
        .collect();
    assert_eq!(check.decision, Decision::Pass, "{}", not_kept.join("\n"));
}
