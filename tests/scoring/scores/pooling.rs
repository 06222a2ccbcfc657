//! Regions and maps for pooling scores.

use frame::Raster;
use metrics::{Measured, Metric, ObjectMetric, measure, regions};
use tests::synthetic::{Blur, Object, Shape, VIEWING};

use super::{BESIDE, small_scene};
use crate::{assert_near, clean_truth, find_value, measure_blur, measure_scores, smear};

#[test]
fn the_moving_region_extends_a_fifteenth_of_the_height_beyond_movers() {
    let mut truth = clean_truth(&small_scene(BESIDE));
    truth.support.moving = Raster::from_fn(80, 60, |x, y| (x, y) == (40, 30));
    let pools = regions(&truth);
    for (reach, inside) in [(4, true), (5, false)] {
        assert_eq!(*pools.moving.at(40 + reach, 30), inside);
        assert_eq!(*pools.moving.at(40, 30 - reach), inside);
        assert_eq!(*pools.still.at(40 + reach, 30), !inside);
    }
    assert_eq!(pools.support, truth.support.moving);
}

#[test]
fn an_error_in_a_still_pixel_counts_as_static_and_not_as_moving() {
    let scene = small_scene(BESIDE);
    let (frame, truth) = (scene.frame(), clean_truth(&scene));
    let mut output = truth.mean();
    let corner = 79;
    output.color.pixels[corner] = output.color.pixels[corner].map(|value| value + 0.25);
    let scores = measure_scores(&output, &frame, &truth);
    let still = regions(&truth).still.pixels;
    let still = still.iter().filter(|still| **still).count() as f64;
    assert_eq!(find_value(&scores, "mse_moving"), 0.0);
    // 32-bit rounding of the sum with 0.25.
    assert!((find_value(&scores, "mse_static") - 0.0625 / still).abs() < 1e-8 / still);
    assert!((find_value(&scores, "mse_full") - 0.0625 / 4800.0).abs() < 1e-8 / 4800.0);
}

#[test]
fn errors_of_colour_use_the_viewing_exposure() {
    let scene = small_scene(BESIDE);
    let (frame, truth) = (scene.frame(), clean_truth(&scene));
    let mut output = truth.mean();
    output.color = output.color.map(|pixel| pixel.map(|value| value + 0.125));
    let mut bright = VIEWING;
    bright.stops = 2.0;
    let scores = measure(&output, &frame, &truth, None, &bright);
    let scores = scores.expect("they agree").scores;
    // An offset of 1/8, two stops up: 1/2, squared 1/4, which is 6.02 dB below 1. Rounding of
    // 32-bit sums.
    assert!((find_value(&scores, "mse_full") - 0.25).abs() < 1e-5);
    assert!((find_value(&scores, "psnr_full") - 6.0206).abs() < 1e-3);
    let values = truth.mean().color.pixels;
    let terms =
        (values.iter().flatten()).map(|value| 0.25 / ((4.0 * f64::from(*value)).powi(2) + 0.01));
    let expected = terms.sum::<f64>() / (3.0 * 4800.0);
    assert!((find_value(&scores, "relmse_full") / expected - 1.0).abs() < 1e-4);
}

#[test]
fn scores_are_pooled_from_their_metrics_maps() {
    let measurement = measure_blur(&small_scene(BESIDE), Blur::accumulation(2));
    let pools = regions(&clean_truth(&small_scene(BESIDE)));
    let names = "mse_moving relmse_moving mae_moving smape_moving flip_moving flip_full flip_hdr_moving label_tv mse_frozen";
    for name in names.split_whitespace() {
        let metric: Metric = name.parse().unwrap();
        let map = measurement.map(metric.row().map).expect("no probe's map");
        let values = pools.select(metric.region(), map);
        let mean = values.iter().map(|value| f64::from(*value)).sum::<f64>() / values.len() as f64;
        assert!(mean > 0.0, "{name} has an error to show");
        // Maps are stored in 32 bits.
        let score = find_value(&measurement.scores, name);
        assert!((score / mean - 1.0).abs() < 1e-6, "{name}");
    }
}

#[test]
fn the_bleed_map_holds_coverage_outside_the_support() {
    let measurement = measure_blur(&small_scene([10.0, 10.0]), smear(-2.0, 0.0));
    let bleed = measurement.maps.bleed.pixels.iter();
    let total: f64 = bleed.map(|value| f64::from(*value)).sum();
    let scores = &measurement.scores;
    let [beside, behind] = ["bleed_lateral", "bleed_trailing"].map(|name| find_value(scores, name));
    // The disc's silhouette is 16 px wide across the motion and twice 16 px along it, to the 2 % of
    // its gradients.
    let expected = 32.0 * beside + 16.0 * behind;
    assert_near("pixels", total, expected, 0.02 * expected);
    assert!(total > 16.0);
}

#[test]
fn the_worst_object_s_score_is_the_scene_s() {
    let mut scene = small_scene(BESIDE);
    scene
        .objects
        .push(Object::sliding(Shape::Disc(4.0), [50.0, 52.0], [12.0, 0.0]));
    let mut scores = measure_blur(&scene, Blur::IDENTITY).scores;
    scores.objects[1].extent = Measured::score(0.9, 0.0);
    scores.objects[2].extent = Measured::score(1.3, 0.0);
    assert_eq!(find_value(&scores, "extent"), 1.3);
    scores.objects[1].extent = Measured::score(0.5, 0.0);
    assert_eq!(find_value(&scores, "extent"), 0.5);
    let extent = Metric::Object(ObjectMetric::Extent);
    let worst = scores.worst_object(extent).map(|(name, _)| name);
    assert_eq!(worst, Some("object2"));
}

#[test]
fn the_largest_bleed_is_found_on_every_side() {
    let mut scores = measure_blur(&small_scene(BESIDE), Blur::IDENTITY).scores;
    for (sides, largest, pixels) in [
        ([0.0, 4.8, 4.7], ObjectMetric::BleedLeading, 4.8),
        ([0.0, 4.7, 4.8], ObjectMetric::BleedTrailing, 4.8),
        ([0.1, 0.1, 0.1], ObjectMetric::BleedLateral, 0.1),
    ] {
        let [lateral, leading, trailing] = sides.map(|value| Measured::score(value, 0.0));
        scores.objects[1].bleed_lateral = lateral;
        scores.objects[1].bleed_leading = leading;
        scores.objects[1].bleed_trailing = trailing;
        let (side, score) = scores.largest_bleed().expect("it has mattes");
        assert_eq!((side, score.value), (largest, pixels));
    }
    scores.take_out_mattes("no mattes");
    assert_eq!(scores.largest_bleed(), None);
}
