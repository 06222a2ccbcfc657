//! Pictures that do not belong together.

use frame::{Frame, Picture, Raster, Truth};
use metrics::{Viewing, measure};
use tests::synthetic::VIEWING;

use super::{BESIDE, small_scene};
use crate::clean_truth;

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
