//! Inputs of captures that few filters read.

use std::fs;

use frame::{ExrFile, Frame, Raster, write_exr};
use tests::near::assert_near;

use super::ingest::capture::{Capture, HEIGHT, WIDTH};
use crate::exclusion::write_mask;
use crate::further_velocities::{read_outputs, write_next};
use crate::sandbox::Sandbox;

#[test]
fn a_capture_may_have_a_mask() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).with_subframes(4);
    write_mask(&sandbox);
    let ingest = "engine ingest capture --quiet -o out/engine/mine";
    let run = "run --quiet --scenes out/engine/mine --filter ./mask --input border=clamp";
    sandbox.done(ingest);
    let leaves_out = "leaves out 1 preset because the capture does not have exclusion";
    sandbox.refuse(run, &[leaves_out, "no filter is left"]);
    let write = |left: f32| {
        let mut file = ExrFile::new(WIDTH, HEIGHT);
        let mask = Raster::from_fn(WIDTH, HEIGHT, |x, _| if x < 9 { left } else { 0.0 });
        file.push_plane("R", &mask);
        write_exr(&capture.path("exclusion.exr"), &file).unwrap();
    };
    write(1.5);
    sandbox.refuse(
        ingest,
        &["capture/exclusion.exr", "1 where the blur must not"],
    );
    write(1.0);
    sandbox.done(ingest);
    sandbox.done(run);
    let cases = sandbox.read_filter_cases().into_iter();
    for case in cases.filter(|case| case.filter == "mask") {
        let output = sandbox.read_color(&format!("out/{}/output.exr", case.folder.display()));
        assert_eq!([8, 9].map(|x| output.at(x, 20)[0]), [1.0, 0.0]);
    }
    fs::remove_file(capture.path("exclusion.exr")).unwrap();
    sandbox.done(ingest);
    sandbox.refuse(run, &[leaves_out]);
}

#[test]
fn a_capture_may_have_further_velocities() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).with_subframes(4);
    let ingest = "engine ingest capture --quiet -o out/engine/mine";
    let run = "run --quiet --scenes out/engine/mine --filter ./next";
    write_next(&sandbox);
    for missing in ["velocity_next", "velocity_z"] {
        sandbox.done(ingest);
        let leaves_out = format!("leaves out 1 preset because the capture does not have {missing}");
        sandbox.refuse(run, &[&leaves_out, "no filter is left"]);
        let names = ["velocity.exr".to_owned(), format!("{missing}.exr")];
        let [from, to] = names.map(|name| capture.path(&name));
        fs::copy(from, to).unwrap();
    }
    sandbox.done(ingest);
    sandbox.done(run);
    let frame = Frame::read(&sandbox.path("out/engine/mine/frame.exr")).unwrap();
    assert_eq!(frame.velocity_next.as_ref(), Some(&frame.velocity));
    let [right, down] = *frame.velocity.at(48, 27);
    // The channel R of the copy: normalised device coordinates.
    let [x, y, z] = *read_outputs(&sandbox)[0].at(48, 27);
    assert_eq!([x, y], [right, down]);
    assert_near(z, f64::from(right) * 2.0 / 96.0, 1e-6);
}
