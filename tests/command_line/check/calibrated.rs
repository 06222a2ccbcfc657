//! Limits that `calibrate` proposes.

use std::fs;

use super::{assert_ends, make_bounded};
use crate::sandbox::{assert_done, split, stdout};

#[test]
fn calibrated_limits_pass_the_filter_and_fail_a_worse_one() {
    let sandbox = make_bounded(0.9, "required");
    let words = split(
        "limits calibrate --quiet --out calibrated --size 64x32 --samples-per-pixel 64 --runs 2 --filters \
         velocity_gather:fine --metrics flip_moving,misplacement,bleed_leading,extent,psnr_moving",
    );
    let output = sandbox.shuttertruth(&words);
    assert_done(&output);
    let proposed = fs::read_to_string(sandbox.path("calibrated/plate.bounds.toml")).unwrap();
    assert!(stdout(&output).contains(&proposed));
    assert_eq!(proposed.matches("limit = ").count(), 5, "{proposed}");
    sandbox.write("bounds.toml", &proposed);
    // A seed that neither run has.
    let fine = ["--filters", "velocity_gather:fine", "--seed", "9"];
    assert_ends(&sandbox.check(&fine), 0, &["5 required bounds: 5 met"]);
    let worse = [&fine[..], &["--set", "velocity_gather.samples=2"]].concat();
    assert_ends(&sandbox.check(&worse), 1, &["BROKEN flip_moving"]);
}

#[test]
fn limits_are_for_bounded_metrics_and_those_that_notice_changes_of_a_kernel_unless_named() {
    let sandbox = make_bounded(0.9, "required");
    let words = split(
        "limits calibrate --quiet --out calibrated --size 64x32 --samples-per-pixel 64 --runs 2 --filters velocity_gather:fine",
    );
    assert_done(&sandbox.shuttertruth(&words));
    let proposed = fs::read_to_string(sandbox.path("calibrated/plate.bounds.toml")).unwrap();
    let names: Vec<&str> = (proposed.lines())
        .filter_map(|line| line.split_once(" = { limit"))
        .map(|(name, _)| name)
        .collect();
    let noticing = [
        "deficit",
        "gather_spread",
        "label_tv_p95",
        "static_contamination",
    ];
    let help = stdout(&sandbox.shuttertruth(&["limits", "calibrate", "--help"]));
    for name in noticing {
        assert!(help.contains(name), "{name}: {help}");
    }
    assert_eq!(names.len(), 1 + noticing.len(), "{names:?}");
    for name in noticing.iter().chain(&["flip_moving"]) {
        assert!(names.contains(name), "{name}: {names:?}");
    }
}
