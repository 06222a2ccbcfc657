//! Captures that are refused, or accepted with a warning: place, finding, what is allowed, remedy.

use std::fs;

use frame::{ExrFile, Plane, display_srgb, read_exr, write_exr, write_png};
use tests::text::assert_contains;

use super::capture::{CONVENTION, Capture, DESCRIPTION};
use super::ingest;
use crate::sandbox::{Sandbox, split, stderr};

const INGEST: &str = "engine ingest capture -o out/engine/mine";

/// Changes a file of a capture, checks the refusal, and restores the file.
#[track_caller]
fn refuse(
    (sandbox, capture): (&Sandbox, &Capture),
    changed: &str,
    parts: &[&str],
    change: impl FnOnce(),
) {
    let path = capture.path(changed);
    let before = fs::read(&path).ok();
    change();
    sandbox.refuse(INGEST, parts);
    match before {
        Some(bytes) => fs::write(&path, bytes).unwrap(),
        None => fs::remove_file(&path).unwrap(),
    }
}

/// Files that a capture needs, and parts of the message without them.
const MISSING_FILES: [(&str, &[&str]); 5] = [
    (
        "capture.toml",
        &["capture.toml: there is no such file", "engine ="],
    ),
    (
        "engine.toml",
        &["engine.toml: there is no such file", "name another file"],
    ),
    (
        "color.exr",
        &["color.exr: there is no such file", "radiance"],
    ),
    (
        "velocity.exr",
        &["velocity.exr: there is no such file", "save that buffer"],
    ),
    (
        "depth.exr",
        &["depth.exr: there is no such file", "save that buffer"],
    ),
];

/// Texts of a capture.toml, and parts of the message.
const BAD_DESCRIPTIONS: [(&str, &[&str]); 8] = [
    (
        r#"engine = """#,
        &[r#"capture.toml: engine = """#, "allowed: a name"],
    ),
    (
        r#"engine = "..""#,
        &[
            r#"capture.toml: engine = "..""#,
            "begins with a letter or a digit",
        ],
    ),
    (
        "name = 1",
        &["capture.toml:1: unknown field `name`", "`engine`"],
    ),
    (
        "engine = \"e\"\nalignment = \"late\"",
        &["capture.toml:2:", "`trailing`, `centred`, `leading`"],
    ),
    (
        "engine = \"e\"\nexposure = 0.0",
        &["exposure = 0", "capture.toml"],
    ),
    (
        "engine = \"e\"\nscene = \"../up\"",
        &[
            r#"capture.toml:2: scene "../up""#,
            "allowed: names of a folder",
        ],
    ),
    (
        "engine = \"e\"\nexposure = 0.5",
        &[r#"alignment = "trailing""#, "need a shutter; add a line"],
    ),
    (
        "engine = \"e\"\nalignment = \"trailing\"",
        &["exposure = 0.5", "need a shutter; add a line"],
    ),
];

/// Folders to ingest into, and parts of the message.
const BAD_FOLDERS: [(&str, &[&str]); 2] = [
    ("capture", &["--out capture", "is the capture itself"]),
    ("out/a@b", &["out/a@b: its last part", "allowed: letters"]),
];

#[test]
fn folders_that_are_no_captures_are_refused() {
    let sandbox = Sandbox::new();
    let parts = ["capture: there is no such folder", "color.exr"];
    sandbox.refuse(INGEST, &parts);
    let capture = Capture::new(&sandbox);
    let bench = (&sandbox, &capture);
    for (name, parts) in MISSING_FILES {
        let remove = || fs::remove_file(capture.path(name)).unwrap();
        refuse(bench, name, parts, remove);
    }
    for (text, parts) in BAD_DESCRIPTIONS {
        let describe = || capture.write("capture.toml", text);
        refuse(bench, "capture.toml", parts, describe);
    }
    let parts = ["color.png", "remove one of them"];
    refuse(bench, "color.png", &parts, || {
        capture.write("color.png", "")
    });
    sandbox.done(INGEST);
    sandbox.refuse_each("engine ingest capture -o", &BAD_FOLDERS);
}

/// A file, its channel, the value of a pixel, and parts of the message.
const BAD_PIXELS: [(&str, &str, f32, &[&str]); 4] = [
    (
        "color.exr",
        "G",
        f32::NAN,
        &[
            r#"color.exr: channel "G" holds NaN at pixel (5, 1)"#,
            "must be finite",
        ],
    ),
    (
        "velocity.exr",
        "R",
        f32::INFINITY,
        &[
            r#"velocity.exr: channel "R" holds inf at pixel (5, 1)"#,
            "overflowed",
        ],
    ),
    (
        "depth.exr",
        "R",
        f32::NAN,
        &[
            r#"depth.exr: channel "R" holds NaN at pixel (5, 1)"#,
            "allows 0 to 1",
        ],
    ),
    (
        "depth.exr",
        "R",
        7.5,
        &[r#"depth.exr: channel "R" holds 7.5"#, "name the depth"],
    ),
];

/// A file of a wrong shape.
struct BadShape {
    name: &'static str,
    /// Letters that name its channels.
    channels: &'static str,
    size: [u32; 2],
    /// Value of all pixels.
    value: f32,
    /// Parts of the message.
    says: &'static [&'static str],
}

const BAD_SHAPES: [BadShape; 3] = [
    BadShape {
        name: "velocity.exr",
        channels: "XY",
        size: [64, 32],
        value: 0.0,
        says: &[
            "velocity.exr: has 64x32 pixels, the colour 96x54",
            "without scaling",
        ],
    },
    BadShape {
        name: "velocity.exr",
        channels: "BQ",
        size: [96, 54],
        value: 0.0,
        says: &["velocity.exr: has the channels B, Q; needed: velocity.X and velocity.Y"],
    },
    BadShape {
        name: "object.exr",
        channels: "R",
        size: [96, 54],
        value: 0.5,
        says: &[
            r#"object.exr: channel "R" holds 0.5 at pixel (0, 0)"#,
            "without blending",
        ],
    },
];

#[test]
fn pictures_that_cannot_be_right_are_refused() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let bench = (&sandbox, &capture);
    let change_pixel = |name: &str, channel: &str, value: f32| {
        let mut file = read_exr(&capture.path(name)).unwrap();
        let mut plane = file.plane(channel).unwrap();
        plane.pixels[96 + 5] = value;
        file.channels.retain(|entry| entry.name != channel);
        file.push_plane(channel, &plane);
        write_exr(&capture.path(name), &file).unwrap();
    };
    for (name, channel, value, parts) in BAD_PIXELS {
        let change = || change_pixel(name, channel, value);
        refuse(bench, name, parts, change);
    }
    for BadShape {
        name,
        channels,
        size: [width, height],
        value,
        says,
    } in BAD_SHAPES
    {
        refuse(bench, name, says, || {
            let plane = Plane::filled(width, height, value);
            let mut file = ExrFile::new(width, height);
            for channel in channels.chars() {
                file.push_plane(&channel.to_string(), &plane);
            }
            write_exr(&capture.path(name), &file).unwrap();
        });
    }
    sandbox.done(INGEST);
}

#[test]
fn conventions_that_make_impossible_numbers_are_refused() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    for (line, file, parts) in [
        (
            "color_scale = 1e-320",
            "color.exr",
            &["becomes inf by the [convention]", "correct color_scale"][..],
        ),
        (
            "color_scale = 1e-30",
            "color.exr",
            &["has the colour", "allowed: radiance up to 1e12"][..],
        ),
        (
            "color_scale = 1e300",
            "color.exr",
            &["becomes 0 by the [convention]", "correct color_scale"][..],
        ),
        (
            "velocity_scale = 1e-320",
            "velocity.exr",
            &["becomes", "inf by the [convention]", "velocity_scale"][..],
        ),
        (
            "velocity_scale = 1e300",
            "velocity.exr",
            &["becomes", "0 by the [convention]", "velocity_scale"][..],
        ),
        (
            "near = 1e-320",
            "depth.exr",
            &["becomes 0 m by the [convention]", "above 0", "near"][..],
        ),
    ] {
        let (key, _) = line.split_once(' ').unwrap();
        let lines = CONVENTION
            .lines()
            .filter(|default_line| !default_line.starts_with(key));
        let convention: String = lines
            .chain([line])
            .map(|line| format!("{line}\n"))
            .collect();
        capture.write("engine.toml", convention);
        sandbox.refuse(INGEST, &[&[&*format!("{file}: ")], parts].concat());
    }
    capture.write("engine.toml", CONVENTION);
    sandbox.done(INGEST);
}

#[test]
fn sub_frames_that_make_no_truth_are_refused() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).with_subframes(5);
    let refuse = |parts: &[&str]| sandbox.refuse(INGEST, parts);
    let [second, fourth] = ["2", "4"].map(|at| capture.path(&format!("subframes/000{at}.exr")));
    refuse(&[
        "subframes: holds 5 sub-frames",
        "even numbers from 4",
        "capture 32",
    ]);
    fs::remove_file(&second).unwrap();
    refuse(&["subframes/0003.exr: expected 0002.exr", "without gaps"]);
    fs::rename(fourth, &second).unwrap();
    capture.write("capture.toml", format!("{DESCRIPTION}subframes = 32\n"));
    refuse(&[
        "subframes: holds 4 sub-frames, capture.toml says 32",
        "capture all",
    ]);
    capture.write("capture.toml", DESCRIPTION);
    fs::copy(capture.path("velocity.exr"), second).unwrap();
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
    let capture = Capture::new(&sandbox).add_subframes(4, true);
    let color = &capture.frame.color;
    capture.write_color("subframes/0002.exr", color);
    let parts = [
        "subframes/0002.exr: has no channel \"object\"",
        "in all of them, or in none",
    ];
    sandbox.refuse(INGEST, &parts);
    let ids = color.map(|_| 7);
    capture.write_picture("subframes/0002.exr", color, Some(&ids));
    let parts = ["hold ids up to 7; allowed: up to 1", "leave object.exr out"];
    sandbox.refuse(INGEST, &parts);
    // The number of objects in a foreign scene is unknown.
    let unnamed = DESCRIPTION.replace("scene = \"plate\"\n", "");
    capture.write("capture.toml", &unnamed);
    let told = ingest(&sandbox);
    assert_contains(&told, &["objects: object_1, object_2, object_3,"]);
}

#[test]
fn losses_are_told_and_taken() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let assert_told = |part: &str| {
        let output = sandbox.shuttertruth(&split(INGEST));
        assert_contains(&stderr(&output), &[part]);
    };
    assert_told("velocity.exr holds half floats");
    // Half floats of a depth that ends at 1 lose distant surfaces.
    let forward = CONVENTION.replace("reversed", "forward");
    capture.write("engine.toml", &forward);
    assert_told("depth.exr holds half floats of depth = \"forward\": 41 m");
    fs::remove_file(capture.path("color.exr")).unwrap();
    let shown = display_srgb(&capture.frame.color, 0.0);
    write_png(&capture.path("color.png"), &shown).unwrap();
    assert_told("color.png has 8 bits per channel");
}
