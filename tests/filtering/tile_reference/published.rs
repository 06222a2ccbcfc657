//! Claims about the published repository of the preset `motion_blur_demo`, each shown to be true or
//! false.
//!
//! shaders/mcguire/README.md lists the outcomes.

use frame::Image;
use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, white};

const WIDTH: u32 = 97;
const HEIGHT: u32 = 31;
/// Speed in pixels per frame: 8 of half-velocity, so that 15 unshifted taps are on the whole pixels
/// from -7 to 7.
const SPEED: f32 = 16.0;
/// Column where objects begin or end, in the middle of the image.
const EDGE: u32 = 48;

/// Makes a picture in which everything moves right alike, at one depth.
fn steady(gray: impl Fn(u32) -> f32) -> Picture {
    Picture::new(WIDTH, HEIGHT, |x, _| white(SPEED).at(5.0).gray(gray(x)))
}

/// Makes a white surface left of the edge that moves right, next to a still black one.
fn mover_beside_still(mover_depth: f32, still_depth: f32) -> Picture {
    let [mover, still] = [white(SPEED).at(mover_depth), BLACK_WALL.at(still_depth)];
    Picture::halves(WIDTH, HEIGHT, mover, still)
}

fn motion_blur_demo(picture: &Picture, changes: &str) -> Image {
    picture.blur("mcguire", "motion_blur_demo", changes)
}

/// Returns the weight of the tap -7 to 7 pixels from a pixel.
fn tap_weights(changes: &str) -> impl Fn(i64) -> f32 {
    let output = motion_blur_demo(&steady(|x| if x == EDGE { 1.0 } else { 0.0 }), changes);
    move |offset| output.at((i64::from(EDGE) - offset) as u32, HEIGHT / 2)[0]
}

#[test]
fn distances_in_uv_give_far_taps_the_weight_of_near_ones() {
    let published = tap_weights("jitter=none");
    let repaired = tap_weights("jitter=none distance=to_pixel");
    for side in [-1, 1] {
        // 7 pixels of 97 are 0.07, against a radius of 8: cones of 0.99, and whole cylinders.
        assert_within(published(7 * side) / published(side), 0.99..=1.0);
        // Two cones of 1/8 and 7/8, and two whole cylinders.
        assert_near(repaired(7 * side) / repaired(side), 2.25 / 3.75, 1e-3);
    }
}

#[test]
fn the_filter_averages_moving_taps_and_not_every_tap() {
    let changes: &str = "jitter=none center_tap=skipped";
    let output = motion_blur_demo(&mover_beside_still(5.0, 5.0), changes);
    for (beside, movers) in [(0, 7.0), (3, 4.0), (6, 1.0)] {
        // Each mover within reach weighs a cone of 0.99 to 1, near or far. Still taps weigh nothing
        // on a still pixel, and its own weight is 1 / 0.5.
        let actual = output.at(EDGE + beside, HEIGHT / 2)[0];
        assert_near(actual, movers / (movers + 2.0), 0.005);
    }
}

#[test]
fn clamping_before_halving_halves_the_reach() {
    let mut picture = steady(|x| if x < EDGE { 1.0 } else { 0.0 });
    picture.velocity = picture.velocity.map(|_| [200.0, 0.0]);
    let reach = |changes: &str| {
        let output = motion_blur_demo(&picture, changes);
        let lit = |x: &u32| (0..HEIGHT).any(|y| output.at(*x, y)[0] > 0.0);
        (EDGE..WIDTH - 25).filter(lit).count()
    };
    // Half a tile of 20, and the pixel that a bilinear tap touches; shifts of a whole step reach
    // it.
    let published = reach("");
    assert!((9..=11).contains(&published), "{published}");
    let repaired = reach("radius_range=half_pixel_to_tile");
    assert!((19..=21).contains(&repaired), "{repaired}");
}

#[test]
fn the_centre_tap_counts_in_addition_to_the_pixel() {
    // 15 or 14 taps of two cones and two cylinders, 4 each within 1 %, and the pixel of 1/8.
    let kept = tap_weights("jitter=none")(0);
    assert_near(kept, 4.125 / 60.125, 1e-3);
    let skipped = tap_weights("jitter=none center_tap=skipped")(0);
    assert_near(skipped, 0.125 / 56.125, 1e-3);
}

/// Measures how far noise displaces the picture at each pixel, in pixels.
fn measure_displacements(changes: &str) -> Vec<f32> {
    let output = motion_blur_demo(&steady(|x| x as f32), changes);
    let inner = (12..WIDTH - 12).flat_map(|x| (0..HEIGHT).map(move |y| (x, y)));
    inner.map(|(x, y)| output.at(x, y)[0] - x as f32).collect()
}

fn deviation(values: &[f32]) -> f32 {
    (values.iter().map(|value| value * value).sum::<f32>() / values.len() as f32).sqrt()
}

#[test]
fn a_jitter_of_a_whole_step_displaces_twice_as_far() {
    let deviation = |changes: &str| deviation(&measure_displacements(changes));
    let published = deviation("noise=gradient");
    let repaired = deviation("noise=gradient jitter=half_step");
    // The same noise, doubled; weights differ by 1 %.
    assert_near(published / repaired, 2.0, 0.05);
    // An even shift within one step of 8 / 8 pixels either way.
    assert_near(published, 1.0 / 3.0f32.sqrt(), 0.03);
}

#[test]
fn filtering_between_tiles_leaves_moving_pixels_unblurred() {
    let [right, left] = [SPEED, -SPEED].map(|speed| white(speed).at(5.0));
    let picture = Picture::halves(120, 20, right, left).speckled(1, |_, _| true);
    let unblurred = |changes: &str| {
        let output = motion_blur_demo(&picture, changes);
        let column = |x: &u32| (0..20).all(|y| output.at(*x, y) == picture.color.at(*x, y));
        (0..120).filter(column).collect::<Vec<u32>>()
    };
    // Two tiles of opposite motion: halfway between their middles at 70 and 90 their mix is less
    // than half a pixel.
    assert_eq!(unblurred(""), [79, 80]);
    assert!(unblurred("tile_lookup=own").is_empty());
}

#[test]
fn motion_only_in_the_last_partial_tile_is_not_blurred() {
    let speed = |x: u32| if x < 45 { 0.0 } else { SPEED };
    let picture = Picture::new(59, 40, |x, _| white(speed(x)).at(5.0)).speckled(2, |_, _| true);
    assert!(motion_blur_demo(&picture, "") == picture.color);
    assert!(motion_blur_demo(&picture, "tile_lookup=own") != picture.color);
}

#[test]
fn the_hash_is_not_uniform() {
    // Displacements beyond half the largest, of 1 pixel.
    let far = |changes: &str| {
        let displacements = measure_displacements(changes);
        let far = displacements.iter().filter(|value| value.abs() > 0.5);
        far.count() as f64 / displacements.len() as f64
    };
    // 2263 pixels: 3 sigma are 0.03. Even noise exceeds it in half of the pixels; the fraction of a
    // sine does in 1 + (asin 1/4 - asin 3/4) / (pi / 2) = 0.62.
    assert_near(far("noise=gradient"), 0.5, 0.03);
    assert_near(far(""), 0.621, 0.03);
}

#[test]
fn front_and_back_are_swapped() {
    // Light on the still surface, four pixels from the edge, which three taps of the mover reach.
    let light = |mover: f32, still: f32, changes: &str| {
        let changes = format!("jitter=none center_tap=skipped {changes}");
        motion_blur_demo(&mover_beside_still(mover, still), &changes).at(EDGE + 4, HEIGHT / 2)[0]
    };
    // Depth buffers of 0.5 and 0.9: a mover in front weighs 1 - 0.4 / 0.5, one behind 1.
    assert_near(light(0.2, 1.0, ""), 0.6 / 2.6, 0.005);
    assert_near(light(1.0, 0.2, ""), 3.0 / 5.0, 0.005);
    // From 5 m on, everything is within a hundredth of the far plane, and depth hardly matters.
    let (in_front, behind) = (light(5.0, 20.0, ""), light(20.0, 5.0, ""));
    assert!(in_front < behind, "{in_front} {behind}");
    assert_near(in_front, behind, 0.01);
    let linear: &str = "depth_compare=linear";
    assert_eq!(light(20.0, 5.0, linear), 0.0);
    assert!(light(5.0, 20.0, linear) > 0.59);
}

#[test]
fn colour_comes_from_the_opposite_border() {
    let picture = steady(|x| if x == WIDTH - 1 { 1.0 } else { 0.0 });
    let left = |changes: &str| motion_blur_demo(&picture, changes).at(0, HEIGHT / 2)[0];
    assert!(left("") > 0.01);
    assert_eq!(left("fetch=nearest"), 0.0);
}

#[test]
fn guertin_s_rule_for_diagonal_tiles_misses_motion_away_from_the_tile() {
    // A white mover at the corner of four tiles moves up and left; its centred smear reaches 15
    // pixels down and right, too.
    let picture = Picture::new(40, 40, |x, y| match (x, y) {
        (12..20, 12..20) => white(0.0).moving(-30.0, -30.0),
        _ => BLACK_WALL.at(9.0),
    });
    let light = |rule: &str| {
        let changes = format!("tile_size=20 tile_blend=0 neighbor_rule={rule}");
        let output = picture.blur("guertin", "paper", &changes);
        let diagonal = (20..40).flat_map(|y| (20..40).map(move |x| (x, y)));
        diagonal.map(|(x, y)| output.at(x, y)[0]).sum::<f32>()
    };
    assert_eq!(light("toward"), 0.0);
    assert!(light("either_way") > 3.0, "{}", light("either_way"));
    assert_eq!(light("either_way"), light("all"));
}
