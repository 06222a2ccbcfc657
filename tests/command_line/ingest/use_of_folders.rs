//! What may be done with an ingested folder, and what is refused.

use std::fs;
use std::process::Output;

use super::capture::{Capture, DESCRIPTION};
use super::ingest;
use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stderr};

#[test]
fn a_capture_without_sub_frames_has_no_truth_to_run_against() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox);
    let told = ingest(&sandbox);
    assert!(told.contains("no sub-frames, and so no truth"), "{told}");
    let refusal = sandbox.shuttertruth(&split("run --scenes out/engine/mine"));
    assert_refused(&refusal, 2, &["drew no sub-frames", "score"]);
}

#[test]
fn what_an_engine_drew_is_not_rendered_otherwise() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(4);
    ingest(&sandbox);
    for (words, parts) in [
        (
            "run --scenes out/engine/mine --size 64x32",
            ["was drawn at 96x54", "at its own size"],
        ),
        (
            "run --scenes out/engine/mine --exposure 1",
            ["--exposure", "as Test Engine 1.2 drew it"],
        ),
        (
            "run --scenes out/engine/mine --guard-band 8",
            ["--guard-band", "leave the option out"],
        ),
        (
            "run --scenes out/engine/mine,./out/engine/mine",
            ["is named twice", "rename"],
        ),
        (
            "run --scenes out/engine/mine --filter mcguire",
            ["no filter is left", "trailing shutter"],
        ),
        (
            "run --scenes out/engine/mine --input defect=half,lag",
            [
                "defect=lag: needs the scene's own motion",
                "zero, double, half, flip_y, jittered",
            ],
        ),
        (
            "truths render --scenes out/engine/mine",
            ["holds what an engine drew", "`run` and `check`"],
        ),
        (
            "limits calibrate --scenes out/engine/mine",
            ["does not change from run to run", "bounds.toml"],
        ),
    ] {
        assert_refused_after_notes(&sandbox.shuttertruth(&split(words)), &parts);
    }
    let begun = sandbox.path("out/mine@Test_Engine_1.2");
    assert!(!begun.exists(), "a run began before it was refused");
}

/// Notes about filters that are left out may stand before the refusal.
fn assert_refused_after_notes(output: &Output, parts: &[&str]) {
    let message = stderr(output);
    assert_eq!(output.status.code(), Some(2), "{message}");
    tests::text::assert_contains(&message, parts);
}

#[test]
fn files_of_two_captures_are_not_mixed() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(4);
    ingest(&sandbox);
    for name in ["frame.exr", "truth_trailing.exr"] {
        let own = sandbox.path("out/engine/mine").join(name);
        let before = fs::read(&own).unwrap();
        // Another name of the scene is no other capture, another exposure is one.
        let changed = DESCRIPTION.replace("0.5", "0.25");
        fs::write(sandbox.path("capture/capture.toml"), changed).unwrap();
        sandbox.execute(&split("engine ingest capture --quiet -o out/engine/other"));
        fs::copy(sandbox.path("out/engine/other").join(name), &own).unwrap();
        let words = split("run --quiet --scenes out/engine/mine --filter identity");
        let refusal = sandbox.shuttertruth(&words);
        assert_refused(
            &refusal,
            2,
            &[name, "is of another capture", "ingest the capture again"],
        );
        fs::write(&own, before).unwrap();
    }
    let words = split("run --quiet --scenes out/engine/mine --filter identity");
    assert_done(&sandbox.shuttertruth(&words));
    fs::write(sandbox.path("out/engine/mine/ingested.json"), "{}").unwrap();
    let refusal = sandbox.shuttertruth(&words);
    assert_refused(
        &refusal,
        2,
        &["ingested.json: no ingested capture", "make the folder anew"],
    );
}

#[test]
fn frames_of_a_run_are_not_overwritten() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox);
    sandbox.execute(&split(
        "truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16",
    ));
    let refusal = sandbox.shuttertruth(&split("engine ingest capture -o out/plate"));
    assert_refused(
        &refusal,
        2,
        &[
            "out/plate: holds",
            "a frame that was not ingested",
            "new folder",
        ],
    );
    let refusal = sandbox.shuttertruth(&split("engine ingest capture -o scenes/plate"));
    assert_refused(&refusal, 2, &["holds a scene"]);
}
