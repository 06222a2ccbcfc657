//! Wrong blurs against the bounds for all filters. On every scene each wrong blur breaks a bound,
//! and the right ones break none: two scenes in every run, and the tables of the page in
//! `make prove`.

pub mod decoys;
mod touches;
mod traced;

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
    let right = scene.render(&Blur::TRUE, APART);
    let mut pictures = decoys(scene, &frame, &right);
    pictures.push(("oracle", right));
    let many = Blur::accumulation(64);
    pictures.push(("accumulate:64", scene.render(&many, APART)));
    let rows = pictures
        .iter()
        .map(|(name, picture)| (*name, score(picture)));
    rows.collect()
}

const PAGE: &str = include_str!("../../../crates/metrics/DECOYS.md");

/// Scores that should detect a decoy: the first one that applies to a scene must. All decoys must
/// break a bound on three scenes.
const SEEN_BY: [(&str, &[&str]); 19] = [
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
    ("checkerboard, moving part", &["grain_support"]),
    ("grain, moving part", &["grain_support"]),
    ("still part blurred", &["static_contamination"]),
    ("double image", &["static_contamination"]),
    ("aeroplane erased", &["object_flip"]),
    ("hidden part guessed badly", &["flip_p95_moving"]),
];

/// Returns the names of the broken bounds. One that is stricter than the truth's noise allows shows
/// nothing.
fn broken_bounds(scores: &Scores, bounds: &Bounds) -> Vec<String> {
    let judged = judge_scores(scores, None, bounds).into_iter();
    let broken = judged.filter_map(|judged| match judged.outcome {
        Outcome::Broken => Some(judged.metric.name()),
        Outcome::Kept | Outcome::NotApplicable | Outcome::TooNoisy => None,
        other => panic!("{}: {other:?}", judged.metric),
    });
    broken.collect()
}

/// Correct pictures, which break no bound.
const RIGHT: [&str; 4] = [
    "oracle",
    "accumulate:64",
    "truth",
    "hidden part guessed well",
];

/// For each decoy of a scene the bounds that it breaks there.
struct Column(Vec<(&'static str, Vec<String>)>);

impl Column {
    /// Judges decoys; adds those that the right score does not see, and correct pictures that break
    /// a bound, to `failures`.
    fn new(scene: &str, decoys: Vec<(&'static str, Scores)>, failures: &mut Vec<String>) -> Self {
        let bounds = shared_bounds();
        let judged = decoys.into_iter().map(|(decoy, scores)| {
            let broken = broken_bounds(&scores, &bounds);
            if RIGHT.contains(&decoy) && !broken.is_empty() {
                failures.push(format!("{scene}: {decoy} breaks {broken:?}"));
            }
            if let Some(seer) = find_seer(decoy, &scores)
                && !broken.contains(&seer)
            {
                failures.push(format!(
                    "{scene}: {seer} does not see {decoy}; broken: {broken:?}"
                ));
            }
            (decoy, broken)
        });
        Self(judged.collect())
    }

    fn row(&self, decoy: &str) -> Option<&Vec<String>> {
        let mut rows = self.0.iter();
        rows.find(|(name, _)| *name == decoy)
            .map(|(_, broken)| broken)
    }
}

/// Finds the first score that applies of those that should detect a decoy; none for one that few
/// scenes or other scores show.
fn find_seer(decoy: &str, scores: &Scores) -> Option<String> {
    let (_, seen_by) = SEEN_BY.iter().find(|(name, _)| *name == decoy)?;
    let applies = |name: &&&str| {
        let metric: Metric = name.parse().unwrap();
        matches!(scores.get(metric), Measured::Score(_))
    };
    seen_by.iter().find(applies).map(|name| (*name).to_owned())
}

/// Lists the decoys of all scenes, correct pictures last.
fn list_decoys(columns: &[Column]) -> Vec<&'static str> {
    let mut decoys: Vec<&str> = Vec::new();
    for (decoy, _) in columns.iter().flat_map(|column| &column.0) {
        if !decoys.contains(decoy) {
            decoys.push(decoy);
        }
    }
    decoys.sort_by_key(|decoy| RIGHT.contains(decoy));
    decoys
}

/// Formats a table of the page: the bounds that each decoy breaks on all its scenes, and those that
/// it breaks on some, with their number.
fn format_table(columns: &[Column]) -> String {
    let mut text =
        "| wrong blur | scenes | breaks on all | on some |\n|---|---|---|---|\n".to_owned();
    let cell = |bounds: &[String]| {
        if bounds.is_empty() {
            "-".to_owned()
        } else {
            bounds.join(", ")
        }
    };
    for decoy in list_decoys(columns) {
        let rows: Vec<_> = columns
            .iter()
            .filter_map(|column| column.row(decoy))
            .collect();
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for bound in rows.iter().copied().flatten() {
            *counts.entry(bound.replace("_moving", "")).or_default() += 1;
        }
        let (mut everywhere, mut somewhere) = (Vec::new(), Vec::new());
        for (bound, count) in counts {
            if count == rows.len() {
                everywhere.push(bound)
            } else {
                somewhere.push(format!("{bound} ({count})"))
            }
        }
        let (all, some) = (cell(&everywhere), cell(&somewhere));
        text += &format!("| {decoy} | {} | {all} | {some} |\n", rows.len());
    }
    text
}

/// Prints a table, and expects it on the page and no failures.
fn check_table(columns: &[Column], failures: &[String]) {
    let table = format_table(columns);
    println!("{table}");
    for decoy in list_decoys(columns) {
        let broken = columns.iter().filter_map(|column| column.row(decoy));
        let count = broken.filter(|broken| !broken.is_empty()).count();
        assert!(
            RIGHT.contains(&decoy) || count >= 3,
            "{decoy} breaks a bound on {count} scenes; allowed: at least 3"
        );
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(
        PAGE.contains(&table),
        "crates/metrics/DECOYS.md holds another table than this one:\n{table}"
    );
}

/// Expects that the bounds that break in one scene fit the page's row of all five.
fn assert_fits_page(scene: &str, column: &Column) {
    for (decoy, broken) in &column.0 {
        let begin = format!("| {decoy} | 5 | ");
        let mut lines = PAGE.lines();
        let cells = lines.find_map(|line| line.strip_prefix(&begin)?.strip_suffix(" |"));
        let cells = cells.unwrap_or_else(|| panic!("the page lacks {decoy}"));
        let (everywhere, somewhere) = cells.split_once(" | ").expect("two cells");
        let has = |cell: &str, bound: &str| {
            let mut bounds = cell.split(", ");
            bounds.any(|text| text.split(" (").next() == Some(bound))
        };
        let broken: Vec<String> = (broken.iter())
            .map(|bound| bound.replace("_moving", ""))
            .collect();
        for bound in everywhere.split(", ").filter(|bound| *bound != "-") {
            let breaks = broken.iter().any(|name| name == bound);
            assert!(breaks, "{scene}: {decoy} keeps {bound}");
        }
        for bound in &broken {
            let is_known = has(everywhere, bound) || has(somewhere, bound);
            assert!(is_known, "{scene}: {decoy} breaks {bound}");
        }
    }
}

/// Scenes of every run: one that turns, to which scores along a translation do not apply, and one
/// of movers and still objects, to which they do.
const QUICK: [&str; 2] = ["turning bar", "overlap"];

#[test]
fn wrong_blurs_break_a_bound_and_the_right_blurs_break_none() {
    let mut failures = Vec::new();
    let is_quick = |(scene, _): &(&str, Scene)| QUICK.contains(scene);
    for (scene, made) in scenes().into_iter().filter(is_quick) {
        let column = Column::new(scene, score_decoys(&made), &mut failures);
        assert_fits_page(scene, &column);
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
#[ignore = "prove: five scenes, and their table"]
fn every_wrong_blur_breaks_a_bound_and_the_right_blurs_break_none() {
    let mut failures = Vec::new();
    let columns = scenes().into_iter().map(|(scene, made)| {
        let decoys = score_decoys(&made);
        Column::new(scene, decoys, &mut failures)
    });
    let columns: Vec<Column> = columns.collect();
    check_table(&columns, &failures);
}

#[test]
#[ignore = "prove: the decoys of traced scenes"]
fn every_wrong_picture_of_traced_scenes_breaks_a_bound_and_the_right_ones_break_none() {
    let mut failures = Vec::new();
    let columns = traced::SCENES.iter().map(|scene| {
        let (frame, truth) = scene.render();
        let reference = Reference::new(&frame, &truth, None, &frame.display.into()).unwrap();
        let decoys = scene.decoys(&frame, &truth).into_iter();
        let scored =
            decoys.map(|(name, picture)| (name, reference.measure(&picture).unwrap().scores));
        Column::new(scene.name, scored.collect(), &mut failures)
    });
    let columns: Vec<Column> = columns.collect();
    check_table(&columns, &failures);
}
