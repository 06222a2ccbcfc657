//! When scores are silent, what they do not depend on, and how they are named, stored and refused.

use frame::{Frame, Picture, Raster, Truth};
use metrics::{
    Group, Ideal, ImageMetric, MeasureError, Measured, Measurement, Metric, ObjectMetric, Region,
    Scores, Viewing, measure, regions,
};
use tests::synthetic::{Blur, Object, Sampling, Scene, Shape, VIEWING};

/// A disc of 8 px that slides 12 px to the right, and a bar that stands still, in front of it or not.
fn small_scene(bar_at: [f64; 2]) -> Scene {
    let bar = Shape::Bar {
        half: [2.0, 20.0],
        tilt: 0.0,
    };
    Scene {
        width: 80,
        height: 60,
        objects: vec![
            Object::sliding(bar, bar_at, [0.0, 0.0]),
            Object::sliding(Shape::Disc(8.0), [46.2, 30.3], [12.0, 0.0]),
        ],
    }
}

/// What stands beside the disc's way.
const BESIDE: [f64; 2] = [10.0, 30.0];
/// What stands in its way.
const BEFORE: [f64; 2] = [40.0, 30.0];

fn clean_truth(scene: &Scene) -> Truth {
    scene.truth([Sampling::CLEAN; 2])
}

fn measured(scene: &Scene, blur: Blur) -> Measurement {
    let output = scene.render(&blur, Sampling::CLEAN);
    measure(&output, &scene.frame(), &clean_truth(scene), None, &VIEWING).expect("they agree")
}

fn reason(scores: &Scores, metric: &str) -> String {
    match scores.get(metric.parse().expect("a metric's name")) {
        Measured::NotApplicable { reason } => reason,
        Measured::Score(score) => panic!("{metric} scores {} where it means nothing", score.value),
    }
}

fn value(scores: &Scores, metric: &str) -> f64 {
    let measured = scores.get(metric.parse().expect("a metric's name"));
    measured
        .value()
        .unwrap_or_else(|| panic!("{metric}: {measured:?}"))
}

/// Scores that need rows along a translation.
const ROW_SCORES: [&str; 6] = [
    "lateral_growth",
    "row_gain",
    "row_loss",
    "misplacement",
    "centroid",
    "extent",
];

#[test]
fn an_object_cut_off_by_the_border_has_no_row_scores_but_bleeds() {
    let mut scene = small_scene(BESIDE);
    scene.objects[1].center = [75.0, 30.0];
    let scores = measured(&scene, Blur::IDENTITY).scores;
    for metric in ROW_SCORES.iter().chain(&["energy"]) {
        assert!(reason(&scores, metric).contains("border"), "{metric}");
    }
    assert_eq!(value(&scores, "bleed_trailing"), 0.0);
}

#[test]
fn a_rotation_has_no_row_scores_but_bleeds() {
    let mut scene = small_scene(BESIDE);
    let arm = Shape::Bar {
        half: [20.0, 3.0],
        tilt: 0.3,
    };
    // In place, and while it travels: the mean of its velocities is nothing, and something.
    for travel in [0.0, 4.0] {
        scene.objects[1] = Object {
            turn: 0.8,
            ..Object::sliding(arm, [46.0, 30.0], [travel, 0.0])
        };
        let scores = measured(&scene, Blur::IDENTITY).scores;
        for metric in ROW_SCORES {
            let reason = reason(&scores, metric);
            assert!(reason.contains("does not translate"), "{metric}: {reason}");
        }
        assert_eq!(value(&scores, "bleed_lateral"), 0.0);
        assert!(value(&scores, "label_tv") > 0.1);
    }
}

#[test]
fn turning_too_far_bleeds_ahead_of_the_local_motion() {
    let mut scene = small_scene(BESIDE);
    let arm = Shape::Bar {
        half: [20.0, 3.0],
        tilt: 0.3,
    };
    scene.objects[1] = Object {
        turn: 0.6,
        ..Object::sliding(arm, [46.0, 30.0], [0.0, 0.0])
    };
    let ahead = Blur {
        to: 0.6,
        ..Blur::TRUE
    };
    let scores = measured(&scene, ahead).scores;
    let leading = value(&scores, "bleed_leading");
    assert!(leading > 0.2, "{leading}");
    // The two ends of the arm swing towards opposite sides; judged by one direction, half of this would be trailing.
    let trailing = value(&scores, "bleed_trailing");
    assert!(
        trailing < 0.1 * leading,
        "{trailing} trailing, {leading} leading"
    );
}

#[test]
fn an_object_behind_another_cannot_tell_growth_from_occlusion() {
    let scores = measured(&small_scene(BEFORE), Blur::IDENTITY).scores;
    assert!(reason(&scores, "lateral_growth").contains("rows do not keep their mass"));
    // Rows are normalised there: half of the way of 12 px, and what the bar hides of it.
    assert!((value(&scores, "misplacement") - 6.0).abs() < 1.5);
}

#[test]
fn objects_that_stand_still_or_are_not_seen_say_so() {
    let mut scene = small_scene(BESIDE);
    let hidden = Object::sliding(Shape::Disc(1.0), BESIDE, [5.0, 0.0]);
    scene.objects.push(hidden);
    let scores = measured(&scene, Blur::IDENTITY).scores;
    let of = |object: usize| match scores.objects[object].get(ObjectMetric::BleedLateral) {
        Measured::NotApplicable { reason } => reason.clone(),
        Measured::Score(_) => "a score".to_owned(),
    };
    assert_eq!(scores.objects[1].displacement, [12.0, 0.0]);
    assert_eq!(of(0), "does not move");
    assert_eq!(of(1), "a score");
    assert_eq!(of(2), "is not visible at the instant");
}

#[test]
fn an_object_with_an_id_but_no_coverage_has_no_outline_to_measure_by() {
    let scene = small_scene(BESIDE);
    let (mut frame, truth) = (scene.frame(), clean_truth(&scene));
    frame.coverage[2] = Raster::filled(80, 60, 0.0);
    let output = truth.mean();
    let scores = measure(&output, &frame, &truth, None, &VIEWING)
        .expect("they agree")
        .scores;
    for metric in ["lateral_growth", "bleed_lateral"] {
        assert!(
            reason(&scores, metric).contains("no silhouette"),
            "{metric}"
        );
    }
}

#[test]
fn a_scene_without_motion_has_nothing_to_score_but_stillness() {
    let mut scene = small_scene(BESIDE);
    scene.objects.truncate(1);
    let scores = measured(&scene, Blur::IDENTITY).scores;
    assert_eq!(reason(&scores, "flip_moving"), "nothing moves on screen");
    assert_eq!(reason(&scores, "label_tv"), "nothing moves on screen");
    assert_eq!(
        reason(&scores, "lateral_growth"),
        "no object moves on screen"
    );
    assert_eq!(value(&scores, "flip_static"), 0.0);
}

#[test]
fn without_a_ladder_there_is_no_count_of_sub_frames() {
    let scores = measured(&small_scene(BESIDE), Blur::IDENTITY).scores;
    assert_eq!(
        reason(&scores, "n_eq"),
        "no ladder of accumulations was given"
    );
}

#[test]
fn a_hole_needs_a_pixel_that_is_covered_throughout() {
    let mut scene = small_scene(BESIDE);
    scene.objects[1].displacement = [30.0, 0.0];
    let scores = measured(&scene, Blur::IDENTITY).scores;
    assert!(reason(&scores, "hole").contains("covers no pixel throughout"));
}

#[test]
fn the_moving_region_reaches_a_fifteenth_of_the_height_beyond_what_moves() {
    let mut truth = clean_truth(&small_scene(BESIDE));
    truth.support.moving = Raster::from_fn(80, 60, |x, y| (x, y) == (40, 30));
    let regions = regions(&truth);
    for (reach, inside) in [(4, true), (5, false)] {
        assert_eq!(*regions.moving.at(40 + reach, 30), inside);
        assert_eq!(*regions.moving.at(40, 30 - reach), inside);
        assert_eq!(*regions.still.at(40 + reach, 30), !inside);
    }
    assert_eq!(regions.support, truth.support.moving);
}

#[test]
fn an_error_in_a_still_pixel_counts_as_static_and_not_as_moving() {
    let scene = small_scene(BESIDE);
    let (frame, truth) = (scene.frame(), clean_truth(&scene));
    let mut output = truth.mean();
    let corner = 79;
    output.color.pixels[corner] = output.color.pixels[corner].map(|value| value + 0.25);
    let scores = measure(&output, &frame, &truth, None, &VIEWING)
        .expect("they agree")
        .scores;
    let still = regions(&truth)
        .still
        .pixels
        .iter()
        .filter(|still| **still)
        .count() as f64;
    assert_eq!(value(&scores, "mse_moving"), 0.0);
    // 32-bit rounding of the sum with 0.25.
    assert!((value(&scores, "mse_static") - 0.0625 / still).abs() < 1e-8 / still);
    assert!((value(&scores, "mse_full") - 0.0625 / 4800.0).abs() < 1e-8 / 4800.0);
}

#[test]
fn errors_of_colour_are_those_of_the_viewing_exposure() {
    let scene = small_scene(BESIDE);
    let (frame, truth) = (scene.frame(), clean_truth(&scene));
    let mut output = truth.mean();
    output.color = output.color.map(|pixel| pixel.map(|value| value + 0.125));
    let bright = Viewing {
        stops: 2.0,
        ..VIEWING
    };
    let scores = measure(&output, &frame, &truth, None, &bright)
        .expect("they agree")
        .scores;
    // An offset of 1/8, two stops up: 1/2, squared 1/4, which is 6.02 dB below 1. Rounding of 32-bit sums.
    assert!((value(&scores, "mse_full") - 0.25).abs() < 1e-5);
    assert!((value(&scores, "psnr_full") - 6.0206).abs() < 1e-3);
    let mean = truth.mean();
    let expected: f64 = mean
        .color
        .pixels
        .iter()
        .flatten()
        .map(|value| 0.25 / ((4.0 * f64::from(*value)).powi(2) + 0.01))
        .sum::<f64>()
        / (3.0 * 4800.0);
    assert!((value(&scores, "relmse_full") / expected - 1.0).abs() < 1e-4);
}

#[test]
fn scores_are_pooled_from_the_maps_that_their_rows_name() {
    let measurement = measured(&small_scene(BESIDE), Blur::accumulation(2));
    let regions = regions(&clean_truth(&small_scene(BESIDE)));
    for name in [
        "mse_moving",
        "relmse_moving",
        "mae_moving",
        "smape_moving",
        "flip_moving",
        "flip_full",
        "flip_hdr_moving",
        "label_tv",
        "mse_frozen",
    ] {
        let metric: Metric = name.parse().unwrap();
        let map = measurement.map(metric.row().map).expect("no probe's map");
        let values = regions.select(metric.region(), map);
        let mean = values.iter().map(|value| f64::from(*value)).sum::<f64>() / values.len() as f64;
        assert!(mean > 0.0, "{name} has an error to show");
        // Maps are stored in 32 bits.
        let score = value(&measurement.scores, name);
        assert!((score / mean - 1.0).abs() < 1e-6, "{name}");
    }
}

#[test]
fn the_bleed_map_holds_what_lies_outside_the_support() {
    let long = Blur {
        from: -2.0,
        ..Blur::TRUE
    };
    let scene = small_scene([10.0, 10.0]);
    let measurement = measured(&scene, long);
    let total: f64 = measurement
        .maps
        .bleed
        .pixels
        .iter()
        .map(|value| f64::from(*value))
        .sum();
    let scores = &measurement.scores;
    let [beside, behind] = ["bleed_lateral", "bleed_trailing"].map(|name| value(scores, name));
    // The disc's silhouette is 16 px wide across the motion and twice 16 px along it, to the 2 % of its gradients.
    let expected = 32.0 * beside + 16.0 * behind;
    assert!(
        (total / expected - 1.0).abs() < 0.02,
        "{total} px, expected {expected}"
    );
    assert!(total > 16.0);
}

#[test]
fn every_metric_has_one_name_that_finds_it() {
    let all = Metric::all();
    for metric in &all {
        assert_eq!(metric.name().parse(), Ok(*metric));
    }
    let names: std::collections::BTreeSet<String> =
        all.iter().map(|metric| metric.name()).collect();
    assert_eq!(names.len(), all.len());
    let error = "flip_mooving"
        .parse::<Metric>()
        .expect_err("no such metric");
    assert!(
        error.contains("\"flip_mooving\"") && error.contains("flip_moving"),
        "{error}"
    );
}

#[test]
fn every_metric_has_a_meaning_of_its_own() {
    let all: Vec<String> = Metric::all().into_iter().map(Metric::meaning).collect();
    for (index, meaning) in all.iter().enumerate() {
        assert!(!all[..index].contains(meaning), "two mean \"{meaning}\"");
    }
}

#[test]
fn every_group_that_a_page_shows_has_metrics() {
    let all = Metric::all();
    for group in Group::SHOWN {
        assert!(
            all.iter().any(|metric| metric.group() == group),
            "{group:?}"
        );
    }
}

#[test]
fn the_documentation_names_every_metric() {
    let page = include_str!("../../crates/metrics/README.md");
    for metric in ImageMetric::ALL {
        let name = Metric::Image(metric, Region::Moving).name();
        assert!(page.contains(&format!("`{name}`")), "{name}");
    }
    for metric in Metric::all() {
        if !matches!(metric, Metric::Image(..)) {
            assert!(page.contains(&format!("`{metric}`")), "{metric}");
        }
    }
}

#[test]
fn the_worst_object_speaks_for_all() {
    let mut scene = small_scene(BESIDE);
    scene
        .objects
        .push(Object::sliding(Shape::Disc(4.0), [50.0, 52.0], [12.0, 0.0]));
    let mut scores = measured(&scene, Blur::IDENTITY).scores;
    scores.objects[1].extent = Measured::score(0.9, 0.0);
    scores.objects[2].extent = Measured::score(1.3, 0.0);
    assert_eq!(value(&scores, "extent"), 1.3);
    scores.objects[1].extent = Measured::score(0.5, 0.0);
    assert_eq!(value(&scores, "extent"), 0.5);
    let extent = Metric::Object(ObjectMetric::Extent);
    assert_eq!(
        scores.worst_object(extent).map(|(name, _)| name),
        Some("object2")
    );
}

#[test]
fn the_largest_bleed_is_found_on_whichever_side_it_is() {
    let mut scores = measured(&small_scene(BESIDE), Blur::IDENTITY).scores;
    let mut largest = |values: [f64; 3]| {
        let [lateral, leading, trailing] = values.map(|value| Measured::score(value, 0.0));
        scores.objects[1].bleed_lateral = lateral;
        scores.objects[1].bleed_leading = leading;
        scores.objects[1].bleed_trailing = trailing;
        scores
            .largest_bleed()
            .map(|(side, score)| (side, score.value))
    };
    assert_eq!(
        largest([0.0, 4.8, 4.7]),
        Some((ObjectMetric::BleedLeading, 4.8))
    );
    assert_eq!(
        largest([0.0, 4.7, 4.8]),
        Some((ObjectMetric::BleedTrailing, 4.8))
    );
    assert_eq!(
        largest([0.1, 0.1, 0.1]),
        Some((ObjectMetric::BleedLateral, 0.1))
    );
    scores.take_out_mattes("no mattes");
    assert_eq!(scores.largest_bleed(), None);
}

#[test]
fn scores_survive_being_written_as_json() {
    let scores = measured(&small_scene(BEFORE), Blur::IDENTITY).scores;
    let text = serde_json::to_string(&scores).expect("scores are plain data");
    let back: Scores = serde_json::from_str(&text).expect("as written");
    assert_eq!(back, scores);
    assert!(text.contains(r#""static":{"mse":{"value":"#), "{text}");
    assert!(
        text.contains(r#""lateral_growth":{"not_applicable":"rows do not"#),
        "{text}"
    );
}

#[test]
fn the_strictest_bound_lies_three_floors_from_perfect() {
    let bound = |name: &str, floor| {
        name.parse::<Metric>()
            .expect("a name")
            .strictest_bound(floor)
    };
    assert_eq!(bound("flip_moving", 0.01), 0.03);
    assert!((bound("psnr_moving", 50.0) - 45.2288).abs() < 1e-4);
    assert_eq!(bound("n_eq", 48.0), 16.0);
    assert_eq!(
        Metric::Object(ObjectMetric::Extent).ideal(),
        Ideal::Target(1.0)
    );
}

#[test]
fn pictures_that_do_not_belong_together_are_refused_by_name() {
    let scene = small_scene(BESIDE);
    let (frame, truth) = (scene.frame(), clean_truth(&scene));
    let output = truth.mean();
    let refuse = |output: &Picture, frame: &Frame, viewing: &Viewing| -> String {
        let error: MeasureError =
            measure(output, frame, &truth, None, viewing).expect_err("a wrong input");
        error.to_string()
    };

    let mut broken = output.clone();
    broken.color.pixels[3 * 80 + 7][1] = f32::NAN;
    let text = refuse(&broken, &frame, &VIEWING);
    assert!(
        text.contains("the colour of the output holds NaN at pixel (7, 3)"),
        "{text}"
    );

    let mut broken = output.clone();
    broken.coverage[2].pixels[0] = f32::INFINITY;
    let text = refuse(&broken, &frame, &VIEWING);
    assert!(
        text.contains("the matte of object2 in the output holds inf"),
        "{text}"
    );

    let mut broken = output.clone();
    broken.coverage.pop();
    let text = refuse(&broken, &frame, &VIEWING);
    assert!(
        text.contains("the output has 2 mattes, the truth has 3 objects"),
        "{text}"
    );

    let mut broken = output.clone();
    broken.color = Raster::filled(81, 60, [0.0; 3]);
    let text = refuse(&broken, &frame, &VIEWING);
    assert!(
        text.contains("the output is 81x60, the truth is 80x60"),
        "{text}"
    );

    let mut other = frame.clone();
    other.exposure = 1.0;
    let text = refuse(&output, &other, &VIEWING);
    assert!(
        text.contains("the frame's exposure has 1.0, the truth has 0.5"),
        "{text}"
    );

    let mut huge = truth.clone();
    huge.motion = Raster::filled(7680, 4320, 0.0);
    let text = measure(&output, &frame, &huge, None, &VIEWING)
        .expect_err("more than FLIP takes")
        .to_string();
    assert!(
        text.contains("7680x4320; at most 28000000 pixels"),
        "{text}"
    );

    let viewing = Viewing {
        flip_count: 1,
        ..VIEWING
    };
    let text = refuse(&output, &frame, &viewing);
    assert!(text.contains("in 1 steps; allowed"), "{text}");
}
