//! Earlier runs in the same folder: kept beside a narrower run, and never lost silently.

use std::fs;

use frame::Alignment;

use crate::sandbox::{Sandbox, assert_done, assert_refused, files_below, stderr, stdout};

#[test]
fn a_narrower_run_keeps_the_cases_of_a_wider_one() {
    let sandbox = Sandbox::two_scenes();
    let bounds = "[default]\nflip_moving = { limit = 0.9, why = \"it serves a test\" }\n";
    fs::write(sandbox.path("scenes/bounds.toml"), bounds).unwrap();
    let filters = ["--filters", "identity,velocity_gather:fine,mcguire:paper"];
    assert_done(&sandbox.run(&filters));
    let before = sandbox.read_case_names();
    assert_eq!(before.len(), 6);
    let narrow = sandbox.run(&["--scenes", "slow", "--filters", "velocity_gather:fine"]);
    assert_done(&narrow);
    assert!(
        stderr(&narrow).contains("keeps 5 cases of an earlier run"),
        "{}",
        stderr(&narrow)
    );
    // The ranking covers only the filters asked for.
    assert!(!stdout(&narrow).contains("mcguire"), "{}", stdout(&narrow));
    let mut after = sandbox.read_case_names();
    after.sort();
    let mut sorted = before.clone();
    sorted.sort();
    assert_eq!(after, sorted);
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Centred);
    assert_eq!(
        sandbox.read_findings().len(),
        6,
        "a finding per bounded score"
    );
    // The report shows all of them.
    assert!(
        fs::read_to_string(sandbox.path("out/report.html"))
            .unwrap()
            .contains("mcguire")
    );

    let more = ["--scenes", "slow", "--filters", "identity", "--seed", "2"];
    let refused = sandbox.run(&more);
    let parts = [
        "out/run.json",
        "5 cases",
        "seed was 1, now 2",
        "--out",
        "--no-cache",
    ];
    assert_refused(&refused, 2, &parts);
    assert_eq!(sandbox.read_case_names().len(), 6);
    assert_done(&sandbox.run(&[&more[..], &["--no-cache"]].concat()));
    assert_eq!(sandbox.read_case_names(), ["slow identity:default"]);
}

#[test]
fn runs_of_two_sizes_lie_side_by_side() {
    let sandbox = Sandbox::new();
    sandbox.write(
        "bounds.toml",
        "[default]\nflip_moving = { limit = 0.9, size = [48, 24], why = \"it serves a test\" }\n",
    );
    let filters = ["--filters", "identity"];
    assert_done(&sandbox.run(&filters));
    let contents = || {
        let files = files_below(&sandbox.path("out")).into_iter();
        let kept = files.filter(|path| !path.starts_with(sandbox.path("out/48x24")));
        let contents = kept.map(|path| (fs::read(&path).unwrap(), path));
        contents.collect::<Vec<_>>()
    };
    let before = contents();
    // A check makes pictures of the size that its bounds hold at.
    let few = ["check", "--samples-per-pixel", "64", "--out", "out"];
    let check = sandbox.outside_ci(&[&few[..], &filters].concat());
    assert_done(&check);
    let note = "out holds a run of another picture size; this one, at 48x24, goes to out/48x24";
    assert!(stderr(&check).contains(note), "{}", stderr(&check));
    assert!(stdout(&check).contains("report: out/48x24/report.html"));
    assert!(contents() == before, "the run was changed");
    let run: suite::Run = sandbox.read_json("out/48x24/run.json");
    assert_eq!((run.render.width, run.render.height), (48, 24));
    // Both are read back.
    let again = sandbox.outside_ci(&[&few[..], &filters].concat());
    assert_eq!(stdout(&again), stdout(&check));
    assert!(stdout(&sandbox.run(&filters)).contains("cases: 8, 8 of them read back"));
}

#[test]
fn an_earlier_run_that_cannot_be_read_is_not_replaced() {
    let sandbox = Sandbox::new();
    let filters = ["--filters", "identity"];
    assert_done(&sandbox.run(&filters));
    let run = sandbox.path("out/run.json");
    let whole = fs::read(&run).unwrap();
    fs::write(&run, &whole[..whole.len() / 2]).unwrap();
    let refused = sandbox.run(&filters);
    let parts = [
        "out/run.json: no run of this program",
        "EOF",
        "repair or remove it",
        "--out",
        "--no-cache",
    ];
    assert_refused(&refused, 2, &parts);
    assert_eq!(fs::read(&run).unwrap().len(), whole.len() / 2);
    assert_done(&sandbox.run(&["--no-cache", "--filters", "identity"]));
    assert_eq!(sandbox.read_case_names(), ["plate identity:default"]);
}

#[test]
fn cases_of_a_scene_that_has_changed_are_dropped() {
    let sandbox = Sandbox::two_scenes();
    assert_done(&sandbox.run(&["--filters", "identity,velocity_gather:fine"]));
    let scene = fs::read_to_string(sandbox.path("scenes/plate/scene.toml")).unwrap();
    sandbox.write("scene.toml", &scene.replace("-1.6", "-1.2"));
    let narrow = sandbox.run(&["--scenes", "plate", "--filters", "identity"]);
    assert_done(&narrow);
    assert!(
        stderr(&narrow).contains("1 other was dropped"),
        "{}",
        stderr(&narrow)
    );
    let mut left = sandbox.read_case_names();
    left.sort();
    let expected = [
        "plate identity:default",
        "slow identity:default",
        "slow velocity_gather:fine",
    ];
    assert_eq!(left, expected);
}
