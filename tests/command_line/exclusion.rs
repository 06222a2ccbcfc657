//! The mask of what a blur leaves alone, for filters that read it.

use frame::{Frame, Image, read_exr};
use tests::root;

use crate::sandbox::{SCENE, Sandbox};

/// Two plates that follow the camera, the second one as a part of the first.
const HELD: &str = "
[object.held]
mesh = \"plate.obj\"
parent = \"camera\"
translation = [0, -0.6, -2]

[object.dial]
mesh = \"plate.obj\"
parent = \"held\"
translation = [0, 0.4, 0.2]
scale = 0.3
";

/// Makes the camera move along with the plate, more slowly.
fn add_held(sandbox: &Sandbox) {
    let still = "position = [0, 0, 4]\nlook_at = [0, 0, 0]";
    let keys = "keys = [{ time = -1, position = [-0.4, 0, 4], look_at = [-0.4, 0, 0] }, \
                { time = 0, position = [0, 0, 4], look_at = [0, 0, 0] }]";
    sandbox.write("scene.toml", &(SCENE.replace(still, keys) + HELD));
}

/// Writes a filter that shows the mask.
pub fn write_mask(sandbox: &Sandbox) {
    let shows = "textureStore(output, pixel, vec4<f32>(textureLoad(exclusion, pixel, 0).x));";
    sandbox.write_kernel("mask", "", &["exclusion"], shows);
}

/// Marks the objects that are attached to the camera.
fn marked(frame: &Frame) -> Image {
    assert_eq!(frame.objects, ["background", "plate", "held", "dial"]);
    assert!((0..4).all(|id| frame.object_id.pixels.contains(&id)));
    (frame.object_id).map(|id| [f32::from(*id >= 2); 3])
}

#[test]
fn a_mask_of_what_is_attached_to_the_camera_is_made_for_filters_that_read_it() {
    let sandbox = Sandbox::new();
    add_held(&sandbox);
    write_mask(&sandbox);
    let forms = "--input scale=50_upscale_first --input msaa=nearest --input border=clamp";
    sandbox.measure(&format!("--filters ./mask --jitter-frames 0 {forms}"));
    let path = sandbox.path("out/plate/frame.exr");
    let frame = Frame::read(&path).unwrap();
    let cases = sandbox.read_filter_cases().into_iter();
    let outputs: Vec<Image> = cases
        .map(|case| sandbox.read_color(&format!("out/{}/output.exr", case.folder.display())))
        .collect();
    assert_eq!(outputs.len(), 4, "the full frame, and three forms");
    assert!(outputs[0] == marked(&frame) && outputs[3] == outputs[0]);
    let count = |image: &Image| image.pixels.iter().filter(|pixel| pixel[0] > 0.5).count();
    let [full, small] = [0, 1].map(|at| count(&outputs[at]) as f64);
    assert!((small / full - 1.0).abs() < 0.2, "{small} {full}");

    assert!(!read_exr(&path).unwrap().has_channel("exclusion"));
    let blur = "engine blur --filter ./mask -o mask.exr --frame";
    let says = "out/plate/frame.exr: the frame has no exclusion, which this filter reads";
    sandbox.refuse(&format!("{blur} out/plate/frame.exr"), &[says]);
    let quick = "--quiet --scenes plate --size 64x32 --samples-per-pixel 16 --further-velocities";
    sandbox.done(&format!("truths render {quick} --out more"));
    sandbox.done(&format!("{blur} more/plate/frame.exr --show exclusion"));
    assert!(sandbox.read_color("mask.exr") == outputs[0]);
}

#[test]
fn the_example_leaves_excluded_pixels_alone() {
    let sandbox = Sandbox::new();
    add_held(&sandbox);
    let example = root().join("examples/excluded_gather");
    sandbox.measure(&format!(
        "--filters {} --velocity camera_only",
        example.display()
    ));
    let frame = Frame::read(&sandbox.path("out/plate/frame.exr")).unwrap();
    let mask = marked(&frame);
    let changes = ["without", "with"].map(|preset| {
        let name = format!("out/plate/excluded_gather_{preset}_mask/output.exr");
        let output = sandbox.read_color(&name);
        let changed = output.zip(&frame.color, |blurred, frame| blurred != frame);
        let pairs = changed.pixels.iter().zip(&mask.pixels);
        pairs
            .filter(|(changed, mark)| **changed && mark[0] == 1.0)
            .count()
    });
    assert!(changes[0] > 10 && changes[1] == 0, "{changes:?}");
}
