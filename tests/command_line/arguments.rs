//! Arguments: patterns, misspelt and old words, and help.

use crate::sandbox::{Sandbox, assert_done, assert_refused, stderr, stdout};

#[test]
fn patterns_select_and_misspelt_names_get_a_suggestion() {
    let sandbox = Sandbox::two_scenes();
    assert_done(&sandbox.run(&[
        "--scenes",
        "sl*",
        "--filter",
        "velocity*:f*",
        "--filter",
        "ident*",
    ]));
    assert_eq!(
        sandbox.read_case_names(),
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
        assert_refused(&sandbox.run(&words), 2, &parts);
    }
    assert_refused(
        &sandbox.shuttertruth(&["list", "mcgiure"]),
        2,
        &["\"mcgiure\"", "did you mean mcguire?"],
    );
}

#[test]
fn a_moved_command_names_its_new_place() {
    let sandbox = Sandbox::new();
    for (words, place) in [
        (
            &["ingest", "capture"][..],
            "ingest: use shuttertruth engine ingest",
        ),
        (&["-q", "accept"], "accept: use shuttertruth limits accept"),
        (
            &["compare-presets", "a", "b"],
            "compare-presets: use shuttertruth tune compare",
        ),
        (
            &["tune", "--filter", "jump_flood"],
            "tune: use shuttertruth tune search",
        ),
    ] {
        assert_refused(&sandbox.shuttertruth(words), 2, &[place]);
    }
    assert_refused(
        &sandbox.shuttertruth(&["reprot"]),
        2,
        &["'reprot'", "'report'"],
    );
    assert_refused(
        &sandbox.run(&["--sceens", "plate"]),
        2,
        &["'--sceens'", "'--scenes'"],
    );
}

#[test]
fn list_shows_only_the_requested_kinds() {
    let sandbox = Sandbox::two_scenes();
    let list = |words: &[&str]| {
        let output = sandbox.shuttertruth(&[&["list"], words].concat());
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
    let all = sandbox.shuttertruth(&[&["list"], &elsewhere[..]].concat());
    assert!(stdout(&all).contains("bevy"));
    assert!(stderr(&all).contains("no scenes: there is no folder nowhere"));
    let misspelt = sandbox.shuttertruth(&[&["list", "mcgiure"], &elsewhere[..]].concat());
    assert_refused(&misspelt, 2, &["did you mean mcguire?"]);
    assert!(list(&["adapters"]).starts_with("0: "));
    assert!(list(&[]).lines().count() < 80);
}

#[test]
fn the_program_without_arguments_prints_its_help_and_fails() {
    let sandbox = Sandbox::new();
    let output = sandbox.shuttertruth(&[]);
    assert_eq!(output.status.code(), Some(2));
    let help = stderr(&output);
    assert_eq!(help, stdout(&sandbox.shuttertruth(&["--help"])));
    assert!(help.lines().count() <= 24, "{help}");
    assert!(
        help.lines().all(|line| line.chars().count() <= 80),
        "{help}"
    );
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    assert_eq!(commands.take_while(|line| !line.is_empty()).count(), 12);
}
