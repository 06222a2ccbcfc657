//! Scores: reasons for not applying, pooling, names, groups and strictest bounds, scores as JSON.

mod pooling;
mod silence;

use std::collections::BTreeMap;

use metrics::{Group, Ideal, Metric, Region, Scores, SequenceMetric};
use tests::synthetic::{Blur, Object, Scene, Shape};
use tests::text::assert_contains;

use crate::{bar, measure_blur, scene};

/// Makes a disc of 8 px that slides 12 px to the right, and a still bar, in front of it or not.
fn small_scene(bar_at: [f64; 2]) -> Scene {
    let bar = Object::sliding(bar([2.0, 20.0], 0.0), bar_at, [0.0, 0.0]);
    let disc = Object::sliding(Shape::Disc(8.0), [46.2, 30.3], [12.0, 0.0]);
    scene([80, 60], vec![bar, disc])
}

/// Position of a bar next to the disc's path.
const BESIDE: [f64; 2] = [10.0, 30.0];

/// Position of a bar in the disc's path.
const BEFORE: [f64; 2] = [40.0, 30.0];

#[test]
fn every_metric_is_found_by_its_one_name() {
    let all = Metric::all();
    let more = SequenceMetric::ALL.into_iter().map(Metric::Sequence);
    for metric in all.iter().copied().chain(more).chain(Metric::OF_MEANS) {
        assert_eq!(metric.name().parse(), Ok(metric));
    }
    let names: std::collections::BTreeSet<String> =
        all.iter().map(|metric| metric.name()).collect();
    assert_eq!(names.len(), all.len());
    let error = "flip_mooving"
        .parse::<Metric>()
        .expect_err("no such metric");
    assert_contains(&error, &["\"flip_mooving\"", "flip_moving"]);
}

#[test]
fn every_metric_has_a_meaning_of_its_own_and_every_group_of_a_page_has_metrics() {
    let mut meanings: Vec<String> = Metric::all().into_iter().map(Metric::meaning).collect();
    meanings.sort();
    meanings.dedup();
    assert_eq!(meanings.len(), Metric::all().len());
    for group in Group::SHOWN {
        let is_own = |metric: &Metric| metric.group() == group;
        assert!(Metric::all().iter().any(is_own), "{group:?}");
    }
}

#[test]
fn the_documentation_has_a_row_for_every_metric_with_its_unit_and_its_ideal() {
    let page = include_str!("../../../crates/metrics/README.md");
    let mut rows = BTreeMap::new();
    for row in page.lines().filter(|line| line.starts_with("| `")) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        for name in cells[1].split(", ") {
            rows.insert(name.trim_matches('`').to_owned(), cells[3]);
        }
    }
    for metric in Metric::all() {
        let metric = match metric {
            Metric::Image(error, _) => Metric::Image(error, Region::Moving),
            other => other,
        };
        let better = match metric.ideal() {
            Ideal::Lowest => "low".to_owned(),
            Ideal::Highest => "high".to_owned(),
            Ideal::Target(value) => value.to_string(),
        };
        let due = match metric.unit() {
            "" => better,
            unit => format!("{}, {better}", unit.replace("^2", "²")),
        };
        let said = rows.get(&metric.name()).copied();
        assert_eq!(said, Some(due.as_str()), "{metric}");
    }
}

#[test]
fn scores_survive_being_written_as_json() {
    let scores = measure_blur(&small_scene(BEFORE), Blur::IDENTITY).scores;
    let text = serde_json::to_string(&scores).expect("scores are plain data");
    let back: Scores = serde_json::from_str(&text).expect("as written");
    assert_eq!(back, scores);
    let value = r#""static":{"mse":{"value":"#;
    let reason = r#""lateral_growth":{"not_applicable":"rows do not"#;
    assert_contains(&text, &[value, reason]);
}

#[test]
fn the_strictest_bound_lies_three_floors_from_perfect() {
    let metric = |name: &str| name.parse::<Metric>().expect("a name");
    let bound = |name: &str, floor| metric(name).strictest_bound(floor);
    assert_eq!(bound("flip_moving", 0.01), 0.03);
    assert!((bound("psnr_moving", 50.0) - 45.2288).abs() < 1e-4);
    assert_eq!(bound("n_eq", 48.0), 16.0);
    assert_eq!(bound("flicker", 0.5), 1.5);
    // Half a JOD below the perfect 10.
    assert_eq!(bound("jod", 9.5), 8.5);
    assert_eq!(metric("extent").ideal(), Ideal::Target(1.0));
}
