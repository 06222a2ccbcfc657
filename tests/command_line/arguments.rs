//! Arguments: patterns, misspelt and old words, and help.

use crate::bench::{Bench, assert_done, assert_refused, stderr, stdout};

#[test]
fn patterns_select_and_misspelt_names_get_a_suggestion() {
    let bench = Bench::two_scenes();
    assert_done(&bench.run(&[
        "--scenes",
        "sl*",
        "--filter",
        "velocity*:f*",
        "--filter",
        "ident*",
    ]));
    assert_eq!(
        bench.read_case_names(),
        ["slow velocity_gather:fine", "slow identity:default"]
    );
    for (words, parts) in [
        (
            ["--scenes", "plat"],
            ["no scene \"plat\"", "did you mean plate?"],
        ),
        (
            ["--filter", "jump_flod"],
            ["called \"jump_flod\"", "did you mean jump_flood?"],
        ),
        (
            ["--scenes", "x*"],
            ["no scene \"x*\"", "allowed: plate, slow"],
        ),
    ] {
        assert_refused(&bench.run(&words), 2, &parts);
    }
    assert_refused(
        &bench.shuttertruth(&["list", "mcgiure"]),
        2,
        &["\"mcgiure\"", "did you mean mcguire?"],
    );
}

#[test]
fn misspelt_commands_and_options_get_a_suggestion() {
    let bench = Bench::new();
    for words in [&["rnu"][..], &["help", "rnu"]] {
        let refused = bench.shuttertruth(words);
        assert_refused(&refused, 2, &["no command \"rnu\"; did you mean run?"]);
    }
    let refused = bench.run(&["--sceens", "plate"]);
    let suggested = "no option --sceens; did you mean --scenes?";
    assert_refused(&refused, 2, &[suggested]);
    let refused = bench.shuttertruth(&["help", "xyz"]);
    assert_refused(&refused, 2, &["no command \"xyz\"; allowed: run, score"]);
}

#[test]
fn list_shows_only_the_requested_kinds() {
    let bench = Bench::two_scenes();
    let list = |words: &[&str]| {
        let output = bench.shuttertruth(&[&["list"], words].concat());
        assert_done(&output);
        stdout(&output)
    };
    let scenes = list(&["scenes"]);
    assert!(
        scenes.contains("plate") && !scenes.contains("mcguire"),
        "{scenes}"
    );
    let filters = list(&["filters"]);
    assert!(
        filters.contains("mcguire") && !filters.contains("plate"),
        "{filters}"
    );
    let one = list(&["mcguire"]);
    assert!(one.contains(":paper") && !one.contains("jimenez"), "{one}");
    let elsewhere = ["--scenes-dir", "nowhere"];
    for what in ["filters", "bevy"] {
        assert!(list(&[&[what], &elsewhere[..]].concat()).contains("bevy"));
    }
    let all = bench.shuttertruth(&[&["list"], &elsewhere[..]].concat());
    assert!(stdout(&all).contains("bevy"));
    assert!(stderr(&all).contains("no scenes: there is no folder nowhere"));
    let misspelt = bench.shuttertruth(&[&["list", "mcgiure"], &elsewhere[..]].concat());
    assert_refused(&misspelt, 2, &["did you mean mcguire?"]);
    assert!(list(&["adapters"]).starts_with("0: "));
    assert!(list(&[]).lines().count() < 80);
}

#[test]
fn the_program_without_arguments_prints_its_help_and_fails() {
    let bench = Bench::new();
    let output = bench.shuttertruth(&[]);
    assert_eq!(output.status.code(), Some(2));
    for words in [
        "Usage: shuttertruth",
        "Measure:\n  run  ",
        "Judge:\n  check  ",
        "Tune:\n  tune  ",
        "--list-adapters",
    ] {
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
    let help = stdout(&bench.shuttertruth(&["run", "--help"]));
    for heading in ["Scenes and files:", "Filters:", "Adapter:", "Output:"] {
        assert!(help.contains(heading), "{heading}\n{help}");
    }
    assert!(
        help.lines().all(|line| line.chars().count() <= 100),
        "{help}"
    );
}

#[test]
fn old_options_are_refused_with_the_new_ones() {
    let bench = Bench::new();
    for (words, part) in [
        (&["run", "--color", "point"][..], "--frame-sampling point"),
        (
            &["tune", "--filter", "jump_flood", "--sobol", "4"],
            "shuttertruth sensitivity",
        ),
        (
            &["tune", "--filter", "jump_flood", "--morris", "4"],
            "shuttertruth sensitivity",
        ),
        (
            &["tune", "--filter", "jump_flood", "--compare", "a,b"],
            "shuttertruth compare-presets",
        ),
        (
            &["tune", "--filter", "jump_flood", "--sealed", "fan"],
            "--held-out fan",
        ),
        (
            &["tune", "--filter", "jump_flood", "--sealed-size", "9x9"],
            "--held-out-size 9x9",
        ),
    ] {
        assert_refused(&bench.shuttertruth(words), 2, &[part]);
    }
}
