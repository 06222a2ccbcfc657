//! The mirrored, depth-weighted family of Jimenez 2014.

use filters::Filter;
use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, column, light, white};

const HONEST_LENGTHS: &str = "slides_2014 hdrp hdrp_mirrored o3de kajiya";

#[test]
fn a_mover_smears_half_its_motion_over_the_background() {
    let picture = Picture::halves(160, 64, BLACK_WALL, white(24.0));
    for preset in HONEST_LENGTHS.split(' ') {
        println!("{preset}");
        let output = picture.blur("jimenez", preset, "");
        // A ramp from a half to zero over 12 pixels contains 3 pixels of light. Half a step less,
        // and half a pixel less for whole pixels, give 2.6.
        let expected = if preset == "o3de" { 2.6 } else { 3.0 };
        assert_near(light(&output, 0..80), expected, 0.4);
        assert_within(light(&output, 0..66), ..0.01);
    }
}

#[test]
fn mirrored_weights_show_background_from_the_other_side() {
    // A black mover on the right. The wall is black for 4 pixels next to it, and white beyond.
    let picture = Picture::new(160, 64, |x, _| match x {
        80.. => white(24.0).gray(0.0),
        76.. => BLACK_WALL,
        _ => BLACK_WALL.gray(1.0),
    });
    let seen = |mirror: &str| {
        let output = picture.blur("jimenez", "slides_2014", &format!("mirror={mirror}"));
        column(&output, 79)
    };
    // In all pairs the right tap reaches the mover. 8.5 of 12 pixels on the left are white, and
    // half of the taps are on the left. One tap more or less is a sixteenth.
    assert_near(seen("slow_background"), 0.5 * 8.5 / 12.0, 1.0 / 16.0);
    // A still background reaches nothing by itself, except in the half pixel of bilinear fetches.
    assert_within(seen("off"), ..0.02);
}

#[test]
fn tiles_compare_lengths_in_parts_of_the_picture() {
    // In a picture four times as wide as high, 8 pixels down are longer than 24 to the right.
    let picture = Picture::halves(256, 64, white(24.0), white(0.0).moving(0.0, 8.0));
    let longest = |by: &str| {
        let tiles = picture.texture("jimenez", &format!("longest_by={by}"), "near_motion");
        // Two tiles of 20 pixels left of the middle, a tile touches both.
        let [right, down, ..] = *tiles.at(5, 1);
        [right, down]
    };
    assert_eq!(longest("pixels"), [24.0, 0.0]);
    for by in ["screens", "last_screens", "packed_screens"] {
        assert_eq!(longest(by), [0.0, 8.0], "{by}");
    }
}

#[test]
fn a_tile_keeps_the_first_the_last_or_the_greatest_angle_of_equally_long_motions() {
    let picture = Picture::new(60, 60, |_, y| match y {
        20..25 => white(0.0).moving(6.0, -6.0),
        25..30 => white(0.0).moving(6.0, 6.0),
        30..35 => white(0.0).moving(-6.0, -6.0),
        _ => white(0.0),
    });
    // Angles count clockwise from the left.
    for (by, known) in [
        ("screens", [6.0, -6.0]),
        ("last_screens", [-6.0, -6.0]),
        ("packed_screens", [6.0, 6.0]),
    ] {
        let tiles = picture.texture("jimenez", &format!("longest_by={by}"), "tile_motion");
        assert_eq!(tiles.at(1, 1)[..2], known, "{by}");
    }
}

#[test]
fn every_preset_names_its_source_and_its_picture_width() {
    let filter = Filter::builtin("jimenez").unwrap();
    for preset in &filter.presets {
        let source = preset.source.as_ref();
        let source = source.unwrap_or_else(|| panic!("{} names no source", preset.name));
        assert!(!source.differs.is_empty(), "{}", preset.name);
        assert_eq!(preset.reference_width, Some(1920), "{}", preset.name);
        // A preset without published code bears no game's or engine's name.
        let is_code = source.code.is_some();
        assert_eq!(is_code, preset.name != "slides_2014", "{}", preset.name);
    }
}
