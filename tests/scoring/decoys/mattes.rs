//! Errors of mattes: energy, holes, and time given to the wrong object.

use tests::synthetic::{Blur, Object, Shape, constant};

use super::{Case, DISCS, NOTHING, RADIUS, assert_near, find_value, slide};

#[test]
fn a_constant_picture_keeps_the_energy_and_fails_everything_else() {
    let [_, disc, ..] = &*DISCS;
    let [scores] = &disc.score_pictures([constant(&disc.truth.mean())]);
    // The mean matte times the pixels, rounded to 32 bits.
    assert_near("energy", find_value(scores, "energy"), 1.0, 1e-4);
    for (name, least) in [
        ("bleed_lateral", 1.0),
        ("bleed_leading", 1.0),
        ("bleed_trailing", 1.0),
        ("lateral_growth", 1.0),
        ("row_loss", 1.0),
        ("misplacement", 10.0),
        ("extent", 2.0),
        ("label_tv", 0.1),
        ("flip_moving", 0.1),
    ] {
        assert!(
            find_value(scores, name) > least,
            "{name}: {}",
            find_value(scores, name)
        );
    }
}

#[test]
fn a_half_erased_bar_has_half_its_energy_and_half_a_hole() {
    let scene = slide(
        Shape::Bar {
            half: [25.0, 8.0],
            tilt: 0.0,
        },
        0.0,
    );
    let case = Case::new(scene);
    let mut faint = case.truth.mean();
    faint.coverage[1] = faint.coverage[1].map(|matte| 0.5 * matte);
    let [scores] = &case.score_pictures([faint]);
    // Halves of 32-bit numbers are exact.
    for (name, expected) in [("energy", 0.5), ("deficit", 0.5), ("hole", 0.5)] {
        assert_near(name, find_value(scores, name), expected, 1e-9);
    }
}

#[test]
fn label_total_variation_measures_the_time_of_wrong_objects() {
    // A bar as long as its way, moving along itself: the visible time at each of its three places is known.
    let scene = slide(
        Shape::Bar {
            half: [15.0, 8.0],
            tilt: 0.0,
        },
        0.0,
    );
    let case = Case::new(scene);
    let [scores] = case.score_blurs([Blur::IDENTITY]);
    // Ahead and behind, the truth ramps over 30 px, and the instant covers one of the ramps. |a - a*| sums to 15 px
    // ahead and to 15 px behind, over 16 rows. Half of it counts twice, for bar and background.
    let wrong = 16.0 * (15.0 + 15.0);
    let pixels = metrics::regions(&case.truth).moving.pixels;
    let region = pixels.iter().filter(|inside| **inside).count() as f64;
    // 512 samples per pixel.
    assert_near(
        "label_tv",
        find_value(&scores, "label_tv"),
        wrong / region,
        2e-3 * wrong / region,
    );
}

#[test]
fn a_filter_that_smears_a_still_bar_contaminates_the_occluder() {
    let post = Object::sliding(
        Shape::Bar {
            half: [3.0, 60.0],
            tilt: 0.0,
        },
        [56.0, 58.0],
        [0.0, 0.0],
    );
    let mut scene = slide(Shape::Disc(RADIUS), 0.0);
    scene.objects.insert(0, post);
    let case = Case::new(scene);
    let clean = case.truth.mean();
    let mut smeared = clean.clone();
    for index in 0..smeared.coverage[1].pixels.len() {
        let quarter = smeared.coverage[1].pixels[index] / 4.0;
        smeared.coverage[1].pixels[index] -= quarter;
        smeared.coverage[2].pixels[index] += quarter;
    }
    let scores = case.score_pictures([clean, smeared]);
    assert_near(
        "clean",
        find_value(&scores[0], "occluder_contamination"),
        0.0,
        NOTHING,
    );
    assert_near(
        "smeared",
        find_value(&scores[1], "occluder_contamination"),
        0.25,
        NOTHING,
    );
    let metric = "occluder_contamination".parse().expect("a metric's name");
    let (worst, _) = scores[1].worst_object(metric).expect("a still object");
    assert_eq!(worst, "object1");
}
