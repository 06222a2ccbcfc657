//! `score`: finished pictures without a filter.

use std::fs;

use frame::{ExrFile, Frame, Raster, Truth, display_srgb, read_exr, write_exr, write_png};
use metrics::{EquivalentMetric, Metric, ProbeScores, Scores, SkillMetric};

use crate::sandbox::{SCENE, Sandbox, assert_done, assert_refused, stdout};

const TRUTH: [&str; 2] = ["--truth", "out/plate/truth_trailing.exr"];
const FRAME: [&str; 2] = ["--frame", "out/plate/frame.exr"];
const LADDER: [&str; 2] = ["--ladder", "out/plate/ladder_trailing"];
const OUTPUT: &str = "out/plate/velocity_gather_fine/output.exr";

fn score(sandbox: &Sandbox, image: &str, more: &[&str]) -> std::process::Output {
    let words = [&["score", "--image", image][..], &TRUTH, &FRAME, more];
    sandbox.shuttertruth(&words.concat())
}

fn scores(sandbox: &Sandbox, image: &str, more: &[&str]) -> Scores {
    let output = score(sandbox, image, &[more, &["--json"]].concat());
    assert_done(&output);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["scene"], "plate");
    assert_eq!(json["alignment"], "trailing");
    serde_json::from_value(json["scores"].clone()).unwrap()
}

/// Runs one filter on the plate. Returns its scores without those of probes, which a picture cannot have.
fn run(sandbox: &Sandbox, more: &[&str]) -> Scores {
    assert_done(&sandbox.run(&[&["--filters", "velocity_gather:fine"], more].concat()));
    let mut scores = sandbox.read_filter_cases()[0].scores.clone();
    scores.probes = ProbeScores::not_applicable("no probes were run through the filter");
    scores
}

/// Writes only the colours of an OpenEXR file.
fn without_mattes(sandbox: &Sandbox, from: &str, to: &str) {
    let mut file = read_exr(&sandbox.path(from)).unwrap();
    file.channels
        .retain(|channel| !channel.name.starts_with("coverage"));
    file.attributes.clear();
    write_exr(&sandbox.path(to), &file).unwrap();
}

/// Returns whether a metric is about colours, and so applies to any picture.
fn of_colour(metric: &Metric) -> bool {
    matches!(
        metric,
        Metric::Image(..)
            | Metric::StaticContamination
            | Metric::Frozen(_)
            | Metric::Skill(SkillMetric::Mse | SkillMetric::Flip)
            | Metric::Equivalent(EquivalentMetric::Mse | EquivalentMetric::Flip)
    )
}

#[test]
fn score_repeats_the_scores_of_a_run() {
    let sandbox = Sandbox::new();
    let expected = run(&sandbox, &[]);
    assert_eq!(scores(&sandbox, OUTPUT, &LADDER), expected);
    let output = score(&sandbox, OUTPUT, &LADDER);
    assert_done(&output);
    assert!(
        stdout(&output).contains("truth: trailing shutter, open for 0.5 frames"),
        "{}",
        stdout(&output)
    );
    let text = stdout(&output);
    assert!(!text.contains("has no mattes"), "{text}");
}

#[test]
fn mattes_that_a_file_gives_are_said_to_be_given() {
    let sandbox = Sandbox::new();
    run(&sandbox, &[]);
    // A grey picture with the truth's own mattes.
    let mut file = read_exr(&sandbox.path(TRUTH[1])).unwrap();
    file.attributes.clear();
    let grey = file.color("").unwrap().map(|_| [0.3; 3]);
    file.channels
        .retain(|channel| channel.name.starts_with("coverage."));
    file.push_color("", &grey);
    write_exr(&sandbox.path("grey.exr"), &file).unwrap();
    assert_eq!(
        scores(&sandbox, "grey.exr", &[])
            .get("label_tv".parse().unwrap())
            .value(),
        Some(0.0)
    );
    let note = "grey.exr: its mattes, channels coverage.<object>, were given with the picture and not measured";
    let text = stdout(&score(&sandbox, "grey.exr", &[]));
    assert!(text.contains(note), "{text}");
    let notes = |image: &str| {
        let output = score(&sandbox, image, &["--json"]);
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        json["notes"].to_string()
    };
    assert!(notes("grey.exr").contains("given with the picture and not measured"));
    without_mattes(&sandbox, "grey.exr", "bare.exr");
    assert!(!notes("bare.exr").contains("mattes"));
}

#[test]
fn colours_without_mattes_get_only_the_scores_of_colour() {
    let sandbox = Sandbox::new();
    let expected = run(&sandbox, &[]);
    without_mattes(&sandbox, OUTPUT, "mine.exr");
    let found = scores(&sandbox, "mine.exr", &LADDER);
    for metric in Metric::all() {
        if of_colour(&metric) {
            assert_eq!(found.get(metric), expected.get(metric), "{metric}");
        } else {
            assert_eq!(found.get(metric).value(), None, "{metric}");
        }
    }
    let text = stdout(&score(&sandbox, "mine.exr", &[]));
    let line = |part: &str| {
        let mut lines = text.lines();
        let found = lines.find(|line| line.starts_with("not available: ") && line.contains(part));
        found.unwrap_or_else(|| panic!("\"{part}\" is no reason in:\n{text}"))
    };
    let mattes = line("the picture has no mattes, channels coverage.<object>");
    for metric in Metric::all() {
        // The plate is the only object, so that nothing still can be contaminated.
        let due = !of_colour(&metric)
            && metric != Metric::OccluderContamination
            && !matches!(metric, Metric::Probe(_));
        let listed = mattes.contains(&format!(" {metric}")); // each follows a blank
        assert!(!due || listed, "{metric} is not listed in: {mattes}");
    }
    line("n_eq, n_eq_flip: no ladder of accumulations was given; give one with --ladder");
}

#[test]
fn a_png_is_converted_back_to_radiance() {
    // The plate's radiance is up to 0.7. One exposure shows half of it, the other twice, which exceeds display white.
    for (stops, bright) in [("-1.0", false), ("1.0", true)] {
        let sandbox = Sandbox::new();
        let display = format!("[display]\nstops = {stops}\n[background]");
        sandbox.write("scene.toml", &SCENE.replace("[background]", &display));
        let expected = run(&sandbox, &[]);
        let png = OUTPUT.replace(".exr", ".png");
        let found = scores(&sandbox, &png, &LADDER);
        let flip = |scores: &Scores| scores.moving.flip.value().unwrap();
        // Steps of 1/255 in sRGB are small beside the blur's error. A forgotten stop is not: the whole picture becomes
        // half or twice as bright.
        assert!(
            (flip(&found) - flip(&expected)).abs() < 0.004,
            "{} {}",
            flip(&found),
            flip(&expected)
        );
        assert_eq!(found.full.flip_hdr.value(), None);
        let psnr = |scores: &Scores| scores.moving.psnr.value().unwrap();
        let text = stdout(&score(&sandbox, &png, &[]));
        let undone = format!(
            "display exposure of {} stops undone",
            &stops[..stops.len() - 2]
        );
        assert!(text.contains(&undone), "{text}");
        assert_eq!(
            text.contains("display white, which the truth exceeds in"),
            bright,
            "{text}"
        );
        if !bright {
            // The same, in decibels.
            assert!((psnr(&found) - psnr(&expected)).abs() < 0.1);
        }
    }
}

#[test]
fn a_guard_band_is_cropped_from_the_picture() {
    let sandbox = Sandbox::new();
    let expected = run(&sandbox, &["--guard-band", "8"]);
    let words = [
        "engine",
        "blur",
        "--filter",
        "velocity_gather:fine",
        "--out",
        "b.exr",
    ];
    sandbox.execute(&[&words[..], &FRAME].concat());
    let found = scores(&sandbox, "b.exr", &[]);
    assert_eq!(found.moving, expected.moving);
    assert_eq!(found.full, expected.full);
    let text = stdout(&score(&sandbox, "b.exr", &[]));
    assert!(
        text.contains("cropped by the frame's guard band of 8 pixels"),
        "{text}"
    );
}

#[test]
fn mismatched_files_are_refused() {
    let sandbox = Sandbox::new();
    let words = ["--quiet", "--samples-per-pixel", "16", "--out"];
    let render = |more: &[&str]| {
        sandbox.execute(&[&["truths", "render"][..], &words, more].concat());
    };
    render(&["out", "--alignments", "trailing,centred"]);
    render(&["short", "--exposure", "0.25"]);
    render(&["small", "--size", "32x16"]);
    fs::rename(sandbox.path("scenes/plate"), sandbox.path("scenes/other")).unwrap();
    render(&["out"]);
    let blur = |more: &[&str]| {
        let words = [
            "engine",
            "blur",
            "--filter",
            "velocity_gather",
            "--out",
            "b.exr",
        ];
        sandbox.execute(&[&words[..], &FRAME, more].concat());
    };
    let refused = |words: [&str; 6], parts: &[&str]| {
        assert_refused(
            &sandbox.shuttertruth(&[&["score"], &words[..]].concat()),
            2,
            parts,
        );
    };
    let image = ["--image", "b.exr"];
    let with = |truth: &'static str, frame: &'static str| {
        ["--truth", truth, "--frame", frame, image[0], image[1]]
    };
    let (trailing, frame) = (TRUTH[1], FRAME[1]);
    blur(&[]);
    refused(
        with("out/plate/truth_centred.exr", frame),
        &["b.exr: was made for the shutter alignment trailing, the truth has centred"],
    );
    refused(
        with("short/plate/truth_trailing.exr", frame),
        &["b.exr: was made for an exposure of 0.5, the truth has 0.25"],
    );
    refused(
        with(trailing, "short/plate/frame.exr"),
        &["the frame's exposure has 0.25, the truth has 0.5"],
    );
    refused(
        with("small/plate/truth_trailing.exr", frame),
        &["b.exr: has 64x32 pixels, the truth has 32x16"],
    );
    refused(
        with(trailing, "out/other/frame.exr"),
        &["out/other/frame.exr: was rendered from the scene other, the truth from plate"],
    );
    refused(
        with(frame, frame),
        &["frame.exr: is a frame; a truth is needed"],
    );
    refused(
        with(trailing, "b.exr"),
        &["b.exr: is a output; a frame is needed"],
    );
    blur(&["--exposure", "0.25"]);
    refused(
        with(trailing, frame),
        &["b.exr: was made for an exposure of 0.25, the truth has 0.5"],
    );
}

#[test]
fn bad_pictures_are_refused_with_their_name() {
    let sandbox = Sandbox::new();
    run(&sandbox, &[]);
    let refused = |image: &str, parts: &[&str]| {
        assert_refused(&score(&sandbox, image, &[]), 2, &[&[image], parts].concat());
    };
    refused("nowhere.exr", &["cannot read"]);
    refused("nowhere.png", &["cannot read"]);
    refused(
        "scenes/plate/plate.obj",
        &["allowed: a name that ends with .exr or .png"],
    );
    fs::copy(
        sandbox.path("scenes/plate/plate.obj"),
        sandbox.path("no.png"),
    )
    .unwrap();
    refused("no.png", &["not a PNG that can be read"]);
    fs::copy(sandbox.path("no.png"), sandbox.path("no.exr")).unwrap();
    refused("no.exr", &["not a complete OpenEXR file"]);
    write_png(&sandbox.path("odd.png"), &Raster::filled(5, 4, [0.5; 3])).unwrap();
    refused("odd.png", &["has 5x4 pixels, the truth has 64x32"]);

    let mut file = read_exr(&sandbox.path(OUTPUT)).unwrap();
    file.channels
        .retain(|channel| channel.name != "coverage.plate");
    write_exr(&sandbox.path("part.exr"), &file).unwrap();
    refused("part.exr", &["lacks the channel \"coverage.plate\""]);
    let mut file = ExrFile::new(64, 32);
    let pixels = Raster::from_fn(64, 32, |x, y| {
        [if (x, y) == (9, 3) { f32::NAN } else { 0.5 }; 3]
    });
    file.push_color("", &pixels);
    write_exr(&sandbox.path("nan.exr"), &file).unwrap();
    refused("nan.exr", &["NaN at pixel (9, 3)"]);
}

#[test]
fn a_truth_of_an_older_version_is_refused_with_the_way_out() {
    let sandbox = Sandbox::new();
    run(&sandbox, &[]);
    let mut file = read_exr(&sandbox.path(TRUTH[1])).unwrap();
    (file.channels).retain(|channel| !channel.name.starts_with("support."));
    write_exr(&sandbox.path("old.exr"), &file).unwrap();
    let words = [
        &["score", "--image", OUTPUT, "--truth", "old.exr"][..],
        &FRAME,
    ];
    assert_refused(
        &sandbox.shuttertruth(&words.concat()),
        2,
        &[
            "old.exr: holds no support",
            "make it anew with `shuttertruth truths render`",
        ],
    );
}

#[test]
fn the_truth_has_no_error_as_exr_and_rounding_errors_as_png() {
    let sandbox = Sandbox::new();
    run(&sandbox, &[]);
    let truth = Truth::read(&sandbox.path(TRUTH[1])).unwrap();
    let stops = Frame::read(&sandbox.path(FRAME[1])).unwrap().display.stops;
    let shown = display_srgb(&truth.mean().color, stops);
    write_png(&sandbox.path("truth.png"), &shown).unwrap();
    let exact = scores(&sandbox, TRUTH[1], &[]);
    assert_eq!(exact.full.flip.value(), Some(0.0));
    let rounded = scores(&sandbox, "truth.png", &[]);
    let flip = rounded.moving.flip.value().unwrap();
    // FLIP amplifies small differences: half a step of 1/255 over a whole area gives up to a few hundredths.
    assert!(0.0 < flip && flip < 0.03, "{flip}");
    let text = stdout(&score(&sandbox, "truth.png", &[]));
    let said = format!("as a PNG of 8 bits, would have a flip_moving of {flip:.3}");
    assert!(text.contains(&said), "{said} is missing from:\n{text}");
}
