//! Kinds of frames that filters can get.

use measure::{Case, Run};

use crate::sandbox::{IDENTITY, Sandbox, assert_refused, split};

/// Model of two colours that meet two pixels beyond the right border, where the plate moves to.
const TWO_COLOURS: &str = include_str!("../fixtures/models/two_colours.obj");
const PAINTS: &str = include_str!("../fixtures/models/two_colours.mtl");

fn measure(sandbox: &Sandbox, more: &str) -> Run {
    sandbox.measure(&format!("--filters velocity_gather:fine {more}"));
    sandbox.read_run()
}

fn find_case(run: &Run) -> &Case {
    let mut cases = run.cases.iter();
    cases.find(|case| !case.is_reference).unwrap()
}

/// Returns the filter's squared error over the whole picture.
fn error(run: &Run) -> f64 {
    let json = serde_json::to_value(&find_case(run).scores).unwrap();
    let error = json["full"]["mse"]["value"].as_f64();
    error.unwrap_or_else(|| panic!("{json:#}"))
}

#[test]
fn a_guard_band_removes_the_error_at_the_border() {
    let sandbox = Sandbox::new();
    sandbox.write("plate.obj", TWO_COLOURS);
    sandbox.write("plate.mtl", PAINTS);
    let runs = ["", "--guard-band 8"].map(|more| measure(&sandbox, more));
    assert_eq!(runs.each_ref().map(|run| run.render.guard_band), [0, 8]);
    let [bare, padded] = runs.each_ref().map(error);
    assert!(padded < 0.9 * bare, "{padded} with a band, {bare} without");
}

#[test]
fn kinds_of_frames_are_recorded_and_sealed_scenes_have_other_truths_and_no_limits() {
    let sandbox = Sandbox::gathered();
    let plain = sandbox.read_run();
    let kinds = "--velocity camera_only --frame-sampling point --sky-velocity off";
    sandbox.measure_into("kinds", &format!("--filters velocity_gather:fine {kinds}"));
    let run: Run = sandbox.read_json("kinds/run.json");
    let json = serde_json::to_value(&run).unwrap();
    let recorded = ["velocity", "color", "sky_velocity"].map(|key| json[key].to_string());
    assert_eq!(recorded, ["\"camera_only\"", "\"point\"", "false"]);
    // A camera-only velocity lacks the plate's own motion.
    assert_ne!(error(&run), error(&plain));

    let sealed = measure(&sandbox, "--seal 7");
    let again = measure(&sandbox, "--scenes plate@seal7");
    let [case, same] = [&sealed, &again].map(find_case);
    assert_eq!(case.scene, "plate@seal7");
    assert_eq!((&case.id, &case.scores), (&same.id, &same.scores));
    assert_eq!(case.truth_hash, same.truth_hash);
    assert_ne!(case.truth_hash, find_case(&plain).truth_hash);
    sandbox.write_bound(0.0001);
    let refuse = |words: &str, says: &str| {
        let refused = sandbox.check(&[&IDENTITY[..], &split(words)].concat());
        assert_refused(&refused, 2, &[says]);
    };
    let says = "plate@seal7 / identity:default: has no bound";
    refuse("--seal 7", says);
    let says = "--seal: plate@fast is a variant; allowed: scenes in their default variant";
    refuse("--seal 7 --scenes plate@fast", says);
}
