//! The tiles of Unity HDRP.

use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, column, white};

#[test]
fn plain_tiles_forget_depth_where_motions_are_alike() {
    // A white surface in front moves 8 pixels, and the background 24: the smallest motion in their
    // tiles is over a quarter.
    let picture = Picture::halves(160, 64, BLACK_WALL.moving(24.0, 0.0), white(8.0));
    let seen = |plain: &str| {
        let overrides = format!("plain_tiles={plain} mirror=off");
        column(&picture.blur("jimenez", "hdrp", &overrides), 72)
    };
    // The surface smears 4 pixels to each side. A distance of 8 is more than a step of 3 beyond its
    // smear.
    assert_within(seen("never"), ..0.01);
    // A box of 24 pixels, with 4.5 of them in it.
    assert_near(seen("similar"), 4.5 / 24.0, 0.03);
}

#[test]
fn neighbouring_tiles_cut_long_smears_and_tiles_along_the_motion_do_not() {
    // Half of 160 pixels to each side. Unity HDRP cuts twice that at 200, in parts of the picture's
    // diagonal.
    let picture = Picture::halves(320, 64, BLACK_WALL, white(160.0));
    let reach = |preset: &str| {
        let output = picture.blur("jimenez", preset, "tile_dither=0");
        (0..160).filter(|x| column(&output, *x) > 0.0).count()
    };
    // The smear ends after one tile of 20 pixels next to the mover's.
    assert_eq!(reach("slides_2014"), 20);
    // A quarter of 200 pixels, less a fiftieth for the diagonal.
    assert!((47..=50).contains(&reach("hdrp")), "{}", reach("hdrp"));
}

/// Returns the tiles of 16 pixels that get the velocity of one moving pixel in tile (10, 4).
fn tiles_told_of(speed: f32) -> Vec<(u32, u32)> {
    let picture = Picture::new(320, 160, |x, y| match (x, y) {
        (160, 72) => white(speed),
        _ => BLACK_WALL,
    });
    let overrides = "tile_size=16 tile_reach=9 dilation=walk";
    let tiles = picture.texture("jimenez", overrides, "near_motion");
    let places = (0..10).flat_map(|y| (0..20).map(move |x| (x, y)));
    let is_told = |x: u32, y: u32| tiles.at(x, y)[..2] != [0.0, 0.0];
    places.filter(|(x, y)| is_told(*x, *y)).collect()
}

#[test]
fn unity_s_walk_over_tiles_misses_the_left_one() {
    // Half of 100 pixels is a little over three tiles. By the integers of Cohen 1994 the walk goes
    // from (9, 3) 5 to the right and 1 down, and 2 to the left and 1 down.
    let above = [8, 10, 11].map(|x| (x, 3));
    let beside = [7, 8, 10, 11, 12, 13, 14].map(|x| (x, 4));
    assert_eq!(tiles_told_of(100.0), [&above[..], &beside[..]].concat());
    // Motion of up to half a pixel stays in its tile.
    assert_eq!(tiles_told_of(0.5), [(10, 4)]);
}

#[test]
fn the_last_tiles_of_unity_know_only_the_pixel_in_their_corner() {
    let told = |x: u32, last_tiles: &str| {
        let picture = Picture::new(160, 96, |column, row| match (column, row) {
            (at, 40) if at == x => white(24.0),
            _ => BLACK_WALL,
        });
        let overrides = format!("tile_size=16 last_tiles={last_tiles}");
        let tiles = picture.texture("jimenez", &overrides, "tile_motion");
        tiles.at(x / 16, 2)[0] > 0.0
    };
    assert!(told(150, "whole") && !told(150, "corner"));
    assert!(told(140, "whole") && told(140, "corner"));
}
