//! Wrong blurs against the bounds for all filters. On every scene each wrong blur breaks a bound, and the right ones break none.

pub mod decoys;

use std::collections::BTreeMap;

use decoys::{APART, decoys, scenes};
use frame::Picture;
use judge::{Bounds, Outcome, judge_scores, read_bounds_file};
use metrics::{Measured, Metric, Reference, Scores};
use tests::synthetic::{Blur, Scene, VIEWING};

use crate::noisy;

/// Reads the bounds of every filter on every scene, required or not.
fn shared_bounds() -> Bounds {
    let bounds = read_bounds_file(tests::scenes().join("bounds.toml"));
    bounds.unwrap().default
}

/// Scores every decoy, and the right blurs, on one scene.
fn score_decoys(scene: &Scene) -> Vec<(&'static str, Scores)> {
    let frame = scene.frame();
    let truth = scene.truth([noisy(1024, 1), noisy(1024, 2)]);
    let reference = Reference::new(&frame, &truth, None, &VIEWING).unwrap();
    let score = |picture: &Picture| reference.measure(picture).unwrap().scores;
    let mut pictures = decoys(scene, &frame);
    pictures.push(("oracle", scene.render(&Blur::TRUE, APART)));
    let many = Blur::accumulation(64);
    pictures.push(("accumulate:64", scene.render(&many, APART)));
    let rows = pictures
        .iter()
        .map(|(name, picture)| (*name, score(picture)));
    rows.collect()
}

/// Scores that should detect each decoy: the first one that applies to a scene must.
const SEEN_BY: [(&str, &[&str]); 14] = [
    ("identity", &["misplacement", "label_tv"]),
    ("constant", &["bleed_lateral"]),
    ("half length", &["extent", "label_tv"]),
    ("1.5 length", &["extent", "label_tv"]),
    ("wrong side", &["bleed_leading"]),
    ("shift along", &["misplacement", "flip_moving"]),
    ("shift across", &["lateral_growth", "label_tv"]),
    ("dilation 2 px", &["lateral_growth", "flip_moving"]),
    ("dilation 6 px", &["bleed_lateral"]),
    ("isotropic", &["bleed_leading"]),
    ("fat, rescaled", &["lateral_growth", "label_tv"]),
    ("own velocity", &["misplacement", "label_tv"]),
    ("sharp core", &["row_gain", "label_tv"]),
    ("banding", &["flip_p95_moving"]),
];

/// Returns the names of the broken bounds.
fn broken_bounds(scores: &Scores, bounds: &Bounds) -> Vec<String> {
    let judged = judge_scores(scores, None, bounds).into_iter();
    let broken = judged.filter_map(|judged| match judged.outcome {
        Outcome::Broken => Some(judged.metric.name()),
        Outcome::Kept | Outcome::NotApplicable => None,
        other => panic!("{}: {other:?}", judged.metric),
    });
    broken.collect()
}

/// A scene, and for each decoy the bounds that it breaks there.
type Column<'a> = (&'a str, Vec<(&'a str, Vec<String>)>);

/// Formats the page's table: the bounds that each decoy breaks on all scenes, and those that it breaks on some, with their number.
fn format_table(columns: &[Column]) -> String {
    let scenes = columns.len();
    let mut text =
        format!("| wrong blur | breaks on all {scenes} scenes | on some |\n|---|---|---|\n");
    let cell = |bounds: &[String]| match bounds.is_empty() {
        true => "-".to_owned(),
        false => bounds.join(", "),
    };
    for (row, (decoy, _)) in columns[0].1.iter().enumerate() {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for bound in columns.iter().flat_map(|(_, rows)| &rows[row].1) {
            *counts.entry(bound.replace("_moving", "")).or_default() += 1;
        }
        let (mut everywhere, mut somewhere) = (Vec::new(), Vec::new());
        for (bound, count) in counts {
            match count == scenes {
                true => everywhere.push(bound),
                false => somewhere.push(format!("{bound} ({count})")),
            }
        }
        let (all, some) = (cell(&everywhere), cell(&somewhere));
        text += &format!("| {decoy} | {all} | {some} |\n");
    }
    text
}

#[test]
fn every_wrong_blur_breaks_a_bound_and_the_right_blurs_break_none() {
    let bounds = shared_bounds();
    let mut columns = Vec::new();
    let mut failures = Vec::new();
    for (scene, made) in scenes() {
        let mut rows = Vec::new();
        for (decoy, scores) in score_decoys(&made) {
            let broken = broken_bounds(&scores, &bounds);
            let seen_by = SEEN_BY.iter().find(|(name, _)| *name == decoy);
            match seen_by {
                None if broken.is_empty() => {}
                None => failures.push(format!("{scene}: {decoy} breaks {broken:?}")),
                Some((_, seen_by)) => {
                    let applies = |name: &&&str| {
                        let metric: Metric = name.parse().unwrap();
                        matches!(scores.get(metric), Measured::Score(_))
                    };
                    let seer = seen_by.iter().find(applies).unwrap();
                    if !broken.iter().any(|name| name == seer) {
                        failures.push(format!(
                            "{scene}: {seer} does not see {decoy}; broken: {broken:?}"
                        ));
                    }
                }
            }
            rows.push((decoy, broken));
        }
        columns.push((scene, rows));
    }
    let table = format_table(&columns);
    println!("{table}");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    let page = include_str!("../../../crates/metrics/DECOYS.md");
    assert!(
        page.contains(&table),
        "crates/metrics/DECOYS.md holds another table than this one:\n{table}"
    );
}
