//! The reference `scatter_oracle`, which is right wherever one frame with straight motion
//! determines the result.

use frame::{Efficiency, Frame, Image, Picture, Raster, Shutter, ShutterProfile, Vectors};
use metrics::scatter_oracle;
use tests::synthetic::{Object, Scene, Shape};

fn scene(objects: Vec<Object>) -> Scene {
    crate::scene([48, 24], objects)
}

/// Makes a frame of one bright block of columns at depth 2 in front of black, moving right by whole
/// pixels per frame.
fn block(columns: std::ops::Range<u32>, speed: f32) -> Frame {
    let inside = |x: u32| columns.contains(&x);
    let mut frame = scene(Vec::new()).frame();
    frame.exposure = 1.0;
    frame.color = Raster::from_fn(48, 24, |x, _| [if inside(x) { 1.0 } else { 0.0 }; 3]);
    frame.velocity = Raster::from_fn(48, 24, |x, _| [if inside(x) { speed } else { 0.0 }, 0.0]);
    frame.depth = Raster::from_fn(48, 24, |x, _| if inside(x) { 2.0 } else { 9.0 });
    frame.coverage = vec![frame.color.map(|color| color[0])];
    frame
}

fn trailing() -> Shutter {
    Shutter::new(-1.0, 0.0).unwrap()
}

fn oracle(frame: &Frame, shutter: Shutter) -> Picture {
    scatter_oracle(frame, shutter, &ShutterProfile::default())
}

#[track_caller]
fn assert_row(image: &Image, row: u32, expected: impl Fn(u32) -> f64, tolerance: f64) {
    for x in 0..image.width {
        let actual = f64::from(image.at(x, row)[0]);
        crate::assert_near(&format!("column {x}"), actual, expected(x), tolerance);
    }
}

#[test]
fn a_still_frame_comes_out_unchanged() {
    let still = Object::sliding(Shape::Disc(6.0), [20.0, 11.0], [0.0, 0.0]);
    let frame = scene(vec![still]).frame();
    let picture = oracle(&frame, trailing());
    assert_eq!(picture.color, frame.color);
    assert_eq!(picture.coverage, frame.coverage);
}

#[test]
fn a_mover_leaves_ramps_and_shows_its_background() {
    // The block is from 20 to 30 and moves 8 pixels per frame. Over the shutter it covers column x
    // while -8 t is between the distances of x from its ends.
    let frame = block(20..30, 8.0);
    let ramp = |x: u32, from: f64| ((f64::from(x) + 0.5 - from) / 8.0).clamp(0.0, 1.0);
    for (shutter, shift) in [(trailing(), -8.0), (Shutter::new(0.0, 1.0).unwrap(), 0.0)] {
        let picture = oracle(&frame, shutter);
        let expected = |x: u32| ramp(x, 20.0 + shift) - ramp(x, 30.0 + shift);
        // 64 instants over 8 pixels: a pixel in the middle of its step is right to one of them.
        assert_row(&picture.color, 12, expected, 1.0 / 64.0);
        let matte = picture.coverage[0].map(|part| [*part; 3]);
        assert_row(&matte, 12, expected, 1.0 / 64.0);
    }
}

#[test]
fn near_surfaces_hide_far_ones_and_holes_show_the_background() {
    // Dark green is ahead of the block. Blue is the background, and right of it a green wall is
    // farther away than the block.
    let mut frame = block(20..30, 8.0);
    for y in 0..24 {
        for x in 0..48 {
            let at = (y * 48 + x) as usize;
            if (13..17).contains(&x) {
                frame.color.pixels[at] = [0.0, 0.5, 0.0];
                frame.depth.pixels[at] = 1.0;
            } else if x < 20 {
                frame.color.pixels[at] = [0.0, 0.0, 1.0];
            } else if x >= 30 {
                frame.color.pixels[at] = [0.0, 1.0, 0.0];
                frame.depth.pixels[at] = 5.0;
            }
        }
    }
    let picture = oracle(&frame, trailing());
    for x in 13..17 {
        // Hidden behind a nearer surface.
        assert_eq!(picture.color.at(x, 12), &[0.0, 0.5, 0.0]);
    }
    // For most of the shutter the block was not yet at its right end: of the block and the wall,
    // the wall is farther.
    let [red, green, blue] = *picture.color.at(29, 12);
    assert_eq!(blue, red, "the white block alone brings blue");
    assert!((0.0..0.1).contains(&red), "{red}");
    crate::assert_near("green", green.into(), 1.0, 1e-6);
}

#[test]
fn a_gradual_shutter_weights_instants_and_a_rolling_one_shifts_them() {
    let frame = block(20..30, 8.0);
    // Efficiency rises from 0.6 to 0.8 of the interval and stays: areas 0.1 and 0.2, on the last
    // 3.2 pixels of the path. Column 19 is covered until half a pixel before the end, at 0.9375.
    let profile = ShutterProfile {
        efficiency: Efficiency::Table(vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0]),
        ..ShutterProfile::default()
    };
    let late = scatter_oracle(&frame, trailing(), &profile);
    assert_eq!(late.color.at(15, 12)[0], 0.0);
    let covered = late.color.at(19, 12)[0];
    // 64 instants.
    assert!((covered - (0.1 + 0.1375) / 0.3).abs() < 0.03, "{covered}");
    let rolling = ShutterProfile {
        rolling: 1.0,
        ..ShutterProfile::default()
    };
    let rolled = scatter_oracle(&frame, trailing(), &rolling);
    let start = |row: u32| (0..48).find(|x| rolled.color.at(*x, row)[0] > 0.0).unwrap();
    assert!(start(23) > start(0), "{} {}", start(23), start(0));
}

#[test]
fn a_pixel_that_every_surface_left_keeps_its_own_colour() {
    let mut frame = block(0..48, 60.0);
    frame.velocity = Vectors::filled(48, 24, [60.0, 0.0]);
    let picture = oracle(&frame, Shutter::new(0.0, 1.0).unwrap());
    assert_row(&picture.color, 3, |_| 1.0, 1e-6);
}
