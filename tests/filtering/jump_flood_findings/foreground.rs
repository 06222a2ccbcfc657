//! Weight of surfaces in front of a trail.

use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, Surface, column, white};

/// Source of the trail.
const BACKGROUND: Surface = BLACK_WALL.moving(21.0, 0.0);

/// Returns the weight of the one tap of eight that reaches a white surface in front. The surface
/// moves right by `other`, and the trail's source by 21 pixels.
fn weight_in_front(preset: &str, other: f32) -> f64 {
    let picture = Picture::halves(160, 24, BACKGROUND, white(other));
    // One step of 64 pixels carries nothing, so every pixel is its own source. Taps are 3 pixels
    // apart, on pixel centres.
    let overrides = "jitter=none passes=1 step_multiplier=64";
    let output = picture.blur("jump_flood", preset, overrides);
    // Only the seventh tap is beyond. All others weigh 1, so it gets w / (7 + w).
    let share = f64::from(output.at(80 - 21, 12)[0]);
    7.0 * share / (1.0 - share)
}

#[test]
fn a_tenth_root_makes_a_difference_in_motion_nearly_binary() {
    for (difference, weight) in [(0.01, 0.369), (0.1, 0.206), (0.5, 0.067), (1.0, 0.0)] {
        let actual = weight_in_front("paper", 21.0 * (1.0 - difference as f32));
        // 32-bit floats: a hundredth of the motion is known to 1e-5 of itself, and its root is
        // known better.
        assert_near(actual, weight, 0.001);
    }
    assert_near(weight_in_front("paper", 21.0), 1.0, 1e-5);
}

#[test]
fn the_version_of_two_days_later_weights_and_replaces_taps() {
    // A tap in front stays in place, so only its weight can exclude it.
    for (difference, weight) in [(0.1, 0.206), (1.0, 0.0)] {
        let actual = weight_in_front("july_2024", 21.0 * (1.0 - difference as f32));
        // Positions of 16 bits are 0.03 pixels off, which mixes as much of the next colour into the
        // tap.
        assert_near(actual, weight, 0.04);
    }
}

#[test]
fn the_last_bit_of_a_motion_takes_a_fifth_of_the_weight() {
    let actual = weight_in_front("paper", 21.0f32.next_down());
    // (9e-8)^0.1 = 0.198; the quotient of two roundings may be twice or half that difference.
    assert_within(actual, 0.75..0.85);
}

#[test]
fn a_faster_surface_in_the_same_direction_counts_fully() {
    for faster in [22.0, 42.0, 60.0] {
        assert_near(weight_in_front("paper", faster), 1.0, 1e-5);
    }
}

#[test]
fn a_still_surface_in_front_neither_blurs_nor_is_smeared() {
    // Taps 3 pixels apart are on pixel centres; between them, half a pixel at the post's edge would
    // mix.
    let light = |depth: f32| {
        let picture = Picture::new(200, 24, |x, _| match x {
            90..110 => white(0.0).at(depth),
            _ => BACKGROUND,
        });
        let output = picture.blur("jump_flood", "paper", "jitter=none");
        let post = (90..110).map(|x| column(&output, x));
        [column(&output, 80), post.fold(1.0, f64::min)]
    };
    // The post's own pixels find no source, and taps that reach the post do not count.
    assert_eq!(light(2.0), [0.0, 1.0]);
    // Behind the background it counts in full, and the background smears over it.
    let [background, darkest] = light(30.0);
    assert_near(background, 4.0 / 8.0, 1e-5);
    assert_within(darkest, ..0.9);
}
