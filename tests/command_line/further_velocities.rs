//! The velocity to the next frame, and the velocity of depth, for filters that read them.

use std::fs;

use frame::{Frame, Image};
use tests::near::assert_near;

use crate::sandbox::Sandbox;

/// Writes a filter that shows both.
pub fn write_next(sandbox: &Sandbox) {
    let shows = "let z = textureLoad(velocity_z, pixel, 0).x;
        textureStore(output, pixel, vec4<f32>(textureLoad(velocity_next, pixel, 0).xy, z, 1.0));";
    sandbox.write_kernel("next", "", &["velocity_next", "velocity_z"], shows);
}

/// Reads what the filter showed of the only scene, in each form of its input.
pub fn read_outputs(sandbox: &Sandbox) -> Vec<Image> {
    let cases = sandbox.read_filter_cases().into_iter();
    (cases.filter(|case| case.filter == "next"))
        .map(|case| sandbox.read_color(&format!("out/{}/output.exr", case.folder.display())))
        .collect()
}

#[test]
fn run_hands_them_to_filters_that_read_them_and_leaves_the_frame_s_file_as_it_is() {
    let sandbox = Sandbox::measured();
    let path = sandbox.path("out/plate/frame.exr");
    let before = fs::read(&path).unwrap();
    let frame = Frame::read(&path).unwrap();
    write_next(&sandbox);
    let forms = "msaa=nearest --input jitter=resolved --input scale=50_upscale_first --input buffers=half --input border=clamp";
    sandbox.measure(&format!(
        "--filters ./next --jitter-frames 0 --input {forms}"
    ));
    assert!(fs::read(&path).unwrap() == before, "frame.exr has changed");
    let [right, _] = *frame.velocity.at(32, 16);
    assert!(right > 9.0, "the plate moves");
    let outputs = read_outputs(&sandbox);
    assert_eq!(outputs.len(), 6, "the full frame, and five forms");
    for output in &outputs {
        // Small pixels are twice as large, and 32-bit floats have seven digits.
        for (actual, due) in output.at(32, 16).iter().zip([right, 0.0, 0.0]) {
            assert_near(*actual, f64::from(due), 1e-4);
        }
    }
    let blur = "engine blur --filter ./next -o next.exr --frame";
    sandbox.refuse(
        &format!("{blur} out/plate/frame.exr"),
        &["out/plate/frame.exr: the frame has no velocity_next"],
    );
    let quick = "--quiet --scenes plate --size 64x32 --samples-per-pixel 16 --further-velocities";
    sandbox.done(&format!("truths render {quick} --out more"));
    sandbox.done(&format!(
        "{blur} more/plate/frame.exr --show velocity_next,velocity_z"
    ));
    assert!(sandbox.read_color("next.exr") == outputs[0]);
    let whole = Frame::read(&sandbox.path("more/plate/frame.exr")).unwrap();
    assert_eq!(whole.provenance, frame.provenance);
    assert_eq!(whole.color, frame.color);
}
