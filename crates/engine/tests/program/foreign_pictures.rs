//! Pictures of other programs: attributes that change their meaning, and names of channels.

use std::fs;

use frame::{ExrFile, Frame, read_exr, write_exr};
use serde_json::Value;
use tests::exr_attribute::{ACES_CG, REC_709, bytes_of, set_exr_attribute, to_aces_cg};
use tests::text::assert_contains;

use super::ingest::capture::{CONVENTION, Capture};
use crate::sandbox::{Sandbox, split, stderr};

const SCORE: &str =
    "score --truth out/plate/truth_trailing.exr --frame out/plate/frame.exr --image mine.exr";
const BLUR: &str = "engine blur --filter identity --frame mine.exr --out b.exr";
const INGEST: &str = "engine ingest capture -o out/engine/mine";

/// Makes a sandbox with a truth and, in `mine.exr`, its frame.
fn set_up() -> Sandbox {
    Sandbox::once(|sandbox| {
        sandbox.done("truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16");
        let mut file = read_exr(&sandbox.path("out/plate/frame.exr")).unwrap();
        file.attributes.retain(|name, _| name == "exposure");
        write_exr(&sandbox.path("mine.exr"), &file).unwrap();
    })
}

fn scores(sandbox: &Sandbox, words: &str) -> Value {
    let json: Value =
        serde_json::from_str(&sandbox.done(&format!("{SCORE} --json {words}"))).unwrap();
    json["scores"].clone()
}

/// Converts the colours of a file to ACEScg, and says so in its header.
fn convert(path: &std::path::Path) {
    let mut file = read_exr(path).unwrap();
    let color = file.color("").unwrap().map(|pixel| to_aces_cg(*pixel));
    file.channels
        .retain(|channel| !["R", "G", "B"].contains(&channel.name.as_str()));
    file.push_color("", &color);
    write_exr(path, &file).unwrap();
    set_exr_attribute(
        path,
        "chromaticities",
        "chromaticities",
        &bytes_of(&ACES_CG),
    );
}

#[test]
fn other_primaries_are_converted_wherever_a_picture_enters() {
    let sandbox = set_up();
    let mine = sandbox.path("mine.exr");
    let flip = |score: &Value| {
        score["full"]["flip"]["value"]
            .as_f64()
            .unwrap_or_else(|| panic!("{score}"))
    };
    let plain = scores(&sandbox, "");
    let blur = || {
        sandbox.done(BLUR);
        read_exr(&sandbox.path("b.exr")).unwrap().color("").unwrap()
    };
    let blurred = blur();
    set_exr_attribute(
        &mine,
        "chromaticities",
        "chromaticities",
        &bytes_of(&REC_709),
    );
    assert!(scores(&sandbox, "") == plain, "the same primaries");
    convert(&mine);
    // Six digits of the published matrix.
    let error = (flip(&scores(&sandbox, "")) - flip(&plain)).abs();
    assert!(error < 1e-4, "{error}");
    let note = "colours were converted to Rec.709 (Bradford) from red [0.713";
    let json: Value = serde_json::from_str(&sandbox.done(&format!("{SCORE} --json"))).unwrap();
    assert_contains(&json["notes"].to_string(), &[note]);
    let converted = blur();
    for (one, other) in converted.pixels.iter().zip(&blurred.pixels) {
        let is_near = one
            .iter()
            .zip(other)
            .all(|(one, other)| (one - other).abs() < 1e-4);
        assert!(is_near, "{one:?} {other:?}");
    }
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let show = || {
        let told = stderr(&sandbox.shuttertruth(&split(INGEST)));
        let frame = Frame::read(&sandbox.path("out/engine/mine/frame.exr")).unwrap();
        (frame.color, told)
    };
    let (expected, _) = show();
    convert(&capture.path("color.exr"));
    let (color, told) = show();
    assert_contains(&told, &[&format!("color.exr: {note}")]);
    for (one, other) in color.pixels.iter().zip(&expected.pixels) {
        let is_near = one
            .iter()
            .zip(other)
            .all(|(one, other)| (one - other).abs() < 1e-4);
        assert!(is_near, "{one:?} {other:?}");
    }
}

#[test]
fn attributes_that_change_the_meaning_of_pixels_are_refused() {
    let window = [0_i32, 0, 95, 63].map(i32::to_le_bytes).concat();
    let flat = bytes_of(&[0.3; 8]);
    let two = bytes_of(&[2.0]);
    for (name, kind, value, parts) in [
        (
            "pixelAspectRatio",
            "float",
            &two[..],
            &["its pixels are 2 times as wide as high", "square"][..],
        ),
        (
            "displayWindow",
            "box2i",
            &window,
            &["its data window", "is not its display window"][..],
        ),
        (
            "chromaticities",
            "chromaticities",
            &flat,
            &["no primaries of colours", "Rec.709"][..],
        ),
        (
            "whiteLuminance",
            "float",
            &two,
            &["a whiteLuminance of 2 cd/m2", "color_scale = 1"][..],
        ),
        (
            "colorInteropID",
            "string",
            b"srgb_rec709_display",
            &["colorInteropID = \"srgb_rec709_display\"", "linear"][..],
        ),
        (
            "colorInteropID",
            "string",
            b"lin_ap1_scene",
            &["colorInteropID = \"lin_ap1_scene\"", "chromaticities"][..],
        ),
    ] {
        let sandbox = set_up();
        let mine = sandbox.path("mine.exr");
        set_exr_attribute(&mine, name, kind, value);
        for line in [SCORE, BLUR] {
            sandbox.refuse(line, &[&["mine.exr: "], parts].concat());
        }
        let capture_sandbox = Sandbox::new();
        let capture = Capture::new(&capture_sandbox);
        // A factor is the way out of a luminance.
        capture.write(
            "engine.toml",
            CONVENTION.replace("color_scale", "# color_scale"),
        );
        set_exr_attribute(&capture.path("color.exr"), name, kind, value);
        capture_sandbox.refuse(INGEST, &[&["color.exr: "], parts].concat());
    }
}

#[test]
fn a_factor_on_colours_is_the_unit_that_a_luminance_needs() {
    let sandbox = set_up();
    let plain = scores(&sandbox, "");
    set_exr_attribute(
        &sandbox.path("mine.exr"),
        "whiteLuminance",
        "float",
        &bytes_of(&[100.0]),
    );
    sandbox.put("engine.toml", "[convention]\ncolor_scale = 1\n");
    assert!(scores(&sandbox, "--convention engine.toml") == plain);
}

#[test]
fn score_reads_the_names_that_ingest_reads() {
    let sandbox = set_up();
    let color = read_exr(&sandbox.path("mine.exr"))
        .unwrap()
        .color("")
        .unwrap();
    let dark = color.map(|pixel| pixel.map(|value| 0.5 * value));
    let write = |layers: &[(&str, bool)]| {
        let mut file = ExrFile::new(color.width, color.height);
        for (layer, is_dark) in layers {
            file.push_color(layer, if *is_dark { &dark } else { &color });
        }
        write_exr(&sandbox.path("mine.exr"), &file).unwrap();
    };
    write(&[("", false)]);
    let plain = scores(&sandbox, "");
    for layers in [
        &[("Image", false)][..],
        &[("ViewLayer.Combined", false)],
        &[("ViewLayer.Combined", false), ("Composite.Combined", false)],
        &[("", false), ("View.Layer.Combined", false)],
        // A renderer's other outputs are no second picture.
        &[("", false), ("Diffuse", true)],
    ] {
        write(layers);
        assert!(scores(&sandbox, "") == plain, "{layers:?}");
    }
    for (layers, parts) in [
        (
            &[("ViewLayer.Combined", false), ("Composite.Combined", true)][..],
            &[
                "Composite.Combined.R and ViewLayer.Combined.R, which differ",
                "save only",
            ][..],
        ),
        (
            &[("", false), ("ViewLayer.Combined", true)],
            &["R and ViewLayer.Combined.R, which differ"],
        ),
        (
            &[("Diffuse", false)],
            &["lacks the channel \"R\"; it has Diffuse.B, Diffuse.G, Diffuse.R"],
        ),
    ] {
        write(layers);
        sandbox.refuse(SCORE, &[&["mine.exr: "], parts].concat());
    }
    fs::remove_file(sandbox.path("mine.exr")).unwrap();
}
