//! Arguments: patterns, paths, lists, adapters and help.

use serde_json::Value;
use tests::filter_folder::copy_shipped_filter;
use tests::text::assert_contains;

use crate::sandbox::{Sandbox, assert_done, split, stderr, stdout};

#[test]
fn patterns_select() {
    let sandbox = Sandbox::two_scenes();
    let words = split("--scenes sl* --filter velocity*:f* --filter ident*");
    assert_done(&sandbox.run(&words));
    let due = ["slow velocity_gather:fine", "slow identity:default"];
    assert_eq!(sandbox.read_case_names(), due);
}

#[test]
fn a_user_s_scenes_and_filters_are_given_by_path() {
    let sandbox = Sandbox::new();
    let mine = sandbox.path("my_blur");
    copy_shipped_filter("velocity_gather", &mine);
    let absolute = mine.display().to_string();
    let absolute = format!("--filter {absolute}");
    for filter in ["--filter my_blur", &absolute, "--filters ./my_blur:fine"] {
        let scene = "--scenes ./scenes/plate --scenes-dir nowhere";
        let printed = sandbox.measure(&format!("{scene} {filter}"));
        assert_contains(&printed, &["velocity_gather:fine"]);
    }
}

#[test]
fn list_shows_only_the_requested_kinds() {
    let sandbox = Sandbox::two_scenes();
    for (line, there, absent) in [
        ("list scenes", "plate", "mcguire"),
        ("list filters", "mcguire", "plate"),
        ("list mcguire", ":paper", "jimenez"),
        ("list filters --scenes-dir nowhere", "bevy", "plate"),
        ("list bevy --scenes-dir nowhere", "bevy", "plate"),
    ] {
        let listed = sandbox.done(line);
        let is_right = listed.contains(there) && !listed.contains(absent);
        assert!(is_right, "{line}: {listed}");
    }
    let all = sandbox.shuttertruth(&split("list --scenes-dir nowhere"));
    assert!(stdout(&all).contains("bevy"));
    assert!(stderr(&all).contains("no scenes: there is no folder nowhere"));
    assert!(sandbox.done("list adapters").starts_with("0: "));
    assert!(sandbox.execute(&["list"]).lines().count() < 80);
}

#[test]
fn list_shows_scenes_filters_parameters_and_presets() {
    let sandbox = Sandbox::new();
    let listed = sandbox.done("list plate identity velocity_gather jump_flood mcguire kino");
    let parts = [
        "plate",
        "nothing: it serves",
        "identity",
        "velocity_gather",
        "jump_flood",
        "paper",
        "samples",
        "source: https://github.com/keijiro/KinoMotion at",
        "differs: Tiles hold 32-bit floats",
        "published: McGuire, Hennessy, Bukowski and Osman 2012",
        "made for pictures 1280 pixels wide",
        ".tile_size = 20 pixels",
    ];
    assert_contains(&listed, &parts);
    let json: Value = serde_json::from_str(&sandbox.execute(&["list", "--json"])).unwrap();
    assert_eq!(json["scenes"][0]["name"], "plate");
    let filters = json["filters"].as_array().unwrap();
    assert_eq!(filters.len(), filters::Filter::builtin_names().len());
    let bevy = filters.iter().find(|filter| filter["name"] == "bevy");
    let source = &bevy.unwrap()["presets"][0]["source"];
    assert_eq!(source["repository"], "https://github.com/bevyengine/bevy");
    assert_eq!(source["commit"].as_str().unwrap().len(), 40);
    let path = source["paths"][0].as_str().unwrap();
    assert!(path.ends_with("motion_blur.wesl"), "{path}");
    assert!(source["differs"].as_array().unwrap().len() > 1);
    assert_eq!(source["publication"], Value::Null);
}

#[test]
fn the_program_without_arguments_prints_its_help_and_fails() {
    let sandbox = Sandbox::new();
    let output = sandbox.shuttertruth(&[]);
    assert_eq!(output.status.code(), Some(2));
    let help = stderr(&output);
    assert_eq!(help, sandbox.execute(&["--help"]));
    assert!(help.lines().count() <= 24, "{help}");
    let fits = help.lines().all(|line| line.chars().count() <= 80);
    assert!(fits, "{help}");
    let commands = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    assert_eq!(commands.take_while(|line| !line.is_empty()).count(), 14);
}
