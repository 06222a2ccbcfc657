//! `run --noise`: as many samples as the noisiest scene takes.

use frame::Truth;
use measure::deciding_floor;

use crate::sandbox::{IDENTITY, Sandbox, assert_refused, split, stderr};

/// Measures the identity on the plate, with more words; returns what the program said.
fn run(sandbox: &Sandbox, more: &str) -> String {
    let words = ["run", "--size", "32x16", "--jitter-frames", "0"];
    let more: Vec<&str> = split(more);
    let output = sandbox.shuttertruth(&[&words[..], &IDENTITY, &more].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    stderr(&output)
}

/// Reads how many samples the last run had.
fn samples(sandbox: &Sandbox) -> u32 {
    sandbox.read_run().render.samples_per_pixel
}

#[test]
fn a_scene_of_one_s_own_has_the_samples_that_its_noise_takes() {
    let sandbox = Sandbox::new();
    let said = run(&sandbox, "");
    let usual = samples(&sandbox);
    let line = format!("{usual} samples per pixel bring the noise of plate to about 0.005");
    assert!(said.contains(&line), "{said}");
    // The number is kept beside the frame, and another noise takes another one.
    let written = sandbox.written("out/plate/samples.json");
    run(&sandbox, "");
    assert_eq!(sandbox.written("out/plate/samples.json"), written);
    run(&sandbox, "--noise 0.001 --out finer");
    let finer = sandbox.read_json::<measure::Run>("finer/run.json");
    assert!(finer.render.samples_per_pixel > usual);
    let truth = Truth::read(&sandbox.path("finer/plate/truth_trailing.exr")).unwrap();
    let (_, floor) = deciding_floor(&truth);
    assert!(floor < 0.0012, "{floor}");
}

#[test]
fn a_number_of_samples_is_left_as_it_is() {
    let sandbox = Sandbox::new();
    let said = run(&sandbox, "--samples-per-pixel 16");
    assert!(!said.contains("bring the noise"), "{said}");
    assert_eq!(samples(&sandbox), 16);
}

#[test]
fn a_noise_that_no_samples_reach_and_two_wishes_are_refused() {
    let sandbox = Sandbox::new();
    let words = split("run --size 32x16 --filters identity --noise 1e-9");
    let refused = sandbox.shuttertruth(&words);
    assert_refused(
        &refused,
        4,
        &[
            "plate: a noise of 1e-9 takes more than 65536 samples",
            "--noise",
        ],
    );
    assert!(!sandbox.path("out/run.json").exists());
    let both = "run --noise 0.01 --samples-per-pixel 16";
    sandbox.refuse(both, &["--noise", "--samples-per-pixel"]);
    sandbox.refuse("run --noise 0", &["--noise", "0"]);
}
