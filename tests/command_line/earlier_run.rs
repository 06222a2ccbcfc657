//! Earlier runs in the same folder: kept by a narrower run, and never lost silently.

use std::fs;

use frame::Alignment;
use tests::text::assert_contains;

use crate::sandbox::*;

/// Names the last run's cases without the references, sorted by name.
fn sorted_names(sandbox: &Sandbox) -> Vec<String> {
    let mut names = sandbox.read_case_names();
    names.sort();
    names
}

#[test]
fn a_narrower_run_keeps_the_cases_of_a_wider_one() {
    let sandbox = Sandbox::two_scenes();
    let bounds = "[default]\nflip_moving = { limit = 0.9, why = \"it serves a test\" }\n";
    sandbox.put("scenes/bounds.toml", bounds);
    sandbox.measure("--filters identity,velocity_gather:fine,mcguire:paper");
    let before = sorted_names(&sandbox);
    assert_eq!(before.len(), 6);
    let narrow = sandbox.run(&split("--scenes slow --filters velocity_gather:fine"));
    assert_done(&narrow);
    assert_contains(&stderr(&narrow), &["keeps 5 cases of an earlier run"]);
    // The ranking covers only the requested filters.
    assert!(!stdout(&narrow).contains("mcguire"), "{}", stdout(&narrow));
    assert_eq!(sorted_names(&sandbox), before);
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Centred);
    assert_eq!(sandbox.read_findings().len(), 6);
    // The report shows all of them.
    let page = sandbox.text("out/report.html");
    assert!(page.contains("mcguire"));

    let more = "--scenes slow --filters identity --seed 2";
    let parts = "out/run.json | 5 cases | seed was 1, now 2 | --out | --no-cache";
    assert_refused(&sandbox.run(&split(more)), 2, &parts);
    assert_eq!(sorted_names(&sandbox), before);
    sandbox.measure(&format!("{more} --no-cache"));
    assert_eq!(sandbox.read_case_names(), ["slow identity:default"]);
}

#[test]
fn runs_of_two_sizes_lie_side_by_side() {
    let sandbox = Sandbox::new();
    let bounds =
        "[default]\nflip_moving = { limit = 0.9, size = [48, 24], why = \"it serves a test\" }\n";
    sandbox.write("bounds.toml", bounds);
    sandbox.measure("--filters identity");
    let contents = || {
        let mut files = read_below(&sandbox.path("out"));
        files.retain(|(name, _)| !name.starts_with("48x24"));
        files
    };
    let before = contents();
    // A check makes pictures of its bounds' size.
    let few = split("check --samples-per-pixel 64 --out out --filters identity");
    let check = sandbox.outside_ci(&few);
    assert_done(&check);
    let note = "out holds a run of another picture size; this one, at 48x24, goes to out/48x24";
    assert_contains(&stderr(&check), &[note]);
    assert_contains(&stdout(&check), &["report: out/48x24/report.html"]);
    assert!(contents() == before, "the run was changed");
    let run: suite::Run = sandbox.read_json("out/48x24/run.json");
    assert_eq!((run.render.width, run.render.height), (48, 24));
    // Both are read back.
    assert_eq!(stdout(&sandbox.outside_ci(&few)), stdout(&check));
    let again = sandbox.measure("--filters identity");
    assert_contains(&again, &["cases: 8, 8 of them read back"]);
}

#[test]
fn an_earlier_run_that_cannot_be_read_is_not_replaced() {
    let sandbox = Sandbox::measured();
    let run = sandbox.path("out/run.json");
    let mut bytes = fs::read(&run).unwrap();
    bytes.truncate(bytes.len() / 2);
    fs::write(&run, &bytes).unwrap();
    let words = [&quick_command("run", "16")[..], &IDENTITY].concat();
    let parts =
        "out/run.json: no run of this program | EOF | repair or remove it | --out | --no-cache";
    sandbox.refuse(&words.join(" "), &parts);
    assert_eq!(fs::read(&run).unwrap(), bytes);
    sandbox.measure("--filters identity --no-cache");
    assert_eq!(sandbox.read_case_names(), ["plate identity:default"]);
}

#[test]
fn cases_of_a_scene_that_has_changed_are_dropped() {
    let sandbox = Sandbox::two_scenes();
    sandbox.measure("--filters identity,velocity_gather:fine");
    let scene = sandbox.text("scenes/plate/scene.toml");
    sandbox.write("scene.toml", &scene.replace("-1.6", "-1.2"));
    let narrow = sandbox.run(&split("--scenes plate --filters identity"));
    assert_done(&narrow);
    assert_contains(&stderr(&narrow), &["1 other was dropped"]);
    let left = "plate identity:default, slow identity:default, slow velocity_gather:fine";
    assert_eq!(sorted_names(&sandbox).join(", "), left);
}
