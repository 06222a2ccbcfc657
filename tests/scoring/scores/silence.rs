//! Scenes where a score means nothing, with its reason, and pictures that do not belong together.

use frame::{Frame, Picture, Raster, Truth};
use metrics::{Measured, ObjectMetric, Viewing, measure};
use tests::synthetic::{Blur, Object, Scene, Shape, VIEWING};

use super::{BEFORE, BESIDE, small_scene};
use crate::{bar, clean_truth, find_reason, find_value, measure_blur, measure_scores, smear};

/// Scores that need rows along a translation.
const ROW_SCORES: &str = "lateral_growth row_gain row_loss misplacement centroid extent";

#[test]
fn an_object_cut_off_by_the_border_has_no_row_scores_but_bleeds() {
    let mut scene = small_scene(BESIDE);
    scene.objects[1].center = [75.0, 30.0];
    let scores = measure_blur(&scene, Blur::IDENTITY).scores;
    for metric in ROW_SCORES.split(' ').chain(["energy"]) {
        assert!(find_reason(&scores, metric).contains("border"), "{metric}");
    }
    assert_eq!(find_value(&scores, "bleed_trailing"), 0.0);
}

/// Makes an arm that turns by `turn` radians while it travels, in place of the disc.
fn turning_arm(turn: f64, travel: f64) -> Scene {
    let mut scene = small_scene(BESIDE);
    scene.objects[1] = Object {
        turn,
        ..Object::sliding(bar([20.0, 3.0], 0.3), [46.0, 30.0], [travel, 0.0])
    };
    scene
}

#[test]
fn a_rotation_has_no_row_scores_but_bleeds() {
    // The arm turns in place, with a mean velocity of zero, and while it travels, with another.
    for travel in [0.0, 4.0] {
        let scores = measure_blur(&turning_arm(0.8, travel), Blur::IDENTITY).scores;
        for metric in ROW_SCORES.split(' ') {
            let reason = find_reason(&scores, metric);
            assert!(reason.contains("does not translate"), "{metric}: {reason}");
        }
        assert_eq!(find_value(&scores, "bleed_lateral"), 0.0);
        assert!(find_value(&scores, "label_tv") > 0.1);
    }
}

#[test]
fn turning_too_far_bleeds_ahead_of_the_local_motion() {
    let scores = measure_blur(&turning_arm(0.6, 0.0), smear(-1.0, 0.6)).scores;
    let leading = find_value(&scores, "bleed_leading");
    assert!(leading > 0.2, "{leading}");
    // The two ends of the arm swing towards opposite sides. Judged by one direction, half of this
    // would be trailing.
    let trailing = find_value(&scores, "bleed_trailing");
    assert!(trailing < 0.1 * leading, "{trailing}, {leading} leading");
}

#[test]
fn an_object_behind_another_cannot_tell_growth_from_occlusion() {
    let scores = measure_blur(&small_scene(BEFORE), Blur::IDENTITY).scores;
    assert!(find_reason(&scores, "lateral_growth").contains("rows do not keep their mass"));
    // Rows are normalised there: half of the path of 12 px, and the part of it that the bar hides.
    assert!((find_value(&scores, "misplacement") - 6.0).abs() < 1.5);
}

#[test]
fn still_and_unseen_objects_have_no_scores_and_say_why() {
    let mut scene = small_scene(BESIDE);
    let hidden = Object::sliding(Shape::Disc(1.0), BESIDE, [5.0, 0.0]);
    scene.objects.push(hidden);
    let scores = measure_blur(&scene, Blur::IDENTITY).scores;
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
    let scores = measure_scores(&truth.mean(), &frame, &truth);
    for metric in ["lateral_growth", "bleed_lateral"] {
        let reason = find_reason(&scores, metric);
        assert!(reason.contains("no silhouette"), "{metric}: {reason}");
    }
}

#[test]
fn a_scene_without_motion_has_nothing_to_score_but_stillness() {
    let mut scene = small_scene(BESIDE);
    scene.objects.truncate(1);
    let scores = measure_blur(&scene, Blur::IDENTITY).scores;
    for (metric, reason) in [
        ("flip_moving", "nothing moves on screen"),
        ("label_tv", "nothing moves on screen"),
        ("lateral_growth", "no object moves on screen"),
        // The scores have no ladder to count sub-frames by.
        ("n_eq", "no ladder of accumulations was given"),
    ] {
        assert_eq!(find_reason(&scores, metric), reason);
    }
    assert_eq!(find_value(&scores, "flip_static"), 0.0);
}

#[test]
fn a_hole_needs_a_pixel_that_is_covered_throughout() {
    let mut scene = small_scene(BESIDE);
    scene.objects[1].displacement = [30.0, 0.0];
    let scores = measure_blur(&scene, Blur::IDENTITY).scores;
    assert!(find_reason(&scores, "hole").contains("covers no pixel throughout"));
}

/// A mistake in the input.
type Change = fn(&mut Given);

/// Input of a measurement: the output, the frame, the truth and the viewing conditions.
type Given = (Picture, Frame, Truth, Viewing);

#[test]
fn invalid_and_mismatched_pictures_are_refused_by_name() {
    let scene = small_scene(BESIDE);
    let truth = clean_truth(&scene);
    let right: Given = (truth.mean(), scene.frame(), truth, VIEWING);
    let changes: [Change; 7] = [
        |(output, ..)| output.color.pixels[3 * 80 + 7][1] = f32::NAN,
        |(output, ..)| output.coverage[2].pixels[0] = f32::INFINITY,
        |(output, ..)| output.coverage.truncate(2),
        |(output, ..)| output.color = Raster::filled(81, 60, [0.0; 3]),
        |(_, frame, ..)| frame.exposure = 1.0,
        |(.., truth, _)| truth.motion = Raster::filled(7680, 4320, 0.0),
        |(.., viewing)| viewing.flip_count = 1,
    ];
    let due = "the colour of the output holds NaN at pixel (7, 3)
        the matte of object2 in the output holds inf
        the output has 2 mattes, the truth has 3 objects
        the output is 81x60, the truth is 80x60
        the frame's exposure has 1.0, the truth has 0.5
        7680x4320; at most 28000000 pixels
        in 1 steps; allowed";
    assert_eq!(due.lines().count(), changes.len());
    for (change, words) in changes.into_iter().zip(due.lines()) {
        let mut given = right.clone();
        change(&mut given);
        let (output, frame, truth, viewing) = &given;
        let error = measure(output, frame, truth, None, viewing).expect_err(words);
        assert!(error.to_string().contains(words.trim()), "{error}");
    }
}
