//! Kinds of frames that filters can get.

use tests::text::read_rows;

use crate::sandbox::{IDENTITY, Sandbox, assert_done, assert_refused, split};

/// Model of two colours that meet two pixels beyond the right border, where the plate moves to.
const TWO_COLOURS: &str = include_str!("../fixtures/models/two_colours.obj");
const PAINTS: &str = include_str!("../fixtures/models/two_colours.mtl");

fn measure(sandbox: &Sandbox, more: &[&str]) -> suite::Run {
    let words = ["--filters", "velocity_gather:fine"];
    assert_done(&sandbox.run(&[&words, more].concat()));
    sandbox.read_run()
}

/// Returns the filter's squared error over the whole picture.
fn error(run: &suite::Run) -> f64 {
    let filter = run.cases.iter().find(|case| !case.is_reference).unwrap();
    let json = serde_json::to_value(&filter.scores).unwrap();
    json["full"]["mse"]["value"]
        .as_f64()
        .unwrap_or_else(|| panic!("{json:#}"))
}

#[test]
fn a_guard_band_removes_the_error_at_the_border() {
    let sandbox = Sandbox::new();
    sandbox.write("plate.obj", TWO_COLOURS);
    sandbox.write("plate.mtl", PAINTS);
    let bare = measure(&sandbox, &[]);
    let padded = measure(&sandbox, &["--guard-band", "8"]);
    assert_eq!((bare.render.guard_band, padded.render.guard_band), (0, 8));
    assert!(
        error(&padded) < 0.9 * error(&bare),
        "{} with a band, {} without",
        error(&padded),
        error(&bare)
    );
}

#[test]
fn a_run_records_the_kind_of_its_frames() {
    let sandbox = Sandbox::new();
    let words = split("--velocity camera_only --frame-sampling point --sky-velocity off");
    let run = measure(&sandbox, &words);
    let json = serde_json::to_value(&run).unwrap();
    assert_eq!(
        ["velocity", "color", "sky_velocity"].map(|key| json[key].to_string()),
        ["\"camera_only\"", "\"point\"", "false"]
    );
    let other = measure(&sandbox, &[]);
    assert_ne!(
        error(&run),
        error(&other),
        "the plate's own motion is lost to the camera alone"
    );
}

#[test]
fn bad_kinds_of_frames_are_refused() {
    let sandbox = Sandbox::new();
    for (words, parts) in read_rows(
        "
        --frame-sampling sharp => sharp | antialiased, point
        --color point => --color | auto, always, never
        --sky-velocity maybe => maybe | off
        --guard-band wide => --guard-band | wide
        --guard-band 99999 => 200062x200030 | 16384",
    ) {
        let refused = sandbox.run(&[&IDENTITY[..], &split(words)].concat());
        assert_refused(&refused, 2, &parts);
    }
}

#[test]
fn a_sealed_scene_has_another_truth_and_not_the_limits_of_its_scene() {
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.0001);
    let run = |more: &[&str]| {
        let run = measure(&sandbox, more);
        let case = run.cases.iter().find(|case| !case.is_reference).unwrap();
        (case.scene.clone(), case.truth_hash.clone(), error(&run))
    };
    let plain = run(&[]);
    let sealed = run(&["--seal", "7"]);
    assert_eq!(sealed, run(&["--scenes", "plate@seal7"]));
    assert_eq!(sealed.0, "plate@seal7");
    assert_ne!(sealed.1, plain.1);
    let refuse = |words: &str, says: &str| {
        let refused = sandbox.check(&[&IDENTITY[..], &split(words)].concat());
        assert_refused(&refused, 2, &[says]);
    };
    let says = "plate@seal7 / identity:default: has no bound";
    refuse("--seal 7", says);
    let says = "--seal: plate@fast is a variant; allowed: scenes in their default variant";
    refuse("--seal 7 --scenes plate@fast", says);
}
