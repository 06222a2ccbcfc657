//! Golan's add-on for Godot, and the engine's proposal after it.

use frame::Image;
use tests::near::{assert_near, assert_within};
use tests::picture::{BLACK_WALL, Picture, light_above, slow_above_fast, white};

#[test]
fn the_proposal_smears_what_is_slower_than_its_neighbours_twice_as_far() {
    // Half of 24 pixels are 12.
    let picture = slow_above_fast(24.0, 38.0);
    let [engine, addon] = ["engine", "addon"].map(|preset| {
        let output = picture.blur("godot", preset, "");
        [0..11, 13..19].map(|distances| light_above(&output, distances))
    });
    assert_within(engine[1], 3.0..);
    assert_eq!(addon[1], 0.0);
    assert_within(addon[0], 3.0..);
}

#[test]
fn slow_taps_of_the_add_on_weigh_more_but_not_enough() {
    let light = |changes: &str| {
        let output = slow_above_fast(24.0, 60.0).blur("godot", "addon", changes);
        light_above(&output, 0..12)
    };
    let [plain, raised] = ["slow_taps=plain", ""].map(light);
    // 24 of 60 pixels, and the square root.
    assert_near(raised / plain, (60.0_f32 / 24.0).sqrt(), 0.1);
}

#[test]
fn tiles_of_the_add_on_lose_parts_of_a_pixel() {
    for (speed, held) in [(0.9, 0.0), (10.9, -10.0)] {
        let picture = Picture::uniform(64, 64, white(speed));
        let tiles = picture.texture("godot", "storage=exact", "tile_max");
        assert_eq!(tiles.at(1, 1)[0], held);
        let tiles = picture.texture("godot", "storage=exact tile_motion=exact", "tile_max");
        assert_eq!(tiles.at(1, 1)[0], -speed);
    }
}

#[test]
fn below_the_last_tile_the_add_on_reads_a_row_of_pixels() {
    // Rows 2 and 3 stand still, as all above the mover.
    let picture = Picture::new(128, 64, |x, y| match (x, y) {
        (64.., 32..) => white(24.0),
        _ => BLACK_WALL,
    });
    let light = |output: &Image| -> f32 {
        let pixels = (56..64).flat_map(|y| (54..64).map(move |x| (x, y)));
        pixels.map(|(x, y)| output.at(x, y)[0]).sum()
    };
    let [overrun, kept] = ["overrun", "kept"]
        .map(|lookup| light(&picture.blur("godot", "addon", &format!("tile_lookup={lookup}"))));
    assert_within(kept, 10.0..);
    assert_within(overrun / kept, 0.3..0.9);
}
