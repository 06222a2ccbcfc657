//! shuttertruth.toml in the working folder.

use tests::text::{assert_contains, squeeze};

use crate::sandbox::{Sandbox, assert_done, split, stderr, stdout};

const SETTINGS: &str = "scenes = [\"plate\"]\nsize = \"64x32\"\nsamples_per_pixel = 16\n\
    filters = [\"identity\", \"velocity_gather:fine\"]\nout = \"results\"\nbaseline = \"kept.json\"\n";

/// Makes a sandbox with two scenes and the settings.
fn make() -> Sandbox {
    let sandbox = Sandbox::two_scenes();
    sandbox.put("shuttertruth.toml", SETTINGS);
    sandbox
}

/// Makes a sandbox with a run of these settings.
fn measured() -> Sandbox {
    Sandbox::once(|sandbox| {
        sandbox.write_files("", &make().read_files());
        sandbox.done("run --quiet");
    })
}

#[test]
fn the_file_s_values_hold_until_the_command_line_says_otherwise() {
    let sandbox = measured();
    let output = sandbox.shuttertruth(&["run"]);
    assert_done(&output);
    let note = "note: scenes plate, size 64x32, samples_per_pixel 16, filters identity \
        velocity_gather:fine, out results (shuttertruth.toml)\n";
    assert_contains(&stderr(&output), &[note]);
    let run: measure::Run = sandbox.read_json("results/run.json");
    assert_eq!(run.render.size().to_string(), "64x32");
    assert_eq!(run.render.samples_per_pixel, 16);
    let filters = run.cases.iter().filter(|case| !case.is_reference);
    let filters: Vec<String> = filters.map(|case| case.name()).collect();
    assert_eq!(filters, ["identity:default", "velocity_gather:fine"]);
    // The command line wins, value by value.
    for scenes in ["slow", "--scenes slow"] {
        let line = format!("run {scenes} --filter identity --out other");
        let output = sandbox.shuttertruth(&split(&line));
        assert_done(&output);
        let note = "note: size 64x32, samples_per_pixel 16 (shuttertruth.toml)\n";
        assert_contains(&stderr(&output), &[note]);
        let run: measure::Run = sandbox.read_json("other/run.json");
        assert!(run.cases.iter().all(|case| case.scene == "slow"));
    }
}

#[test]
fn report_compare_and_accept_find_the_folder_and_the_baseline() {
    let sandbox = measured();
    sandbox.done("run --quiet --set velocity_gather.samples=2");
    assert_contains(&sandbox.done("report"), &["written: results/report.html"]);
    let changes = sandbox.done("compare");
    assert_contains(&changes, &["velocity_gather:fine.samples: ", "-> 2"]);
    let accept = ["limits", "accept", "--reason", "first"];
    let accepted = stdout(&sandbox.outside_ci(&accept));
    assert_contains(&accepted, &["written: kept.json, from results/run.json"]);
    let margin = "[margin]\nflip_moving = 0.5\n";
    sandbox.put("scenes/bounds.toml", margin);
    let judged = sandbox.outside_ci(&["check", "--run", "results"]);
    assert_done(&judged);
    assert_contains(
        &stderr(&judged),
        &["note: baseline kept.json (shuttertruth.toml)\n"],
    );
}

#[test]
fn help_and_list_name_the_file() {
    let sandbox = make();
    let help = squeeze(&sandbox.done("run -h"));
    assert_contains(
        &help,
        &["[shuttertruth.toml: 64x32]", "[shuttertruth.toml: plate]"],
    );
    let listed = sandbox.done("list");
    let line = "settings: scenes plate, size 64x32, samples_per_pixel 16, filters identity \
        velocity_gather:fine, out results, baseline kept.json (shuttertruth.toml)\n";
    assert_contains(&squeeze(&listed), &[line.trim_end()]);
}

#[test]
fn wrong_keys_and_values_are_refused_at_their_line() {
    let sandbox = Sandbox::new();
    for (text, parts) in [
        (
            "sise = \"64x32\"\n",
            ["1 | sise", "^^^^", "samples_per_pixel"],
        ),
        (
            "out = \"a\"\nsize = \"64\"\n",
            ["2 | size = \"64\"", "^^^^", "WIDTHxHEIGHT"],
        ),
        (
            "samples_per_pixel = 17\n",
            ["1 | samples_per_pixel", "^^", "multiples of 8"],
        ),
        (
            "scenes = \"plate\"\n",
            ["1 | scenes", "^^^^^^^", "a sequence"],
        ),
    ] {
        sandbox.put("shuttertruth.toml", text);
        sandbox.refuse(
            "run",
            &[&["error: shuttertruth.toml: "], &parts[..]].concat(),
        );
    }
    assert!(!sandbox.path("out").exists());
}
