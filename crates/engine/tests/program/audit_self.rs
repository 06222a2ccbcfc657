//! `audit --self`: consecutive frames of an engine, without a scene.

use std::fs;

use frame::{ExrFile, Raster, write_exr};
use serde_json::Value;
use tests::text::{assert_contains, squeeze};

use super::ingest::capture::{Capture, HEIGHT, WIDTH};
use crate::sandbox::{Sandbox, split, stderr, stdout};

/// Writes two frames of the plate, which moves by 19 pixels, before a background that is even or
/// has a pattern.
fn write_frames(sandbox: &Sandbox, has_pattern: bool) {
    fs::create_dir(sandbox.path("frames")).unwrap();
    for (index, time) in [-1.0, 0.0].into_iter().enumerate() {
        let capture = Capture::at(sandbox, time);
        if has_pattern {
            let frame = &capture.frame;
            let color = Raster::from_fn(WIDTH, HEIGHT, |x, y| {
                let waves = (0.7 * f64::from(x)).sin() * (0.9 * f64::from(y)).cos();
                match frame.object_id.at(x, y) {
                    0 => [0.3 + 0.1 * waves as f32; 3],
                    _ => *frame.color.at(x, y),
                }
            });
            capture.write_color("color.exr", &color);
        }
        for name in ["capture.toml", "engine.toml"] {
            fs::rename(capture.path(name), sandbox.path("frames").join(name)).unwrap();
        }
        let folder = sandbox.path("frames").join(format!("{index:04}"));
        fs::rename(sandbox.path("capture"), folder).unwrap();
    }
}

/// Audits the frames, with an exit code; returns the words of the output, and audit.json.
#[track_caller]
fn audit(sandbox: &Sandbox, code: i32) -> (String, Value) {
    let output = sandbox.shuttertruth(&split("engine audit --self frames"));
    let told = stdout(&output);
    assert_eq!(
        output.status.code(),
        Some(code),
        "{told}{}",
        stderr(&output)
    );
    let audit = sandbox.read_json("out/audit/frames/audit.json");
    (squeeze(&told), audit)
}

/// Writes velocity of zero, as the engine's convention has it.
fn write_zero_velocity(sandbox: &Sandbox) {
    let mut file = ExrFile::new(WIDTH, HEIGHT);
    let zero = Raster::filled(WIDTH, HEIGHT, 0.0);
    file.push_plane("R", &zero);
    file.push_plane("G", &zero);
    write_exr(&sandbox.path("frames/0001/velocity.exr"), &file).unwrap();
}

#[test]
fn right_frames_pass_and_say_what_nobody_can_know() {
    let sandbox = Sandbox::new();
    write_frames(&sandbox, true);
    let (told, audit) = audit(&sandbox, 0);
    let parts = [
        "2 frames drawn by Test Engine 1.2, 96x54",
        "background 1 ",
        "carries",
        "? no detail",
        "Nobody can know from pictures alone:",
        "PASS: velocity leads to the frame before wherever the pictures tell",
        "maps of the frames: out/audit/frames/map_0001.png",
    ];
    assert_contains(&told, &parts);
    assert_eq!(audit["carries"], true);
    let map = frame::read_png(&sandbox.path("out/audit/frames/map_0001.png")).unwrap();
    assert_eq!((map.width, map.height), (5 * WIDTH, 5 * HEIGHT));
    let colors: Vec<[f32; 3]> = vec![*map.at(30, 60), *map.at(0, 0)];
    assert!(
        colors[0][1] > colors[0][0],
        "the background is green: {colors:?}"
    );
    assert_eq!(colors[1][0], colors[1][1], "the border is grey: {colors:?}");
}

#[test]
fn zero_velocity_of_a_flat_plate_shows_at_its_outline() {
    let sandbox = Sandbox::new();
    write_frames(&sandbox, true);
    write_zero_velocity(&sandbox);
    let (told, wrong) = audit(&sandbox, 1);
    assert_contains(
        &told,
        &[
            "- velocity of `object_1` is zero, but the picture moves",
            "FAIL",
        ],
    );
    let json = sandbox.shuttertruth(&split("engine audit --self frames --json"));
    let json: Value = serde_json::from_slice(&json.stdout).unwrap();
    assert_eq!(json, wrong);
}

#[test]
fn frames_without_detail_are_undecided() {
    let sandbox = Sandbox::new();
    write_frames(&sandbox, false);
    let (told, audit) = audit(&sandbox, 2);
    assert_contains(
        &told,
        &["UNDECIDED: the pictures tell nothing about velocity"],
    );
    assert_eq!(audit["carries"], false);
}

#[test]
fn other_folders_are_refused_in_a_sentence() {
    let sandbox = Sandbox::new();
    write_frames(&sandbox, true);
    let path = |name: &str| sandbox.path("frames").join(name);
    let refuse = |parts: &[&str]| sandbox.refuse("engine audit --self frames", parts);
    sandbox.refuse(
        "engine audit --self nowhere",
        &["nowhere: there is no such folder"],
    );
    sandbox.refuse(
        "engine audit --self frames --scene plate",
        &["--self", "--scene"],
    );

    fs::rename(path("0001"), path("0002")).unwrap();
    refuse(&["0002: follows frame 0; allowed: consecutive frames"]);
    fs::rename(path("0002"), sandbox.path("0001")).unwrap();
    refuse(&["frames: holds one frame; velocity leads from one frame to the frame before"]);
    fs::rename(sandbox.path("0001"), path("0001")).unwrap();

    fs::rename(path("0001/velocity.exr"), sandbox.path("velocity.exr")).unwrap();
    refuse(&["0001/velocity.exr: there is no such file; it holds every pixel's motion"]);
    let mut file = frame::read_exr(&sandbox.path("velocity.exr")).unwrap();
    file.set("velocity", "instantaneous");
    write_exr(&path("0001/velocity.exr"), &file).unwrap();
    refuse(&["velocity.exr: holds the velocity \"instantaneous\"; allowed: \"previous_frame\""]);
    fs::rename(sandbox.path("velocity.exr"), path("0001/velocity.exr")).unwrap();

    fs::rename(path("0001/object.exr"), sandbox.path("object.exr")).unwrap();
    refuse(&["0001/object.exr: there is no such file, but a frame beside it has one"]);
    fs::rename(sandbox.path("object.exr"), path("0001/object.exr")).unwrap();

    for name in ["color", "velocity", "depth", "object"] {
        let file = format!("0001/{name}.exr");
        let mut small = ExrFile::new(WIDTH / 2, HEIGHT / 2);
        let plane = Raster::filled(WIDTH / 2, HEIGHT / 2, 0.5);
        let channels: &[&str] = match name {
            "color" => &["R", "G", "B"],
            "velocity" => &["R", "G"],
            _ => &["R"],
        };
        let plane = if name == "object" {
            plane.map(|_| 0.0)
        } else {
            plane
        };
        for channel in channels {
            small.push_plane(channel, &plane);
        }
        write_exr(&path(&file), &small).unwrap();
    }
    refuse(&["0001: has 48x27 pixels, the frame before 96x54; allowed: frames of one size"]);
}
