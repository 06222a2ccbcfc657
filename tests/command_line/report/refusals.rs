//! Runs that no page can be made of.

use std::fs;

use super::WORDS;
use crate::bench::{Bench, assert_done, assert_refused};

#[test]
fn what_is_no_run_or_lacks_its_pictures_is_refused() {
    let bench = Bench::new();
    fs::create_dir(bench.path("out")).unwrap();
    let refused = |parts: &[&str]| {
        assert_refused(&bench.shuttertruth(&WORDS), 2, parts);
        assert!(!bench.path("page").exists());
    };
    refused(&["out/run.json", "read"]);
    fs::write(bench.path("out/run.json"), "{}").unwrap();
    refused(&["out/run.json: no run of this program", "`shuttertruth run`"]);
    assert_done(&bench.run(&["--filters", "identity"]));
    let picture = bench.path("out/plate/identity_default/output.exr");
    let other = bench.path("out/other.exr");
    fs::copy(&picture, &other).unwrap();
    fs::write(&picture, "no picture").unwrap();
    refused(&["out/plate/identity_default/output.exr"]);
    fs::remove_file(&picture).unwrap();
    refused(&["out/plate/identity_default/output.exr", "read"]);
    let mut small = frame::ExrFile::new(16, 16);
    small.push_color("", &frame::Raster::filled(16, 16, [0.0; 3]));
    frame::write_exr(&picture, &small).unwrap();
    refused(&[
        "out/plate/identity_default: output.exr has 16x16 pixels, errors.exr 64x32, the scene's frame 64x32",
        "run the case again",
    ]);
    fs::rename(&other, &picture).unwrap();

    let text = fs::read_to_string(bench.path("out/run.json")).unwrap();
    let mut run: serde_json::Value = serde_json::from_str(&text).unwrap();
    fs::remove_file(bench.path("out/judgement.json")).unwrap();
    run["cases"] = serde_json::json!([]);
    fs::write(bench.path("out/run.json"), run.to_string()).unwrap();
    refused(&["the run has no cases"]);
}
