//! Pictures that do not belong together.

use frame::{Frame, Picture, Raster, Truth};
use metrics::{Viewing, measure};
use tests::synthetic::VIEWING;

use super::{BESIDE, small_scene};
use crate::clean_truth;

/// A mistake in the input.
type Change = fn(&mut Given);

/// Input of a measurement.
#[derive(Clone)]
struct Given {
    output: Picture,
    frame: Frame,
    truth: Truth,
    viewing: Viewing,
}

#[test]
fn invalid_and_mismatched_pictures_are_refused_by_name() {
    let scene = small_scene(BESIDE);
    let truth = clean_truth(&scene);
    let right = Given {
        output: truth.mean(),
        frame: scene.frame(),
        truth,
        viewing: VIEWING,
    };
    let rows: [(Change, &str); 7] = [
        (
            |it| it.output.color.pixels[3 * 80 + 7][1] = f32::NAN,
            "the colour of the output holds NaN at pixel (7, 3)",
        ),
        (
            |it| it.output.coverage[2].pixels[0] = f32::INFINITY,
            "the matte of object2 in the output holds inf",
        ),
        (
            |it| it.output.coverage.truncate(2),
            "the output has 2 mattes, the truth has 3 objects",
        ),
        (
            |it| it.output.color = Raster::filled(81, 60, [0.0; 3]),
            "the output is 81x60, the truth is 80x60",
        ),
        (
            |it| it.frame.exposure = 1.0,
            "the frame's exposure has 1.0, the truth has 0.5",
        ),
        (
            |it| it.truth.motion = Raster::filled(7680, 4320, 0.0),
            "7680x4320; at most 28000000 pixels",
        ),
        (|it| it.viewing.flip_count = 1, "in 1 steps; allowed"),
    ];
    for (change, words) in rows {
        let mut given = right.clone();
        change(&mut given);
        let Given {
            output,
            frame,
            truth,
            viewing,
        } = &given;
        let error = measure(output, frame, truth, None, viewing).expect_err(words);
        assert!(error.to_string().contains(words), "{error}");
    }
}
