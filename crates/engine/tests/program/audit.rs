//! `audit`: an engine's velocity and depth against the scene's.

use std::fs;

use serde_json::Value;
use tests::text::{assert_contains, squeeze};

use super::ingest::capture::{CONVENTION, Capture, DESCRIPTION};
use crate::sandbox::{Sandbox, split, stderr, stdout};

/// Audits the capture, with an exit code; returns the words of the output, and audit.json.
#[track_caller]
fn audit(sandbox: &Sandbox, code: i32) -> (String, Value) {
    let output = sandbox.shuttertruth(&split("engine audit capture"));
    let told = stdout(&output);
    let said = stderr(&output);
    assert_eq!(output.status.code(), Some(code), "{told}{said}");
    let audit = sandbox.read_json("out/audit/capture/audit.json");
    (squeeze(&told), audit)
}

#[test]
fn a_right_capture_passes_and_is_listed_object_by_object() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    // An audit needs no sub-frames.
    capture.write("capture.toml", format!("{DESCRIPTION}subframes = 32\n"));
    let (told, audit) = audit(&sandbox, 0);
    assert_contains(&told, &["PASS: velocity, depth and colour are right"]);
    assert_contains(&told, &["plate drawn by Test Engine 1.2, 96x54"]);
    assert_contains(&told, &[" plate ", " background "]);
    assert_eq!(audit["findings"].as_array().unwrap().len(), 0);
    assert_eq!(audit["velocity"][1]["is_right"], true);
}

#[test]
fn a_wrong_convention_fails_with_the_one_that_would_fit() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let other = CONVENTION.replace("\"ndc\"\nvelocity_y", "\"uv\"\nvelocity_y");
    capture.write("engine.toml", &other);
    let (told, wrong) = audit(&sandbox, 1);
    // In steady motion, another unit looks like a structure, which comes first.
    let parts = [
        "velocity of `plate` is the motion since two frames ago",
        "in this scene that looks the same as: is twice too long",
        "the convention may be wrong: `velocity_scale` 2.000 times what it is",
    ];
    assert_contains(&told, &parts);
    let end = "FAIL worst place of plate: out/audit/capture/worst_plate.png \
        written: out/audit/capture/audit.json";
    assert!(told.ends_with(end), "{told}");
    assert_eq!(wrong["findings"][0]["object"], "plate");
    assert_eq!(wrong["findings"][0]["cause"], "two_frames");
    let scale = wrong["findings"][0]["looks_like"][0]["scale"].as_f64();
    let scale = scale.unwrap();
    assert!((scale - 2.0).abs() < 0.01, "{scale}");
    let json = sandbox.shuttertruth(&split("engine audit capture -o out/told --json"));
    let json: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(json, wrong);
    let picture = frame::read_png(&sandbox.path("out/told/worst_plate.png")).unwrap();
    let size = (picture.width, picture.height);
    assert_eq!(size, (3 * 48 * 5 + 2 * 5, 48 * 5));
}

#[test]
fn an_audit_needs_the_scene_and_its_instant() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let instant = ("alignment", "instant = 0.5\nalignment");
    for ((from, to), parts) in [
        (
            ("scene = \"plate\"\n", ""),
            &["capture.toml: names no scene", "--scene"][..],
        ),
        (
            ("\"plate\"", "\"plat\""),
            &["plat", "did you mean plate?"][..],
        ),
        (instant, &["instant = 0.5; allowed for an audit: 0"]),
    ] {
        capture.write("capture.toml", DESCRIPTION.replace(from, to));
        sandbox.refuse("engine audit capture", parts);
    }
    fs::remove_file(capture.path("velocity.exr")).unwrap();
    sandbox.refuse(
        "engine audit capture",
        &["velocity.exr: there is no such file"],
    );
}

#[test]
fn a_capture_of_another_frame_is_undecided_with_ids_and_without() {
    let sandbox = Sandbox::new();
    let capture = Capture::at(&sandbox, -1.0);
    for by in ["by their ids", "by their depth"] {
        let parts = [
            by,
            "- picture is drawn one frame late; draw the time `instant` of manifest.json",
            "UNDECIDED: the capture does not show the scene as it is at the instant",
        ];
        assert_contains(&audit(&sandbox, 2).0, &parts);
        let _ = fs::remove_file(capture.path("object.exr"));
    }
}
