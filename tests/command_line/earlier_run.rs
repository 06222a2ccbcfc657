//! Earlier runs in the same folder, kept by a narrower run and never lost silently; and baselines
//! of accepted scores.

use std::fs;
use std::process::Output;

use frame::Alignment;
use serde_json::json;
use tests::text::assert_contains;

use crate::sandbox::*;

/// Names the last run's cases without the references, sorted by name.
fn sorted_names(sandbox: &Sandbox) -> Vec<String> {
    let mut names = sandbox.read_case_names();
    names.sort();
    names
}

/// Makes a sandbox with a run of three filters on two scenes.
fn wide() -> Sandbox {
    Sandbox::once(|sandbox| {
        sandbox.add_slow_scene();
        sandbox.measure("--filters identity,velocity_gather:fine,mcguire:paper");
    })
}

#[test]
fn a_narrower_run_keeps_the_cases_of_a_wider_one() {
    let sandbox = wide();
    let before = sorted_names(&sandbox);
    assert_eq!(before.len(), 6);
    let narrow = sandbox.run(&split("--scenes slow --filters velocity_gather:fine"));
    assert_done(&narrow);
    assert_contains(&stderr(&narrow), &["keeps 5 cases of an earlier run"]);
    // The ranking covers only the requested filters.
    assert!(!stdout(&narrow).contains("mcguire"), "{}", stdout(&narrow));
    assert_eq!(sorted_names(&sandbox), before);
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Centred);
    // The report shows all of them.
    let page = sandbox.text("out/report.html");
    assert!(page.contains("mcguire"));

    let more = "--scenes slow --filters identity --seed 2";
    let parts = [
        "out/run.json",
        "5 cases",
        "seed was 1, now 2",
        "--out",
        "--no-cache",
    ];
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
    let run: measure::Run = sandbox.read_json("out/48x24/run.json");
    assert_eq!(run.render.size().to_string(), "48x24");
    // Both runs are read back.
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
    let parts = [
        "out/run.json: no run of this program",
        "EOF",
        "repair or remove it",
        "--out",
        "--no-cache",
    ];
    sandbox.refuse(&words.join(" "), &parts);
    assert_eq!(fs::read(&run).unwrap(), bytes);
    sandbox.measure("--filters identity --no-cache");
    assert_eq!(sandbox.read_case_names(), ["plate identity:default"]);
}

#[test]
fn cases_of_a_scene_that_has_changed_are_dropped() {
    let sandbox = wide();
    let scene = sandbox.text("scenes/plate/scene.toml");
    sandbox.write("scene.toml", &scene.replace("-1.6", "-1.2"));
    let narrow = sandbox.run(&split("--scenes plate --filters identity"));
    assert_done(&narrow);
    assert_contains(&stderr(&narrow), &["2 others were dropped"]);
    let left = "plate identity:default, slow identity:default, slow mcguire:paper, \
        slow velocity_gather:fine";
    assert_eq!(sorted_names(&sandbox).join(", "), left);
}

/// Returns the one case of a filter.
fn case_of(sandbox: &Sandbox, filter: &str) -> measure::Case {
    let mut cases = sandbox.read_run().cases.into_iter();
    cases.find(|case| case.id.filter == filter).unwrap()
}

#[test]
fn the_truth_s_own_errors_are_kept_for_the_next_filter() {
    let sandbox = Sandbox::new();
    sandbox.measure("--filters mcguire:paper");
    let path = sandbox.path("out/plate/.shuttertruth.errors_centred.json");
    let record: serde_json::Value =
        sandbox.read_json("out/plate/.shuttertruth.errors_centred.json");
    sandbox.measure("--filters jimenez:slides_2014");
    let kept = case_of(&sandbox, "jimenez");
    assert_eq!(
        sandbox.read_json::<serde_json::Value>("out/plate/.shuttertruth.errors_centred.json"),
        record
    );
    sandbox.measure("--filters jimenez:slides_2014 --no-cache");
    assert_eq!(case_of(&sandbox, "jimenez").scores, kept.scores);

    // They are read: other errors give other scores.
    let mut errors = record["made"].clone();
    errors[0]["ends"]["best"]["flip"] = json!(0.0);
    let inputs = record["inputs"].as_str().unwrap().to_owned();
    measure::put(&path, inputs, &[], &errors).unwrap();
    sandbox.measure("--filters mcguire:paper --set mcguire.samples=9");
    let changed = case_of(&sandbox, "mcguire").scores.skill;
    sandbox.measure("--filters mcguire:paper --set mcguire.samples=9 --no-cache");
    let measured = case_of(&sandbox, "mcguire").scores.skill;
    assert_eq!(measured.mse, changed.mse);
    assert_ne!(measured.flip, changed.flip);
}

const FINE: &str = "--filters velocity_gather:fine";
const COARSER: &str = "--filters velocity_gather:fine --set velocity_gather.samples=2";

/// Makes a sandbox with a margin, a measured gather with the samples of a check, and its accepted
/// scores.
fn set_up() -> Sandbox {
    Sandbox::once(|sandbox| {
        write_margin(sandbox, "0.005");
        run(sandbox, FINE);
        assert_done(&accept(sandbox, "first"));
    })
}

fn write_margin(sandbox: &Sandbox, margin: &str) {
    let text = format!("[margin]\nflip_moving = {margin}\n");
    sandbox.put("scenes/bounds.toml", text);
}

fn run(sandbox: &Sandbox, more: &str) {
    run_at(sandbox, "64x32", more);
}

fn run_at(sandbox: &Sandbox, size: &str, more: &str) {
    let words = "run --quiet --out out --samples-per-pixel 64 --size";
    sandbox.done(&format!("{words} {size} {more}"));
}

fn accept(sandbox: &Sandbox, reason: &str) -> Output {
    let line = format!("limits accept --out out --reason {reason}");
    sandbox.outside_ci(&split(&line))
}

fn check(sandbox: &Sandbox, more: &str) -> Output {
    sandbox.check(&split(&format!("--baseline base.json {more}")))
}

fn baseline(sandbox: &Sandbox) -> serde_json::Value {
    sandbox.read_json("base.json")
}

#[test]
fn equal_scores_pass_and_worse_scores_are_reported() {
    let sandbox = set_up();
    let same = check(&sandbox, FINE);
    assert_done(&same);
    let due = "no worse: velocity_gather:fine flip_moving";
    assert_contains(&stdout(&same), &[due]);
    let worse = check(&sandbox, COARSER);
    assert_eq!(worse.status.code(), Some(1), "{}", stdout(&worse));
    let due = "WORSE: velocity_gather:fine samples=2 flip_moving, worse by 0.0";
    assert_contains(&stdout(&worse), &[due]);
    write_margin(&sandbox, "0.5");
    assert_done(&check(&sandbox, COARSER));
}

#[test]
fn a_baseline_has_one_number_per_line_under_sorted_keys() {
    let sandbox = set_up();
    let read = || sandbox.text("base.json");
    let text = read();
    let numbers: Vec<&str> = (text.lines().map(str::trim))
        .filter(|line| line.starts_with('"') && line.contains("\": ") && !line.ends_with('{'))
        .skip_while(|line| !line.starts_with("\"bleed"))
        .collect();
    assert!(numbers.len() > 20, "{text}");
    assert!(numbers.is_sorted(), "{numbers:#?}");
    let kept = baseline(&sandbox);
    assert_eq!(kept["reasons"], json!(["first"]));
    let run = sandbox.read_run();
    assert_eq!(kept["adapter"]["name"], run.adapter.unwrap().name);
    let truth = &kept["truths"]["plate"]["trailing"];
    assert_eq!(*truth, run.cases[0].truth_hash);
    assert_done(&accept(&sandbox, "first"));
    assert_eq!(read(), text);
}

#[test]
fn accept_names_its_run_and_newer_runs_of_other_sizes() {
    let sandbox = set_up();
    let accepted = |printed: &str, said: &str| {
        let output = accept(&sandbox, "again");
        assert_eq!([stdout(&output), stderr(&output)], [printed, said]);
    };
    let written = "written: base.json, from out/run.json (1 case at 64x32)\n";
    accepted(written, "");
    run_at(&sandbox, "48x24", "--filters identity");
    let note =
        "note: out/48x24 is newer, and is not accepted; to accept it instead: --out out/48x24\n";
    accepted(written, note);
    let other = sandbox.outside_ci(&split("limits accept --out out/48x24 --reason other"));
    let due = "written: base.json, from out/48x24/run.json (1 case at 48x24)\n";
    assert_eq!([stdout(&other), stderr(&other)], [due, ""]);
    // A run that is not newer changes nothing.
    run(&sandbox, FINE);
    accepted(written, "");
}

#[test]
fn accept_changes_only_the_named_cases() {
    let sandbox = set_up();
    let flip = |filter: &str| baseline(&sandbox)["scores"]["plate"][filter]["flip_moving"].clone();
    let before = flip("velocity_gather:fine");
    run(&sandbox, &COARSER.replace(":fine", ":fine,identity"));
    assert_done(&accept(&sandbox, "more --only plate/ident*"));
    assert_eq!(flip("velocity_gather:fine"), before);
    assert!(flip("identity:default").is_number());
    assert_eq!(baseline(&sandbox)["reasons"], json!(["first", "more"]));
    assert_done(&accept(&sandbox, "anew"));
    assert_ne!(flip("velocity_gather:fine"), before);
    assert_eq!(baseline(&sandbox)["reasons"], json!(["anew"]));
}

#[test]
fn accept_refuses_bad_requests_and_incomparable_runs() {
    let sandbox = set_up();
    let before = sandbox.text("base.json");
    let in_ci = |more: &str| {
        let line = format!("limits accept --out out --reason r {more}");
        let mut command = sandbox.command(&split(&line));
        command.env("CI", "true").output().unwrap()
    };
    assert_refused(&in_ci(""), 2, &["CI is set", "--force"]);
    let accept = |more: &[&str]| {
        let words = ["limits", "accept", "--out", "out"];
        sandbox.outside_ci(&[&words[..], more].concat())
    };
    let refuse = |more: &[&str], parts: &[&str]| assert_refused(&accept(more), 2, parts);
    refuse(&["--reason", " "], &["--reason: needs one line"]);
    let parts = ["fan/* matches no case", "plate/velocity_gather:fine"];
    refuse(&["--reason", "r", "--only", "fan/*"], &parts);
    refuse(&["--reason", "r", "--only", "["], &["--only"]);
    refuse(&[], &["--reason"]);
    let after = sandbox.text("base.json");
    assert_eq!(after, before);
    // A new truth for one case of a scene would leave the other cases with the old truth.
    sandbox.measure(FINE);
    let parts = ["the truth is another", "accept the whole run"];
    refuse(&["--reason", "r", "--only", "plate/*"], &parts);
    // Pretends that a graphics card made it.
    let kind = sandbox.read_run().adapter.unwrap().kind;
    let other = before.replace(&format!("\"kind\": \"{kind}\""), "\"kind\": \"quantum\"");
    assert_ne!(other, before);
    sandbox.put("base.json", other);
    let parts = ["another class", "quantum", "force it"];
    refuse(&["--reason", "r"], &parts);
    assert_done(&in_ci("--force"));
    let forced = baseline(&sandbox);
    assert_ne!(forced["adapter"]["kind"], "quantum");
}

#[test]
fn a_case_with_another_truth_is_not_compared() {
    let sandbox = set_up();
    let refuse = |more: &str, parts: &[&str]| assert_refused(&check(&sandbox, more), 2, parts);
    let way_out = "shuttertruth limits accept";
    let other = "base.json: its truth of plate (trailing) is another";
    refuse(&format!("{FINE} --seed 9"), &[other, way_out]);
    let missing = "has no scores of identity:default on plate";
    refuse("--filters identity --no-cache", &[missing, way_out]);
    fs::remove_file(sandbox.path("scenes/bounds.toml")).unwrap();
    refuse(FINE, &["[margin]"]);
    sandbox.put("base.json", "{}");
    refuse(FINE, &["base.json: no baseline"]);
}
