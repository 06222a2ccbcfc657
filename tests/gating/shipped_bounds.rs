//! Required bounds of the most compared filters, on every scene.

use cli::{Programs, select_filters, select_scenes};
use judge::{
    Check, Decision, Finding, Level, Outcome, RunBounds, check, judge, read_bounds, size_for_bounds,
};
use suite::{RunPlan, measure_scenes};
use tests::open_gpu;
use tracer::{RenderSettings, SceneId};

use crate::lock_truths;

/// Filters with required bounds.
const GUARDED: [&str; 4] = [
    "jump_flood:paper",
    "jump_flood:corrected",
    "mcguire:paper",
    "guertin:paper",
];

#[test]
fn guarded_filters_keep_their_required_bounds_on_every_scene() {
    let root = tests::scenes();
    let gpu = open_gpu();
    let filters =
        select_filters(&GUARDED.map(str::to_owned), None, &[], Programs::Refused).unwrap();
    let choices = select_scenes(&root, &[]).unwrap();
    assert!(choices.len() >= 26, "the shipped scenes are missing");
    let bounds: RunBounds = (choices.iter())
        .map(|choice| {
            let bounds = read_bounds(&root, &choice.folder, None).unwrap();
            (choice.scene.id.clone(), bounds)
        })
        .collect();
    let (width, height) = (size_for_bounds(bounds.values(), &filters, None).unwrap()).unwrap();
    let (out, _own) = lock_truths();
    let plan = RunPlan {
        scenes: choices.into_iter().map(|choice| choice.scene).collect(),
        filters,
        render: RenderSettings {
            width,
            height,
            ..RenderSettings::default()
        },
        out,
        intervals: true,
        // No limit is on equivalent sub-frames; `check` renders none either.
        ladders: false,
        ..RunPlan::default()
    };
    let finished = measure_scenes(&plan, Some(&gpu), Vec::new()).unwrap();
    let checked = check(&finished, judge(&finished, &bounds), Vec::new());
    for scene in &plan.scenes {
        for filter in GUARDED {
            for metric in ["flip_moving", "bleed_lateral"] {
                assert_required(&checked, &scene.id, filter, metric);
            }
        }
    }
    let not_kept: Vec<String> = (checked.findings.iter())
        .filter(|finding| finding.level == Level::Required)
        .filter(|finding| !matches!(finding.outcome, Outcome::Kept | Outcome::NotApplicable))
        .map(describe)
        .collect();
    assert_eq!(checked.decision, Decision::Pass, "{}", not_kept.join("\n"));
}

fn assert_required(check: &Check, scene: &SceneId, filter: &str, metric: &str) {
    let required = (check.findings.iter()).any(|finding| {
        (&finding.scene, &finding.filter[..]) == (scene, filter)
            && finding.metric.name() == metric
            && finding.level == Level::Required
    });
    assert!(
        required,
        "{scene}: nothing is required of {filter}'s {metric}"
    );
}

fn describe(finding: &Finding) -> String {
    format!(
        "{} {} {} is {:?}: {:?} within {:?}, limit {}",
        finding.scene,
        finding.filter,
        finding.metric,
        finding.outcome,
        finding.value,
        finding.interval,
        finding.limit
    )
}
