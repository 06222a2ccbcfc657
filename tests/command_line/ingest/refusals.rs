//! Captures that are refused, or taken with a warning: place, finding, what is allowed, way out.

use std::fs;
use std::process::Output;

use frame::{ExrFile, Plane, display_srgb, read_exr, write_exr, write_png};

use super::capture::{CONVENTION, Capture, DESCRIPTION};
use super::ingest;
use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stderr};

fn try_ingest(sandbox: &Sandbox) -> Output {
    sandbox.shuttertruth(&split("engine ingest capture -o out/engine/mine"))
}

/// Changes the files of a capture, looks at the refusal, and puts the files back.
fn assert_refusal(
    capture: &Capture,
    sandbox: &Sandbox,
    changed: &str,
    parts: &[&str],
    change: impl FnOnce(),
) {
    let path = capture.path(changed);
    let before = fs::read(&path).ok();
    change();
    assert_refused(&try_ingest(sandbox), 2, parts);
    match before {
        Some(bytes) => fs::write(&path, bytes).unwrap(),
        None => fs::remove_file(&path).unwrap(),
    }
}

#[test]
fn folders_that_are_no_captures_are_refused() {
    let sandbox = Sandbox::new();
    let refusal = try_ingest(&sandbox);
    assert_refused(
        &refusal,
        2,
        &["capture: there is no such folder", "color.exr"],
    );
    let capture = Capture::new(&sandbox);
    let refuse = |changed: &str, parts: &[&str], change: &dyn Fn()| {
        assert_refusal(&capture, &sandbox, changed, parts, change);
    };
    let remove = |name: &'static str| {
        let path = capture.path(name);
        move || fs::remove_file(&path).unwrap()
    };
    let described = |text: &'static str| {
        let path = capture.path("capture.toml");
        move || fs::write(&path, text).unwrap()
    };
    for (name, parts) in [
        (
            "capture.toml",
            ["capture.toml: there is no such file", "engine = "],
        ),
        (
            "engine.toml",
            ["engine.toml: there is no such file", "name another file"],
        ),
        (
            "color.exr",
            ["color.exr: there is no such file", "radiance"],
        ),
        (
            "velocity.exr",
            ["velocity.exr: there is no such file", "save that buffer"],
        ),
        (
            "depth.exr",
            ["depth.exr: there is no such file", "save that buffer"],
        ),
    ] {
        refuse(name, &parts, &remove(name));
    }
    for (text, parts) in [
        (
            "engine = \"\"",
            ["capture.toml: engine = \"\"", "allowed: a name"],
        ),
        (
            "engine = \"..\"",
            [
                "capture.toml: engine = \"..\"",
                "begins with a letter or a digit",
            ],
        ),
        (
            "name = 1",
            ["capture.toml:1: unknown field `name`", "`engine`"],
        ),
        (
            "engine = \"e\"\nalignment = \"late\"",
            ["capture.toml:2:", "`trailing`, `centred`, `leading`"],
        ),
        (
            "engine = \"e\"\nexposure = 0.0\n",
            ["exposure = 0", "capture.toml"],
        ),
        (
            "engine = \"e\"\nscene = \"../up\"\n",
            [
                "capture.toml:2: scene \"../up\"",
                "allowed: names of a folder",
            ],
        ),
        (
            "engine = \"e\"\nexposure = 0.5\n",
            ["alignment = \"trailing\"", "add it"],
        ),
        (
            "engine = \"e\"\nalignment = \"trailing\"\n",
            ["exposure = 0.5", "add it"],
        ),
    ] {
        refuse("capture.toml", &parts, &described(text));
    }
    refuse(
        "engine.toml",
        &["engine.toml:2: convention: velocity_per = \"second\" needs"],
        &|| {
            capture.write("engine.toml", "\n[convention]\nvelocity_per = \"second\"\n");
        },
    );
    refuse("color.png", &["color.png", "remove one of them"], &|| {
        fs::write(capture.path("color.png"), "").unwrap();
    });
    assert_done(&try_ingest(&sandbox));
    let words = split("engine ingest capture -o capture");
    assert_refused(
        &sandbox.shuttertruth(&words),
        2,
        &["--out capture", "is the capture itself"],
    );
    let words = split("engine ingest capture -o out/a@b");
    assert_refused(
        &sandbox.shuttertruth(&words),
        2,
        &["out/a@b: its last part", "allowed: letters"],
    );
}

#[test]
fn pictures_that_cannot_be_right_are_refused() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let path = |name: &str| capture.path(name);
    let change = |name: &'static str, channel: &'static str, change: &dyn Fn(&mut Plane)| {
        let file = read_exr(&path(name)).unwrap();
        let mut changed = ExrFile::new(file.width, file.height);
        for own in &file.channels {
            let mut plane = file.plane(&own.name).unwrap();
            if own.name == channel {
                change(&mut plane);
            }
            changed.push_plane(&own.name, &plane);
        }
        write_exr(&path(name), &changed).unwrap();
    };
    let refuse = |changed: &str, parts: &[&str], change: &dyn Fn()| {
        assert_refusal(&capture, &sandbox, changed, parts, change);
    };
    for (name, channel, value, parts) in [
        (
            "color.exr",
            "G",
            f32::NAN,
            [
                "color.exr: channel \"G\" holds NaN at pixel (5, 1)",
                "must be finite",
            ],
        ),
        (
            "velocity.exr",
            "R",
            f32::INFINITY,
            [
                "velocity.exr: channel \"R\" holds inf at pixel (5, 1)",
                "overflowed",
            ],
        ),
        (
            "depth.exr",
            "R",
            f32::NAN,
            [
                "depth.exr: channel \"R\" holds NaN at pixel (5, 1)",
                "allows 0 to 1",
            ],
        ),
        (
            "depth.exr",
            "R",
            7.5,
            ["depth.exr: channel \"R\" holds 7.5", "name the depth"],
        ),
    ] {
        refuse(name, &parts, &|| {
            change(name, channel, &|plane| plane.pixels[96 + 5] = value)
        });
    }
    refuse(
        "velocity.exr",
        &[
            "velocity.exr: has 64x32 pixels, the colour 96x54",
            "without scaling",
        ],
        &|| {
            let mut file = ExrFile::new(64, 32);
            for name in ["X", "Y"] {
                file.push_plane(name, &Plane::filled(64, 32, 0.0));
            }
            write_exr(&path("velocity.exr"), &file).unwrap();
        },
    );
    refuse(
        "velocity.exr",
        &["velocity.exr: has the channels B, Q; needed: velocity.X and velocity.Y"],
        &|| {
            let mut file = ExrFile::new(96, 54);
            for name in ["B", "Q"] {
                file.push_plane(name, &Plane::filled(96, 54, 0.0));
            }
            write_exr(&path("velocity.exr"), &file).unwrap();
        },
    );
    refuse(
        "object.exr",
        &[
            "object.exr: channel \"R\" holds 0.5 at pixel (0, 0)",
            "without blending",
        ],
        &|| {
            let mut file = ExrFile::new(96, 54);
            file.push_plane("R", &Plane::filled(96, 54, 0.5));
            write_exr(&path("object.exr"), &file).unwrap();
        },
    );
    assert_done(&try_ingest(&sandbox));
}

#[test]
fn sub_frames_that_make_no_truth_are_refused() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).with_subframes(5);
    let refuse = |parts: &[&str]| assert_refused(&try_ingest(&sandbox), 2, parts);
    refuse(&[
        "subframes: holds 5 sub-frames",
        "even numbers from 4",
        "capture 32",
    ]);
    fs::remove_file(capture.path("subframes/0002.exr")).unwrap();
    refuse(&[
        "subframes/0003.exr: is in the place of 0002.exr",
        "without a gap",
    ]);
    fs::rename(
        capture.path("subframes/0004.exr"),
        capture.path("subframes/0002.exr"),
    )
    .unwrap();
    capture.write("capture.toml", &format!("{DESCRIPTION}subframes = 32\n"));
    refuse(&[
        "subframes: holds 4 sub-frames, capture.toml says 32",
        "capture all",
    ]);
    capture.write("capture.toml", DESCRIPTION);
    fs::copy(
        capture.path("velocity.exr"),
        capture.path("subframes/0002.exr"),
    )
    .unwrap();
    refuse(&["subframes/0002.exr: lacks the channel \"B\""]);
    capture.write_color("subframes/0002.exr", &capture.frame.color.cropped(1));
    refuse(&["subframes/0002.exr: has 94x52 pixels, the colour 96x54"]);
    let shown = display_srgb(&capture.frame.color, 0.0);
    write_png(&capture.path("subframes/0005.png"), &shown).unwrap();
    refuse(&["subframes/0005.png: is a .png, the colour a .exr"]);
}

#[test]
fn ids_that_fit_no_object_or_are_missing_are_refused() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).with_subframes_and_ids(4);
    let color = &capture.frame.color;
    capture.write_color("subframes/0002.exr", color);
    let refusal = try_ingest(&sandbox);
    assert_refused(
        &refusal,
        2,
        &[
            "subframes/0002.exr: has no channel \"object\"",
            "in all of them, or in none",
        ],
    );
    let ids = color.map(|_| 7);
    capture.write_picture("subframes/0002.exr", color, Some(&ids));
    let refusal = try_ingest(&sandbox);
    assert_refused(
        &refusal,
        2,
        &["hold ids up to 7; allowed: up to 1", "leave object.exr out"],
    );
    // Nobody knows how many objects a scene has that is not ours.
    capture.write(
        "capture.toml",
        &DESCRIPTION.replace("scene = \"plate\"\n", ""),
    );
    let told = ingest(&sandbox);
    assert!(
        told.contains("objects: object_1, object_2, object_3,"),
        "{told}"
    );
}

#[test]
fn losses_are_told_and_taken() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let told = stderr(&try_ingest(&sandbox));
    assert!(told.contains("velocity.exr holds half floats"), "{told}");
    // Half floats of a depth that ends at 1 lose what is far.
    let forward = CONVENTION.replace("reversed", "forward");
    capture.write("engine.toml", &forward);
    let told = stderr(&try_ingest(&sandbox));
    assert!(
        told.contains("depth.exr holds half floats of depth = \"forward\": 41 m"),
        "{told}"
    );
    fs::remove_file(capture.path("color.exr")).unwrap();
    let shown = display_srgb(&capture.frame.color, 0.0);
    write_png(&capture.path("color.png"), &shown).unwrap();
    let told = stderr(&try_ingest(&sandbox));
    assert!(told.contains("color.png has 8 bits per channel"), "{told}");
}
