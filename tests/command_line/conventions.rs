//! `--convention`: frames and pictures in an engine's form, and the record of what a filter's
//! shaders got.

use std::path::Path;

use filters::Convention;
use frame::{ExrFile, Frame, Image, read_exr, read_png, write_exr};
use serde_json::Value;
use tests::text::assert_contains;

use crate::sandbox::Sandbox;

/// Conventions, each different from the frames' in one thing or more.
const FORMS: [&str; 12] = [
    "velocity = \"uv\"",
    "velocity = \"ndc\"",
    "velocity_y = \"up\"",
    "velocity_sign = \"previous_minus_current\"",
    "velocity_per = \"shutter\"",
    "velocity_per = \"second\"\nframes_per_second = 24",
    "velocity_scale = 0.5",
    "depth = \"reversed\"\nnear = 0.1",
    "depth = \"forward\"\nnear = 0.5\nfar = 100",
    "depth = \"ndc\"\nnear = 0.5\nfar = 100",
    "color_scale = 0.25",
    "velocity = \"ndc\"\nvelocity_y = \"up\"\nvelocity_sign = \"previous_minus_current\"\nvelocity_per = \"shutter\"\n\
     velocity_scale = 0.5\ndepth = \"reversed\"\nnear = 0.1\nfar = 1000\ncolor_scale = 8",
];

fn render(sandbox: &Sandbox) -> Frame {
    let words = "truths render --quiet --out r --scenes plate --samples-per-pixel 16";
    sandbox.done(&format!("{words} --alignments trailing"));
    Frame::read(&sandbox.path("r/plate/frame.exr")).unwrap()
}

/// Writes a frame as the engine would.
fn write_engine_frame(path: &Path, frame: &Frame, convention: &Convention) {
    let velocity = convention.convert_velocity(&frame.velocity, frame.exposure);
    let mut file = ExrFile::new(frame.color.width, frame.color.height);
    file.push_color("", &convention.convert_color(&frame.color));
    file.push_plane("velocity.X", &velocity.map(|[x, _]| *x));
    file.push_plane("velocity.Y", &velocity.map(|[_, y]| *y));
    file.push_plane("Z", &convention.convert_depth(&frame.depth));
    file.set("exposure", frame.exposure);
    write_exr(path, &file).unwrap();
}

pub fn largest_difference(a: &Image, b: &Image) -> f32 {
    let pixels = a.pixels.iter().zip(&b.pixels);
    let channels =
        pixels.flat_map(|(a, b)| [0, 1, 2].map(|channel| (a[channel] - b[channel]).abs()));
    channels.fold(0.0, f32::max)
}

/// Converts a frame and back.
fn assert_restores(convention: &Convention, frame: &Frame) {
    let color = (convention.restore_color(&convention.convert_color(&frame.color))).unwrap();
    let velocity = convention.convert_velocity(&frame.velocity, frame.exposure);
    let velocity = convention
        .restore_velocity(&velocity, frame.exposure)
        .unwrap();
    let depth = (convention.restore_depth(&convention.convert_depth(&frame.depth))).unwrap();
    assert!(largest_difference(&color, &frame.color) < 1e-6);
    for (restored, due) in velocity.pixels.iter().zip(&frame.velocity.pixels) {
        assert!((restored[0] - due[0]).hypot(restored[1] - due[1]) < 1e-4);
    }
    for (restored, due) in depth.pixels.iter().zip(&frame.depth.pixels) {
        assert!((restored / due - 1.0).abs() < 1e-4, "{restored} {due}");
    }
}

#[test]
fn a_frame_in_any_convention_is_blurred_as_the_frame_itself() {
    let sandbox = Sandbox::new();
    let frame = render(&sandbox);
    let blur = |words: &str| {
        let blur = "engine blur --filter kino --out blurred.exr";
        sandbox.done(&format!("{blur} {words}"));
        sandbox.read_color("blurred.exr")
    };
    let expected = blur("--frame r/plate/frame.exr");
    let moved = largest_difference(&expected, &frame.color);
    assert!(moved > 0.02, "there is something to blur: {moved}");
    for form in FORMS {
        let text = format!("[convention]\n{form}\n");
        sandbox.put("engine.toml", &text);
        let convention = Convention::parse(Path::new("engine.toml"), &text).unwrap();
        assert_restores(&convention, &frame);
        // A form of one line is skipped: its parts are in the forms of several lines.
        if !form.contains('\n') {
            continue;
        }
        write_engine_frame(&sandbox.path("engine.exr"), &frame, &convention);
        let actual = blur("--frame engine.exr --convention engine.toml");
        let actual = convention.restore_color(&actual).unwrap();
        // Rounding of velocity and depth to 24 binary digits and back.
        let difference = largest_difference(&expected, &actual);
        assert!(difference < 1e-4, "{form}: {difference}");
    }
}

#[test]
fn a_picture_of_exposed_colours_has_the_scores_of_its_radiance() {
    let sandbox = Sandbox::new();
    render(&sandbox);
    sandbox.done("engine blur --filter velocity_gather --frame r/plate/frame.exr --out plain.exr");
    let mut file = read_exr(&sandbox.path("plain.exr")).unwrap();
    // A power of two changes no digit.
    let color = file.color("").unwrap();
    file.channels.clear();
    file.push_color("", &color.map(|pixel| pixel.map(|value| 4.0 * value)));
    write_exr(&sandbox.path("exposed.exr"), &file).unwrap();
    let convention = "[convention]\ncolor_scale = 4\n";
    sandbox.put("engine.toml", convention);
    let score = |words: &str| {
        let files = "--truth r/plate/truth_trailing.exr --frame r/plate/frame.exr";
        sandbox.done(&format!("score {files} {words}"))
    };
    let scores = |words: &str| {
        let json: Value = serde_json::from_str(&score(&format!("--json {words}"))).unwrap();
        json["scores"].clone()
    };
    let plain = scores("--image plain.exr");
    let restored = "--image exposed.exr --convention engine.toml";
    assert_eq!(scores(restored), plain);
    assert_ne!(scores("--image exposed.exr"), plain);
    let text = score(restored);
    assert_contains(&text, &["colours divided by color_scale = 4"]);
    let png = "score --truth r/plate/truth_trailing.exr --frame r/plate/frame.exr --image r/plate/frame.png \
               --convention engine.toml";
    sandbox.refuse(png, &["frame.png: has colours of a display", "OpenEXR"]);
}

/// Files with a convention, and parts of the message.
const BAD_CONVENTIONS: [(&str, &[&str]); 5] = [
    ("", &["engine.toml", "missing field `convention`"]),
    (
        "[convention]\nspeed = 1",
        &["engine.toml:2:", "unknown field `speed`"],
    ),
    (
        "name = \"x\"\n[convention]",
        &["engine.toml:1:", "the table [convention] alone"],
    ),
    (
        "[convention]\ndepth = \"ndc\"",
        &[
            "engine.toml:1:",
            "convention: depth of a depth buffer needs near",
        ],
    ),
    (
        "[convention]\nvelocity_per = \"second\"",
        &["engine.toml:1:", "needs frames_per_second"],
    ),
];

#[test]
fn a_wrong_convention_is_refused_with_its_line() {
    let sandbox = Sandbox::new();
    render(&sandbox);
    let words = "engine blur --filter identity --frame r/plate/frame.exr --out b.exr --convention engine.toml";
    sandbox.refuse(words, &["engine.toml: cannot read"]);
    for (text, parts) in BAD_CONVENTIONS {
        sandbox.put("engine.toml", text);
        sandbox.refuse(words, parts);
    }
}

#[test]
fn run_json_says_what_a_filter_s_shaders_got() {
    let sandbox = Sandbox::new();
    let copy = "textureStore(output, pixel, textureLoad(color, pixel, 0));";
    let godot = include_str!("../fixtures/filters/godot_convention.toml");
    sandbox.write_kernel("godot", godot, &[], copy);
    sandbox.measure("--filters ./godot,velocity_gather");
    let run: Value = sandbox.read_json("out/run.json");
    let case = |filter: &str| {
        let mut cases = run["cases"].as_array().unwrap().iter();
        cases.find(|case| case["filter"] == filter).unwrap()["convention"].clone()
    };
    assert_eq!(
        case("godot"),
        serde_json::json!({
            "velocity": "uv", "velocity_y": "down", "velocity_sign": "previous_minus_current", "velocity_per": "frame",
            "frames_per_second": null, "velocity_scale": 1.0, "velocity_format": "rg32float",
            "depth": "reversed", "near": 0.05, "far": null, "depth_format": "r32float",
            "color_scale": 1.0, "color_format": "rgba16float", "output_format": null,
        })
    );
    for other in ["velocity_gather", "scatter_oracle"] {
        assert_eq!(case(other), Value::Null, "{other} got the frame as it is");
    }
}

#[test]
fn textures_between_the_passes_are_shown_with_their_numbers() {
    let sandbox = Sandbox::new();
    let frame = render(&sandbox);
    let words = "engine blur --filter mcguire:paper --frame r/plate/frame.exr --out b.exr";
    let said = sandbox.done(&format!("{words} --show velocity,tiles,output"));
    let read = |name: &str| read_exr(&sandbox.path(&format!("b_{name}.exr"))).unwrap();
    let shown = read("velocity");
    for (channel, component) in [("R", 0), ("G", 1)] {
        let expected = frame.velocity.map(|velocity| velocity[component]);
        assert_eq!(shown.plane(channel).unwrap(), expected, "{channel}");
    }
    let picture = sandbox.read_color("b.exr");
    assert_eq!(read("output").color("").unwrap(), picture);
    let tiles = read("tiles");
    assert!(tiles.width < frame.color.width, "{}", tiles.width);
    let size = format!("tiles: {}x{}, R ", tiles.width, tiles.height);
    assert_contains(&said, &["b_tiles.exr", "b_tiles.png", &size]);
    let png = read_png(&sandbox.path("b_velocity.png")).unwrap();
    let values = || png.pixels.iter().flat_map(|pixel| &pixel[..2]).copied();
    let (least, most) = (values().fold(1.0, f32::min), values().fold(0.0, f32::max));
    assert_eq!((least, most), (0.0, 1.0), "least and greatest");
    let parts = [
        "--show tile",
        "mcguire has no such texture; allowed: ",
        "color, velocity, depth, output",
    ];
    sandbox.refuse(&format!("{words} --show tile"), &parts);
}
