//! `blur --frames` and `score --frames`: sequences of a filter that runs elsewhere.

use std::fs;

use frame::{display_srgb, write_png};
use metrics::{SequenceMetric, SequenceScores};
use tests::text::assert_contains;

use crate::sandbox::{SCENE, Sandbox, assert_done, stdout};

const BLUR: &str = "engine blur --filter ./late --frame out/plate/frame.exr --frames 3 --out";
const TRUTH: [&str; 2] = ["--truth", "out/plate/truth_trailing.exr"];
const FRAME: [&str; 2] = ["--frame", "out/plate/frame.exr"];
const THREE: [&str; 2] = ["--frames", "3"];

/// Makes a sandbox with a filter that depends on the previous frame and on the frame's number, and
/// runs it on three frames.
fn run_filter() -> Sandbox {
    let sandbox = Sandbox::new();
    let body = "let before = textureLoad(color_before, pixel, 0).rgb;
    let now = textureLoad(color, pixel, 0).rgb;
    let noise = fract(0.618 * f32(frame.frame_index) + 0.1 * f32(pixel.x));
    textureStore(output, pixel, vec4<f32>(mix(before, now, 0.5 + 0.2 * noise), 1.0));";
    let history = "history = [\"color\"]";
    sandbox.write_kernel("late", history, &["color_before"], body);
    sandbox.measure("--filter ./late --fps 24 --frames 3");
    sandbox
}

fn score(sandbox: &Sandbox, images: &str, more: &[&str]) -> std::process::Output {
    let words = [&["score", "--image", images][..], &TRUTH, &FRAME, more];
    sandbox.shuttertruth(&words.concat())
}

fn scores(sandbox: &Sandbox, images: &str, more: &[&str]) -> SequenceScores {
    let output = score(sandbox, images, &[&THREE[..], &["--json"], more].concat());
    assert_done(&output);
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["scene"], "plate");
    assert_eq!(json["alignment"], "trailing");
    assert_eq!(json["frames"].as_array().unwrap().len(), 3);
    serde_json::from_value(json["scores"].clone()).unwrap()
}

#[test]
fn blur_and_score_repeat_the_sequence_of_a_run() {
    let sandbox = run_filter();
    sandbox.done(&format!("{BLUR} mine"));
    let pictures = ["mine/0000.exr", "mine/0001.exr", "mine/0002.exr"];
    for (picture, folder) in pictures.iter().zip(["plate", "plate/0001", "plate/0002"]) {
        let expected = sandbox.read_color(&format!("out/{folder}/late_default/output.exr"));
        let actual = sandbox.read_color(picture);
        assert!(actual == expected, "{picture}: bit for bit");
    }
    let run = sandbox.read_run();
    let sequence = run
        .sequences
        .iter()
        .find(|sequence| !sequence.is_reference)
        .unwrap();
    let same = scores(&sandbox, "mine", &["--fps", "24"]);
    assert_eq!(same, sequence.scores, "bit for bit");
    // Only JOD depends on the rate.
    let slow = scores(&sandbox, "mine", &[]);
    for metric in SequenceMetric::ALL {
        let is_same = slow.get(metric) == sequence.scores.get(metric);
        assert_eq!(is_same, !metric.depends_on_rate(), "{metric:?}");
    }
    let text = stdout(&score(&sandbox, "mine", &THREE));
    let truth = "truth: trailing shutter, open for 0.5 frames";
    assert_contains(
        &text,
        &["3 frames", "flick", "mine", truth, "worst frames: "],
    );

    // Another order of the frames has other scores over time.
    let [first, last] = ["mine/0000.exr", "mine/0002.exr"].map(|name| sandbox.path(name));
    fs::rename(&first, sandbox.path("kept.exr")).unwrap();
    fs::rename(&last, &first).unwrap();
    fs::rename(sandbox.path("kept.exr"), &last).unwrap();
    let swapped = scores(&sandbox, "mine", &[]);
    assert!(swapped.flicker.value() > slow.flicker.value());

    // Engines write PNGs. A plate of up to 0.7 of white loses little to 8 bits.
    fs::create_dir(sandbox.path("shown")).unwrap();
    for (at, folder) in ["plate", "plate/0001", "plate/0002"].iter().enumerate() {
        let color = sandbox.read_color(&format!("out/{folder}/late_default/output.exr"));
        let path = sandbox.path(&format!("shown/{at:04}.png"));
        write_png(&path, &display_srgb(&color, 0.0)).unwrap();
    }
    let shown = scores(&sandbox, "shown", &[]);
    let ratio = shown.flicker.value().unwrap() / slow.flicker.value().unwrap();
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
    assert_misfits_are_refused(&sandbox);
}

/// More words of `score`, and parts of the message.
const MISFITS: [(&str, &[&str]); 3] = [
    ("--frames 4", &["mine/0003.exr", "numbered from 0000"]),
    (
        "--frames 3 --ladder out/plate/ladder_trailing",
        &["--ladder", "cannot be used with", "--frames"],
    ),
    (
        "--frames 3 --scenes-dir elsewhere",
        &["truth_trailing.exr: is of the scene plate", "--scenes-dir"],
    ),
];

/// Checks that mismatched sequences are refused.
fn assert_misfits_are_refused(sandbox: &Sandbox) {
    let parts = "--out: mine.exr is the name of one picture, and 3 are written";
    sandbox.refuse(&format!("{BLUR} mine.exr"), &[parts]);
    let refuse = |words: &str, at: &str, parts: &[&str]| {
        let files =
            format!("--truth out/plate{at}/truth_trailing.exr --frame out/plate{at}/frame.exr");
        sandbox.refuse(&format!("score {files} --image {words}"), parts);
    };
    for (words, parts) in MISFITS {
        refuse(&format!("mine {words}"), "", parts);
    }
    let parts = ["is no folder", "0001.exr"];
    refuse("mine/0000.exr --frames 3", "", &parts);
    let parts = "0001/truth_trailing.exr: is the truth of a later frame, plate/0001";
    refuse("mine --frames 2", "/0001", &[parts]);
    let [png, copy] = ["out/plate/frame.png", "mine/0001.png"].map(|name| sandbox.path(name));
    fs::copy(png, &copy).unwrap();
    let parts = ["mine/0001.exr and mine/0001.png", "remove one of them"];
    refuse("mine --frames 3", "", &parts);
    fs::remove_file(copy).unwrap();
    sandbox.write("scene.toml", &SCENE.replace("-1.6", "-1.5"));
    let parts = [
        "truth_trailing.exr: was rendered from other files of the scene plate",
        "render frames and truths again",
    ];
    refuse("mine --frames 3", "", &parts);
}
