//! `audit`: an engine's velocity and depth against the scene's.

use std::fs;

use crate::ingest::capture::{CONVENTION, Capture, DESCRIPTION};
use crate::sandbox::{Sandbox, assert_refused, split, stderr, stdout};

#[test]
fn a_right_capture_passes_and_is_listed_object_by_object() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox);
    let output = sandbox.shuttertruth(&split("engine audit capture"));
    let told = stdout(&output);
    assert_eq!(output.status.code(), Some(0), "{told}{}", stderr(&output));
    assert!(
        told.contains("PASS: velocity, depth and colour are right"),
        "{told}"
    );
    for name in [
        "plate drawn by Test Engine 1.2, 96x54",
        "  plate ",
        "  background ",
    ] {
        assert!(told.contains(name), "{told}");
    }
    let json = fs::read_to_string(sandbox.path("out/audit/capture/audit.json")).unwrap();
    let audit: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(audit["findings"].as_array().unwrap().len(), 0);
    assert_eq!(audit["velocity"][1]["is_right"], true);
}

#[test]
fn a_wrong_convention_fails_with_the_one_that_would_fit() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    capture.write(
        "engine.toml",
        &CONVENTION.replace("\"ndc\"\nvelocity_y", "\"uv\"\nvelocity_y"),
    );
    let output = sandbox.shuttertruth(&split("engine audit capture -o out/told"));
    let told = stdout(&output);
    assert_eq!(output.status.code(), Some(1), "{told}{}", stderr(&output));
    let words: Vec<&str> = told.split_whitespace().collect();
    let told = words.join(" ");
    assert!(
        told.contains("velocity of `plate` is twice too long"),
        "{told}"
    );
    assert!(
        told.contains("the convention may be wrong: `velocity_scale` 2.000 times what it is"),
        "{told}"
    );
    assert!(
        told.ends_with(
            "FAIL worst place of plate: out/told/worst_plate.png written: out/told/audit.json"
        ),
        "{told}"
    );
    let picture = frame::read_png(&sandbox.path("out/told/worst_plate.png")).unwrap();
    assert_eq!(
        (picture.width, picture.height),
        (3 * 48 * 5 + 2 * 5, 48 * 5)
    );
    let json = stdout(&sandbox.shuttertruth(&split("engine audit capture -o out/told --json")));
    let audit: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(audit["findings"][0]["object"], "plate");
    let scale = audit["findings"][0]["cause"]["scale"].as_f64().unwrap();
    assert!((scale - 2.0).abs() < 0.01, "{scale}");
}

#[test]
fn an_audit_needs_the_scene_and_its_instant() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let refuse = |words: &[&str]| {
        let output = sandbox.shuttertruth(&split("engine audit capture"));
        assert_refused(&output, 2, words);
    };
    capture.write(
        "capture.toml",
        &DESCRIPTION.replace("scene = \"plate\"\n", ""),
    );
    refuse(&["capture.toml: names no scene", "--scene"]);
    capture.write(
        "capture.toml",
        &DESCRIPTION.replace("\"plate\"", "\"plat\""),
    );
    refuse(&["plat", "did you mean plate?"]);
    capture.write("capture.toml", &format!("{DESCRIPTION}instant = 0.5\n"));
    refuse(&["instant = 0.5; allowed for an audit: 0"]);
    fs::remove_file(capture.path("velocity.exr")).unwrap();
    refuse(&["velocity.exr: there is no such file"]);
}

/// Audits a capture, and returns the exit code and the words of the output.
fn audit(sandbox: &Sandbox) -> (Option<i32>, String) {
    let output = sandbox.shuttertruth(&split("engine audit capture"));
    let told = stdout(&output);
    let words: Vec<&str> = told.split_whitespace().collect();
    (output.status.code(), words.join(" "))
}

#[test]
fn a_capture_of_another_frame_is_undecided_with_ids_and_without() {
    let sandbox = Sandbox::new();
    let capture = Capture::at(&sandbox, -1.0);
    for by in ["by their ids", "by their depth"] {
        let (code, told) = audit(&sandbox);
        assert_eq!(code, Some(2), "{told}");
        for words in [
            by,
            "- picture is drawn one frame late; draw the time `instant` of manifest.json",
            "UNDECIDED: the capture does not show the scene as it is at the instant",
        ] {
            assert!(told.contains(words), "{words}: {told}");
        }
        let _ = fs::remove_file(capture.path("object.exr"));
    }
}

#[test]
fn an_object_that_is_elsewhere_is_undecided_though_most_pixels_agree() {
    let sandbox = Sandbox::new();
    // Between two frames, which no cause explains.
    let capture = Capture::at(&sandbox, -0.37);
    for by in ["by its ids", "by its depth"] {
        let (code, told) = audit(&sandbox);
        assert_eq!(code, Some(2), "{told}");
        for words in [
            "- picture of `plate` shows other things",
            by,
            "needed: 90 %",
            " plate ",
        ] {
            assert!(told.contains(words), "{words}: {told}");
        }
        let _ = fs::remove_file(capture.path("object.exr"));
    }
    let json = fs::read_to_string(sandbox.path("out/audit/capture/audit.json")).unwrap();
    let audit: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(audit["shows_scene"], false);
    assert!(audit["alike"].as_f64().unwrap() > 0.9, "{json}");
    assert!(
        audit["objects"][1]["shown"].as_f64().unwrap() < 0.9,
        "{json}"
    );
}

#[test]
fn a_black_object_of_an_unlit_scene_fails() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let color = (capture.frame.color).zip(&capture.frame.object_id, |color, id| match id {
        0 => *color,
        _ => [0.0; 3],
    });
    capture.write_color("color.exr", &color);
    let (code, told) = audit(&sandbox);
    assert_eq!(code, Some(1), "{told}");
    let words =
        "- colour of `plate` is (0.000, 0.000, 0.000) in the mean, not (0.700, 0.400, 0.200)";
    assert!(told.contains(words), "{told}");
}
