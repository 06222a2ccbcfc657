//! `score`: finished pictures without a filter.

use std::fs;

use frame::{ExrFile, Frame, Raster, Truth, display_srgb, read_exr, write_exr, write_png};
use metrics::{EquivalentMetric, Metric, ObjectMetric, ProbeScores, Scores, SkillMetric};
use serde_json::Value;
use tests::text::assert_contains;

use crate::sandbox::{SCENE, Sandbox};

const FINE: &str = "--filters velocity_gather:fine";
const TRUTH: &str = "out/plate/truth_trailing.exr";
const FRAME: &str = "out/plate/frame.exr";
const LADDER: &str = "--ladder out/plate/ladder_trailing";
const OUTPUT: &str = "out/plate/velocity_gather_fine/output.exr";

/// Returns the words that score a picture.
fn words(image: &str) -> String {
    format!("score --truth {TRUTH} --frame {FRAME} --image {image}")
}

fn score(sandbox: &Sandbox, image: &str) -> String {
    sandbox.done(&words(image))
}

fn score_as_json(sandbox: &Sandbox, image: &str) -> Value {
    serde_json::from_str(&score(sandbox, &format!("{image} --json"))).unwrap()
}

fn scores(sandbox: &Sandbox, image: &str) -> Scores {
    let json = score_as_json(sandbox, image);
    assert_eq!([&json["scene"], &json["alignment"]], ["plate", "trailing"]);
    serde_json::from_value(json["scores"].clone()).unwrap()
}

/// Makes a sandbox with a measured filter.
fn set_up() -> Sandbox {
    Sandbox::once(|sandbox| drop(sandbox.measure(FINE)))
}

/// Returns the filter's scores except those of probes, which a picture cannot have.
fn read_scores(sandbox: &Sandbox) -> Scores {
    let mut scores = sandbox.read_filter_cases()[0].scores.clone();
    scores.probes = ProbeScores::not_applicable("no probes were run through the filter");
    scores
}

/// Copies an OpenEXR file without the channels that begin with a text.
fn copy_without(sandbox: &Sandbox, channels: &str, from: &str, to: &str) {
    let mut file = read_exr(&sandbox.path(from)).unwrap();
    let written = file.channels.len();
    file.channels
        .retain(|channel| !channel.name.starts_with(channels));
    assert!(file.channels.len() < written);
    write_exr(&sandbox.path(to), &file).unwrap();
}

/// Returns whether a metric is about colours, and so applies to any picture.
fn of_colour(metric: &Metric) -> bool {
    matches!(
        metric,
        Metric::Image(..)
            | Metric::StaticContamination
            | Metric::Object(ObjectMetric::Flip)
            | Metric::Frozen(_)
            | Metric::Skill(SkillMetric::Mse | SkillMetric::Flip)
            | Metric::Equivalent(EquivalentMetric::Mse | EquivalentMetric::Flip)
    )
}

#[test]
fn score_repeats_the_scores_of_a_run() {
    let sandbox = set_up();
    let output = format!("{OUTPUT} {LADDER}");
    assert_eq!(scores(&sandbox, &output), read_scores(&sandbox));
    let text = score(&sandbox, &output);
    assert_contains(&text, &["truth: trailing shutter, open for 0.5 frames"]);
    assert!(!text.contains("has no mattes"), "{text}");
}

#[test]
fn mattes_that_a_file_gives_are_said_to_be_given() {
    let sandbox = set_up();
    // A grey picture with the truth's own mattes.
    let mut file = read_exr(&sandbox.path(TRUTH)).unwrap();
    file.attributes.clear();
    let grey = file.color("").unwrap().map(|_| [0.3; 3]);
    file.channels
        .retain(|channel| channel.name.starts_with("coverage."));
    file.push_color("", &grey);
    write_exr(&sandbox.path("grey.exr"), &file).unwrap();
    let label_tv = scores(&sandbox, "grey.exr").get("label_tv".parse().unwrap());
    assert_eq!(label_tv.value(), Some(0.0));
    let note = "mattes, channels coverage.<object>, were given with the picture and not measured";
    let text = score(&sandbox, "grey.exr");
    assert_contains(&text, &[&format!("grey.exr: its {note}")]);
    let notes = |image: &str| score_as_json(&sandbox, image)["notes"].to_string();
    assert_contains(&notes("grey.exr"), &[note]);
    copy_without(&sandbox, "coverage", "grey.exr", "bare.exr");
    assert!(!notes("bare.exr").contains("mattes"));
}

#[test]
fn colours_without_mattes_get_only_the_scores_of_colour() {
    let sandbox = set_up();
    let expected = read_scores(&sandbox);
    copy_without(&sandbox, "coverage", OUTPUT, "mine.exr");
    let actual = scores(&sandbox, &format!("mine.exr {LADDER}"));
    for metric in Metric::all() {
        if of_colour(&metric) {
            assert_eq!(actual.get(metric), expected.get(metric), "{metric}");
        } else {
            assert_eq!(actual.get(metric).value(), None, "{metric}");
        }
    }
    let text = score(&sandbox, "mine.exr");
    let line = |part: &str| {
        let mut lines = text.lines();
        let reason = lines.find(|line| line.starts_with("not available: ") && line.contains(part));
        reason.unwrap_or_else(|| panic!("\"{part}\" is no reason in:\n{text}"))
    };
    let mattes = line("the picture has no mattes, channels coverage.<object>");
    for metric in Metric::all() {
        // The plate is the only object, so nothing still can be contaminated.
        let is_probe = matches!(metric, Metric::Probe(_));
        let due = !of_colour(&metric) && metric != Metric::OccluderContamination && !is_probe;
        let listed = mattes.contains(&format!(" {metric}")); // each follows a blank
        assert!(!due || listed, "{metric} is not listed in: {mattes}");
    }
    line("n_eq, n_eq_flip: no ladder of accumulations was given; give one with --ladder");
}

#[test]
fn a_png_is_converted_back_to_radiance() {
    // The plate's radiance is up to 0.7. One exposure shows half of it, the other twice, which
    // exceeds display white.
    for (stops, bright) in [("-1", false), ("1", true)] {
        let sandbox = Sandbox::new();
        let display = format!("[display]\nstops = {stops}.0\n[background]");
        sandbox.write("scene.toml", &SCENE.replace("[background]", &display));
        sandbox.measure(FINE);
        let expected = read_scores(&sandbox);
        let png = OUTPUT.replace(".exr", ".png");
        let actual = scores(&sandbox, &format!("{png} {LADDER}"));
        let [flip, due] = [&actual, &expected].map(|scores| scores.moving.flip.value().unwrap());
        // Steps of 1/255 in sRGB are small beside the blur's error. A forgotten stop is not: the
        // picture becomes half or twice as bright.
        assert!((flip - due).abs() < 0.004, "{flip} {due}");
        assert_eq!(actual.full.flip_hdr.value(), None);
        let text = score(&sandbox, &png);
        let undone = format!("display exposure of {stops} stops undone");
        assert_contains(&text, &[&undone]);
        let exceeds = "display white, which the truth exceeds in";
        assert_eq!(text.contains(exceeds), bright, "{text}");
        // PSNR agrees as closely, in decibels.
        let [psnr, due] = [&actual, &expected].map(|scores| scores.moving.psnr.value().unwrap());
        assert!(bright || (psnr - due).abs() < 0.1, "{psnr} {due}");
    }
}

#[test]
fn a_guard_band_is_cropped_from_the_picture() {
    let sandbox = Sandbox::new();
    sandbox.measure(&format!("{FINE} --guard-band 8"));
    let expected = read_scores(&sandbox);
    let blur = "engine blur --filter velocity_gather:fine --out b.exr --frame";
    sandbox.done(&format!("{blur} {FRAME}"));
    let actual = scores(&sandbox, "b.exr");
    assert_eq!(actual.moving, expected.moving);
    assert_eq!(actual.full, expected.full);
    let note = "cropped by the frame's guard band of 8 pixels";
    assert_contains(&score(&sandbox, "b.exr"), &[note]);
}

/// Words of `score`, and parts of the message.
const OTHER_RENDERS: [(&str, &[&str]); 8] = [
    (
        "--image b.exr --frame out/plate/frame.exr --truth out/plate/truth_centred.exr",
        &["b.exr: was made for the shutter alignment trailing, the truth has centred"],
    ),
    (
        "--image b.exr --frame out/plate/frame.exr --truth short/plate/truth_trailing.exr",
        &["b.exr: was made for an exposure of 0.5, the truth has 0.25"],
    ),
    (
        "--image b.exr --frame short/plate/frame.exr --truth out/plate/truth_trailing.exr",
        &["the frame's exposure has 0.25, the truth has 0.5"],
    ),
    (
        "--image b.exr --frame out/plate/frame.exr --truth small/plate/truth_trailing.exr",
        &["b.exr: has 64x32 pixels, the truth has 32x16"],
    ),
    (
        "--image b.exr --frame out/other/frame.exr --truth out/plate/truth_trailing.exr",
        &["out/other/frame.exr: was rendered from the scene other, the truth from plate"],
    ),
    (
        "--image b.exr --frame out/plate/frame.exr --truth out/plate/frame.exr",
        &["frame.exr: is a frame; a truth is needed"],
    ),
    (
        "--image b.exr --frame b.exr --truth out/plate/truth_trailing.exr",
        &["b.exr: is a output; a frame is needed"],
    ),
    (
        "--image short.exr --frame out/plate/frame.exr --truth out/plate/truth_trailing.exr",
        &["short.exr: was made for an exposure of 0.25, the truth has 0.5"],
    ),
];

#[test]
fn mismatched_files_are_refused() {
    let sandbox = Sandbox::new();
    let render = |more: &str| {
        let words = "truths render --quiet --samples-per-pixel 16 --out";
        sandbox.done(&format!("{words} {more}"));
    };
    render("out --alignments trailing,centred");
    render("short --exposure 0.25");
    render("small --size 32x16");
    fs::rename(sandbox.path("scenes/plate"), sandbox.path("scenes/other")).unwrap();
    render("out");
    let blur = |more: &str| {
        let words = "engine blur --filter velocity_gather --frame";
        sandbox.done(&format!("{words} {FRAME} --out {more}"));
    };
    blur("b.exr");
    blur("short.exr --exposure 0.25");
    sandbox.refuse_each("score", &OTHER_RENDERS);
}

/// Pictures to score, and parts of the message.
const BAD_PICTURES: [(&str, &[&str]); 8] = [
    ("nowhere.exr", &["nowhere.exr", "cannot read"]),
    ("nowhere.png", &["nowhere.png", "cannot read"]),
    (
        "scenes/plate/plate.obj",
        &[
            "plate.obj",
            "allowed: a name that ends with .exr, .hdr, .png, .jpg or .jpeg",
        ],
    ),
    ("no.png", &["no.png", "not a PNG that can be read"]),
    ("no.exr", &["no.exr", "not a complete OpenEXR file"]),
    (
        "odd.png",
        &["odd.png", "has 5x4 pixels, the truth has 64x32"],
    ),
    (
        "part.exr",
        &["part.exr", r#"lacks the channel "coverage.plate""#],
    ),
    ("nan.exr", &["nan.exr", "NaN at pixel (9, 3)"]),
];

#[test]
fn bad_pictures_are_refused_with_their_name() {
    let sandbox = set_up();
    for copy in ["no.png", "no.exr"] {
        sandbox.put(copy, "no picture");
    }
    write_png(&sandbox.path("odd.png"), &Raster::filled(5, 4, [0.5; 3])).unwrap();
    copy_without(&sandbox, "coverage.plate", OUTPUT, "part.exr");
    let mut file = ExrFile::new(64, 32);
    let mut pixels = Raster::filled(64, 32, [0.5; 3]);
    pixels.pixels[3 * 64 + 9] = [f32::NAN; 3];
    file.push_color("", &pixels);
    write_exr(&sandbox.path("nan.exr"), &file).unwrap();
    sandbox.refuse_each(&words(""), &BAD_PICTURES);
    // A truth of an older version.
    copy_without(&sandbox, "support.", TRUTH, "old.exr");
    let parts = [
        "old.exr: holds no support",
        "make it anew with `shuttertruth truths render`",
    ];
    sandbox.refuse(&words(OUTPUT).replace(TRUTH, "old.exr"), &parts);
}

#[test]
fn the_truth_has_no_error_as_exr_and_rounding_errors_as_png() {
    let sandbox = set_up();
    let truth = Truth::read(&sandbox.path(TRUTH)).unwrap();
    let stops = Frame::read(&sandbox.path(FRAME)).unwrap().display.stops;
    let shown = display_srgb(&truth.mean().color, stops);
    write_png(&sandbox.path("truth.png"), &shown).unwrap();
    assert_eq!(scores(&sandbox, TRUTH).full.flip.value(), Some(0.0));
    let rounded = scores(&sandbox, "truth.png");
    let flip = rounded.moving.flip.value().unwrap();
    // FLIP amplifies small differences: half a step of 1/255 over a whole area gives up to a few
    // hundredths.
    assert!(0.0 < flip && flip < 0.03, "{flip}");
    let said = format!("as a PNG of 8 bits, would have a flip_moving of {flip:.3}");
    assert_contains(&score(&sandbox, "truth.png"), &[&said]);
}
