//! Pictures that do not belong together.

use frame::{Frame, Picture, Raster};
use metrics::{MeasureError, Viewing, measure};
use tests::synthetic::VIEWING;

use super::{BESIDE, small_scene};
use crate::clean_truth;

#[test]
fn invalid_and_mismatched_pictures_are_refused_by_name() {
    let scene = small_scene(BESIDE);
    let (frame, truth) = (scene.frame(), clean_truth(&scene));
    let output = truth.mean();
    let refuse = |output: &Picture, frame: &Frame, viewing: &Viewing| -> String {
        let error: MeasureError =
            measure(output, frame, &truth, None, viewing).expect_err("a wrong input");
        error.to_string()
    };

    let mut broken = output.clone();
    broken.color.pixels[3 * 80 + 7][1] = f32::NAN;
    let text = refuse(&broken, &frame, &VIEWING);
    assert!(
        text.contains("the colour of the output holds NaN at pixel (7, 3)"),
        "{text}"
    );

    let mut broken = output.clone();
    broken.coverage[2].pixels[0] = f32::INFINITY;
    let text = refuse(&broken, &frame, &VIEWING);
    assert!(
        text.contains("the matte of object2 in the output holds inf"),
        "{text}"
    );

    let mut broken = output.clone();
    broken.coverage.pop();
    let text = refuse(&broken, &frame, &VIEWING);
    assert!(
        text.contains("the output has 2 mattes, the truth has 3 objects"),
        "{text}"
    );

    let mut broken = output.clone();
    broken.color = Raster::filled(81, 60, [0.0; 3]);
    let text = refuse(&broken, &frame, &VIEWING);
    assert!(
        text.contains("the output is 81x60, the truth is 80x60"),
        "{text}"
    );

    let mut other = frame.clone();
    other.exposure = 1.0;
    let text = refuse(&output, &other, &VIEWING);
    assert!(
        text.contains("the frame's exposure has 1.0, the truth has 0.5"),
        "{text}"
    );

    let mut huge = truth.clone();
    huge.motion = Raster::filled(7680, 4320, 0.0);
    let text = measure(&output, &frame, &huge, None, &VIEWING)
        .expect_err("more than FLIP takes")
        .to_string();
    assert!(
        text.contains("7680x4320; at most 28000000 pixels"),
        "{text}"
    );

    let viewing = Viewing {
        flip_count: 1,
        ..VIEWING
    };
    let text = refuse(&output, &frame, &viewing);
    assert!(text.contains("in 1 steps; allowed"), "{text}");
}
