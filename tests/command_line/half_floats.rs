//! Filters with colours of 16-bit floats: their gathers are measured in 32 bits.

use std::fs;
use std::sync::OnceLock;

use measure::Case;
use metrics::Measured;
use tests::filter_folder::copy_folder;
use tests::text::{assert_contains, squeeze};

use crate::sandbox::{Sandbox, split};

/// Scores that need weights independent of colour.
const OF_WEIGHTS: &str = "lateral_growth row_loss bleed_lateral label_tv extent centroid unity gather_offset gather_spread";

/// Writes the fixture `blur` with a name, a format and a weight of its taps.
fn write_blur(sandbox: &Sandbox, name: &str, float: &str, weight: &str) {
    let blur = tests::root().join("tests/fixtures/half_floats/blur");
    let read = |file: &str| {
        let text = fs::read_to_string(blur.join(file)).unwrap();
        let text = text.replace("NAME", name).replace("FLOAT", float);
        text.replace("WEIGHT", weight)
    };
    sandbox.write_filter(name, &read("filter.toml"), &read("blur.wgsl"));
}

/// Writes a filter that runs this program with the filter `half`.
#[cfg(unix)]
fn write_outside(sandbox: &Sandbox) {
    let command = format!(
        "command = ['{}', 'engine', 'blur', '--filter', '{}', '--frame', '{{frame}}', \
         '--out', '{{out}}', '--exposure', '{{exposure}}']",
        env!("CARGO_BIN_EXE_shuttertruth"),
        sandbox.path("half").display(),
    );
    tests::filter_folder::write_manifest(&sandbox.path("outside"), "outside", &command);
}

/// Measures all filters on the plate, once for all tests; returns the output, and their cases.
fn measured() -> &'static (String, Vec<Case>) {
    static FOUND: OnceLock<(String, Vec<Case>)> = OnceLock::new();
    FOUND.get_or_init(|| {
        let sandbox = Sandbox::new();
        write_blur(&sandbox, "full", "rgba32float", "1.0");
        write_blur(&sandbox, "half", "rgba16float", "1.0");
        for (name, float) in [("bright", "rgba16float"), ("bright_full", "rgba32float")] {
            write_blur(&sandbox, name, float, "1.0 + 0.5 * there.g");
        }
        // Other fixtures, and the example of Godot's kind, which stores its output in 16 bits.
        for (name, folder) in [
            ("drawn", "tests/fixtures/half_floats/drawn"),
            ("constant", "tests/fixtures/half_floats/constant"),
            ("godot_blur", "examples/first_blur/godot"),
        ] {
            copy_folder(&tests::root().join(folder), &sandbox.path(name));
        }
        let mut filters =
            "identity,full,half,bright,bright_full,drawn,constant,godot_blur".to_owned();
        #[cfg(unix)]
        {
            write_outside(&sandbox);
            filters += ",outside --allow-commands";
        }
        let more = "--set constant.taps=7 --table";
        let printed = sandbox.measure(&format!("--filter {filters} {more}"));
        (printed, sandbox.read_filter_cases())
    })
}

fn find_case(filter: &str) -> &'static Case {
    let mut cases = measured().1.iter();
    cases.find(|case| case.filter == filter).unwrap()
}

/// Checks that no score of weights applies to a filter, for these reasons.
#[track_caller]
fn assert_no_weights(filter: &str, parts: &[&str]) {
    for metric in split(&format!("{OF_WEIGHTS} energy n_eq_label_tv")) {
        match find_case(filter).scores.get(metric.parse().unwrap()) {
            Measured::NotApplicable { reason } => assert_contains(&reason, parts),
            score => panic!("{metric} of {filter}: {score:?}"),
        }
    }
}

#[test]
fn rounded_colours_lose_no_score_of_what_a_filter_gathers() {
    let [full, half] = ["full", "half"].map(find_case);
    assert_eq!(half.nonlinearity, full.nonlinearity);
    for metric in split(OF_WEIGHTS) {
        let metric = metric.parse().unwrap();
        let score = half.scores.get(metric);
        assert!(score.value().is_some(), "{}: {score:?}", metric.name());
        // Half floats change neither the weights nor the gathered colours.
        assert_eq!(score, full.scores.get(metric), "{}", metric.name());
    }
    // The picture changes, and so do its scores.
    assert_ne!(half.scores.moving, full.scores.moving);
}

/// Fragment shaders, which many engines have, lose none of these scores either.
#[test]
fn shaders_of_engines_keep_their_scores_in_16_bits() {
    for filter in ["godot_blur", "drawn"] {
        for metric in split(OF_WEIGHTS) {
            let score = find_case(filter).scores.get(metric.parse().unwrap());
            assert!(score.value().is_some(), "{metric} of {filter}: {score:?}");
        }
    }
}

/// A shader rebuilt for other constants stores like the first.
#[test]
fn shaders_of_other_constants_keep_their_scores_in_16_bits() {
    let nonlinearity = find_case("constant").nonlinearity.unwrap();
    // Half of a last digit of 32 bits is 6e-8, of 16 bits 5e-4.
    assert!(nonlinearity < 1e-4, "{nonlinearity}");
}

#[test]
fn weights_that_depend_on_colour_give_no_scores_of_weights_and_say_why() {
    let note = "n/a: grow, loss, bleed, TV of bright:default, bright_full:default on plate: \
        the filter's weights depend on colour";
    assert_contains(&squeeze(&measured().0), &[note]);
    assert_eq!(find_case("identity").nonlinearity, Some(0.0));
    for filter in ["bright", "bright_full"] {
        assert_no_weights(filter, &["weights depend on colour"]);
        let case = find_case(filter);
        // Pixels twice as bright weigh up to 1.3 times as much.
        let nonlinearity = case.nonlinearity.unwrap();
        assert!(nonlinearity > 0.01, "{filter}: {nonlinearity}");
        assert!(case.scores.moving.flip.value().is_some(), "{filter}");
    }
}

/// The format of a program's picture is the program's own.
#[cfg(unix)]
#[test]
fn a_program_that_rounds_is_told_so() {
    let parts = ["writes 16-bit floats", "let it write 32-bit floats"];
    assert_no_weights("outside", &parts);
}
