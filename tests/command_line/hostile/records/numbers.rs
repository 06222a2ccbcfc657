//! Numbers that are too large to render, compare or keep.

use std::fs;

use crate::sandbox::{SCENE, Sandbox, assert_refused, split};

#[test]
fn numbers_out_of_range_are_refused_with_the_allowed_range() {
    let sandbox = Sandbox::new();
    for (words, parts) in [
        (
            "run --replicates 0",
            &["'0' for '--replicates <N>'", "even numbers from 2 to 4096"][..],
        ),
        ("run --replicates 7", &["'7'", "even numbers"]),
        ("run --replicates 4000000000", &["'4000000000'", "4096"]),
        (
            "truths render --replicates 0..4000000000",
            &["0..4000000000", "up to 4096"],
        ),
        (
            "truths render --noise 1e-9 --most-replicates 4000000000",
            &["--most-replicates", "is not in 0..=4096"],
        ),
        (
            "run --samples-per-pixel 4000000000",
            &["--samples-per-pixel", "up to 65536", "such as 65536"],
        ),
        ("run --samples-per-pixel 4294967288", &["up to 65536"]),
        (
            "run --exposure 1e50",
            &["exposure is 1e50 frames", "allowed: 1e-9 to 10000"],
        ),
        ("run --exposure 1e-300", &["exposure is 1e-300 frames"]),
        (
            "run --jitter-frames 4000000000",
            &["--jitter-frames", "is not in 0..=1024"],
        ),
        (
            "limits calibrate --seed 18446744073709551615",
            &["--seed 18446744073709551615", "allowed: up to"],
        ),
        ("run --seed 18446744073709551616", &["--seed"]),
        (
            "tune search --filter jump_flood --budget 10000000000000",
            &["--budget", "is not in 1..=1000000"],
        ),
        (
            "tune sensitivity --filter jump_flood --rows 10000000000000",
            &["--rows", "is not in 2..=1000000"],
        ),
    ] {
        let mut line = split(words);
        line.extend(["--quiet", "--out", "out"]);
        assert_refused(&sandbox.shuttertruth(&line), 2, parts);
        assert!(
            !sandbox.path("out").exists(),
            "{words} left something behind"
        );
    }
    let import = split("engine import scenes/plate/plate.obj --out mine --spin 1e300deg/frame");
    assert_refused(
        &sandbox.shuttertruth(&import),
        2,
        &["from -100000 to 100000", "20deg/frame"],
    );
}

#[test]
fn every_command_refuses_a_scene_whose_exposures_show_nothing() {
    let sandbox = Sandbox::new();
    for (display, parts) in [
        (
            "stops = 150",
            &["scene.toml:7: stops = 150", "from -32 to 32"][..],
        ),
        (
            "flip = { start = -2, stop = 300, count = 5 }",
            &["scene.toml:7: flip stop = 300", "from -32 to 32"],
        ),
        (
            "flip = { start = -2, stop = 2, count = 400 }",
            &["scene.toml:7: flip has 400 exposures", "2 to 128"],
        ),
    ] {
        let table = format!("[display]\n{display}\n\n[camera]");
        sandbox.write("scene.toml", &SCENE.replace("[camera]", &table));
        for command in ["run", "truths render"] {
            let words = split(command)
                .into_iter()
                .chain(["--quiet", "--out", "out"]);
            assert_refused(&sandbox.shuttertruth(&words.collect::<Vec<_>>()), 2, parts);
        }
    }
}

#[test]
fn a_reason_of_two_lines_is_refused() {
    let sandbox = Sandbox::new();
    fs::write(
        sandbox.path("scenes/bounds.toml"),
        "[default]\nflip_moving = { limit = 0.2, why = \"one\\n::error::two\" }\n",
    )
    .unwrap();
    let output = sandbox.check(&["--filters", "identity"]);
    assert_refused(
        &output,
        2,
        &[
            "bounds.toml:2",
            "flip_moving: why = \"one\\n::error::two\"",
            "one line",
        ],
    );
}
