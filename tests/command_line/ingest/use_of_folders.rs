//! Allowed and refused uses of an ingested folder.

use std::fs;

use tests::text::{assert_contains, read_rows};

use super::capture::{Capture, DESCRIPTION};
use super::ingest;
use crate::sandbox::{Sandbox, split, stderr};

#[test]
fn a_capture_without_sub_frames_has_no_truth_to_run_against() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox);
    let told = ingest(&sandbox);
    assert!(told.contains("no sub-frames, and so no truth"), "{told}");
    let words = "run --scenes out/engine/mine";
    sandbox.refuse(words, &["drew no sub-frames", "score"]);
}

#[test]
fn what_an_engine_drew_is_not_rendered_otherwise() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(4);
    ingest(&sandbox);
    for (words, parts) in read_rows(
        "
        run --scenes MINE --size 64x32 => was drawn at 96x54 | at its own size
        run --scenes MINE --exposure 1 => --exposure | as Test Engine 1.2 drew it
        run --scenes MINE --guard-band 8 => --guard-band | leave the option out
        run --scenes MINE,./MINE => is named twice | rename
        run --scenes MINE --filter mcguire => no filter is left | trailing shutter
        run --scenes MINE --input defect=half,lag => defect=lag: needs the scene's own motion | zero, double, half, flip_y, jittered
        truths render --scenes MINE => holds what an engine drew | `run` and `check`
        limits calibrate --scenes MINE => does not change from run to run | bounds.toml",
    ) {
        let words = words.replace("MINE", "out/engine/mine");
        let output = sandbox.shuttertruth(&split(&words));
        // Notes about omitted filters may come before the refusal.
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert_contains(&message, &parts);
    }
    let begun = sandbox.path("out/mine@Test_Engine_1.2");
    assert!(!begun.exists(), "a run began before it was refused");
}

#[test]
fn files_of_two_captures_are_not_mixed() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).with_subframes(4);
    ingest(&sandbox);
    // Renaming the scene makes no other capture; changing the exposure does.
    capture.write("capture.toml", &DESCRIPTION.replace("0.5", "0.25"));
    sandbox.done("engine ingest capture --quiet -o out/engine/other");
    let words = "run --quiet --scenes out/engine/mine --filter identity";
    for name in ["frame.exr", "truth_trailing.exr"] {
        let [own, other] =
            ["mine", "other"].map(|it| sandbox.path("out/engine").join(it).join(name));
        let before = fs::read(&own).unwrap();
        fs::copy(other, &own).unwrap();
        let parts = [name, "is of another capture", "ingest the capture again"];
        sandbox.refuse(words, &parts);
        fs::write(&own, before).unwrap();
    }
    sandbox.done(words);
    sandbox.put("out/engine/mine/ingested.json", "{}");
    let parts = ["ingested.json: no ingested capture", "make the folder anew"];
    sandbox.refuse(words, &parts);
}

#[test]
fn frames_of_a_run_are_not_overwritten() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox);
    sandbox.done("truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16");
    let parts = "out/plate: holds | a frame that was not ingested | new folder";
    sandbox.refuse("engine ingest capture -o out/plate", &parts);
    let parts = ["holds a scene"];
    sandbox.refuse("engine ingest capture -o scenes/plate", &parts);
}
