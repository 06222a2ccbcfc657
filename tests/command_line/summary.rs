//! Output that a newcomer sees: the ranking, the report, kept cases, suggestions.

use std::fs;
use std::io::{BufRead, BufReader};
use std::process::Stdio;

use crate::bench::{
    Bench, assert_done, assert_refused, files_below, quick_command, stderr, stdout,
};

/// Makes a bench with a second scene, which moves at half the speed.
fn two_scenes() -> Bench {
    let bench = Bench::new();
    bench.copy_scene("slow", |text| text.replace("-1.6", "-0.8"));
    bench
}

fn names(bench: &Bench) -> Vec<String> {
    let cases = bench.read_filter_cases();
    let names = cases
        .iter()
        .map(|case| format!("{} {}", case.scene, case.name()));
    names.collect()
}

#[test]
fn a_run_ranks_filters_in_at_most_40_lines_and_names_the_report() {
    let bench = two_scenes();
    let output = bench.run(&["--jitter-frames", "0"]);
    assert_done(&output);
    let text = stdout(&output);
    assert!(text.lines().count() <= 40, "{text}");
    for words in [
        "mean over 2 scenes",
        "trailing shutter",
        "centred shutter",
        "references",
        "scatter_oracle",
        "worst scene",
        "--table shows all",
        "report: out/report.html",
        "0 of them read back",
        "took 0:",
    ] {
        assert!(text.contains(words), "\"{words}\" is missing from:\n{text}");
    }
    assert!(!text.contains("bounds"), "{text}");
    let page = fs::read_to_string(bench.path("out/report.html")).unwrap();
    assert!(page.contains("jump_flood"));
    let again = stdout(&bench.run(&["--jitter-frames", "0", "--table"]));
    assert!(again.lines().count() > 60, "{again}");
    let cases = bench.read_run().cases.len();
    assert!(
        again.contains(&format!("cases: {cases}, {cases} of them read back")),
        "{again}"
    );
}

#[test]
fn filters_within_noise_share_a_rank() {
    let bench = Bench::new();
    let text = stdout(&bench.run(&[
        "--filters",
        "jump_flood:paper,jump_flood_packed:paper,identity",
    ]));
    let ranks: Vec<&str> = (text.lines())
        .filter(|line| line.contains(":paper") || line.contains("identity:"))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert_eq!(ranks, ["1=", "1=", "3"], "{text}");
}

#[test]
fn a_narrower_run_keeps_the_cases_of_a_wider_one() {
    let bench = two_scenes();
    let filters = ["--filters", "identity,velocity_gather:fine,mcguire:paper"];
    assert_done(&bench.run(&filters));
    let before = names(&bench);
    assert_eq!(before.len(), 6);
    let narrow = bench.run(&["--scenes", "slow", "--filters", "velocity_gather:fine"]);
    assert_done(&narrow);
    assert!(
        stderr(&narrow).contains("keeps 5 cases of an earlier run"),
        "{}",
        stderr(&narrow)
    );
    // The ranking covers only the filters asked for.
    assert!(!stdout(&narrow).contains("mcguire"), "{}", stdout(&narrow));
    let mut after = names(&bench);
    after.sort();
    let mut sorted = before.clone();
    sorted.sort();
    assert_eq!(after, sorted);
    assert_eq!(bench.read_run().common_alignment, "centred");
    // The report shows all of them.
    assert!(
        fs::read_to_string(bench.path("out/report.html"))
            .unwrap()
            .contains("mcguire")
    );

    let more = ["--scenes", "slow", "--filters", "identity", "--seed", "2"];
    let refused = bench.run(&more);
    let parts = [
        "out/run.json",
        "5 cases",
        "seed was 1, now 2",
        "--out",
        "--no-cache",
    ];
    assert_refused(&refused, 2, &parts);
    assert_eq!(names(&bench).len(), 6);
    assert_done(&bench.run(&[&more[..], &["--no-cache"]].concat()));
    assert_eq!(names(&bench), ["slow identity:default"]);
}

#[test]
fn runs_of_two_sizes_lie_side_by_side() {
    let bench = Bench::new();
    bench.write(
        "bounds.toml",
        "[default]\nflip_moving = { limit = 0.9, size = [48, 24], why = \"it serves a test\" }\n",
    );
    let filters = ["--filters", "identity"];
    assert_done(&bench.run(&filters));
    let contents = || {
        let files = files_below(&bench.path("out")).into_iter();
        let kept = files.filter(|path| !path.starts_with(bench.path("out/48x24")));
        let contents = kept.map(|path| (fs::read(&path).unwrap(), path));
        contents.collect::<Vec<_>>()
    };
    let before = contents();
    // A check makes pictures of the size that its bounds hold at.
    let few = ["check", "--samples-per-pixel", "64", "--out", "out"];
    let check = bench.outside_ci(&[&few[..], &filters].concat());
    assert_done(&check);
    let note = "out holds a run of another picture size; this one, at 48x24, goes to out/48x24";
    assert!(stderr(&check).contains(note), "{}", stderr(&check));
    assert!(stdout(&check).contains("report: out/48x24/report.html"));
    assert!(contents() == before, "the run was changed");
    let run: suite::Run = bench.read_json("out/48x24/run.json");
    assert_eq!((run.render.width, run.render.height), (48, 24));
    // Both are read back.
    let again = bench.outside_ci(&[&few[..], &filters].concat());
    assert_eq!(stdout(&again), stdout(&check));
    assert!(stdout(&bench.run(&filters)).contains("cases: 7, 7 of them read back"));
}

#[test]
fn an_earlier_run_that_cannot_be_read_is_not_replaced() {
    let bench = Bench::new();
    let filters = ["--filters", "identity"];
    assert_done(&bench.run(&filters));
    let run = bench.path("out/run.json");
    let whole = fs::read(&run).unwrap();
    fs::write(&run, &whole[..whole.len() / 2]).unwrap();
    let refused = bench.run(&filters);
    let parts = [
        "out/run.json: no run of this program",
        "EOF",
        "repair or remove it",
        "--out",
        "--no-cache",
    ];
    assert_refused(&refused, 2, &parts);
    assert_eq!(fs::read(&run).unwrap().len(), whole.len() / 2);
    assert_done(&bench.run(&["--no-cache", "--filters", "identity"]));
    assert_eq!(names(&bench), ["plate identity:default"]);
}

#[test]
fn cases_of_a_scene_that_has_changed_are_dropped() {
    let bench = two_scenes();
    assert_done(&bench.run(&["--filters", "identity,velocity_gather:fine"]));
    let scene = fs::read_to_string(bench.path("scenes/plate/scene.toml")).unwrap();
    bench.write("scene.toml", &scene.replace("-1.6", "-1.2"));
    let narrow = bench.run(&["--scenes", "plate", "--filters", "identity"]);
    assert_done(&narrow);
    assert!(
        stderr(&narrow).contains("1 other was dropped"),
        "{}",
        stderr(&narrow)
    );
    let mut left = names(&bench);
    left.sort();
    let expected = [
        "plate identity:default",
        "slow identity:default",
        "slow velocity_gather:fine",
    ];
    assert_eq!(left, expected);
}

#[test]
fn an_override_shows_in_the_name_the_folder_and_the_tables() {
    let bench = Bench::new();
    let words = [
        "--filters",
        "velocity_gather:fine",
        "--set",
        "velocity_gather.samples=2",
    ];
    let output = bench.run(&words);
    assert_done(&output);
    let name = "velocity_gather:fine samples=2";
    assert!(stdout(&output).contains(name), "{}", stdout(&output));
    let table = stdout(&bench.run(&[&words[..], &["--table"]].concat()));
    assert!(table.contains(name), "{table}");
    let case = &bench.read_filter_cases()[0];
    assert_eq!(case.name(), name);
    assert_eq!(
        case.folder.to_str(),
        Some("plate/velocity_gather_fine_samples_2")
    );
    assert!(
        bench
            .path("out/plate/velocity_gather_fine_samples_2/output.exr")
            .is_file()
    );
    assert!(
        fs::read_to_string(bench.path("out/report.html"))
            .unwrap()
            .contains(name)
    );
}

#[test]
fn patterns_select_and_misspelt_names_get_a_suggestion() {
    let bench = two_scenes();
    assert_done(&bench.run(&[
        "--scenes",
        "sl*",
        "--filter",
        "velocity*:f*",
        "--filter",
        "ident*",
    ]));
    assert_eq!(
        names(&bench),
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
fn list_shows_only_the_requested_kinds() {
    let bench = two_scenes();
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

#[test]
fn colours_can_be_forced_and_disabled() {
    let bench = Bench::new();
    let list = |color: &str| stdout(&bench.shuttertruth(&["list", "--color", color]));
    assert!(list("always").contains('\u{1b}'));
    assert!(!list("never").contains('\u{1b}'));
}

#[test]
fn a_check_ends_with_its_verdict_and_counts_targets_apart() {
    let bench = Bench::new();
    let verdict = |bounds: &str, more: &[&str]| {
        fs::write(bench.path("scenes/bounds.toml"), bounds).unwrap();
        let output = bench.check(&[&["--filters", "identity"], more].concat());
        (output.status.code(), stdout(&output))
    };
    let target = "flip_moving = { limit = 0.2, why = \"it serves a test\", level = \"report\" }\n";
    let kept = "label_tv = { limit = 0.9, why = \"it serves a test\" }\n";
    let both = format!("[default]\n{target}{kept}");
    let (code, text) = verdict(&both, &[]);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.ends_with("\nPASS\n"), "{text}");
    assert!(text.contains("1 target: 1 missed"), "{text}");
    assert!(!text.contains("target missed flip_moving"), "{text}");
    let (_, text) = verdict(&both, &["-v"]);
    assert!(text.contains("target missed flip_moving"), "{text}");
    let (code, text) = verdict(
        &format!("[default]\n{}", target.replace(", level = \"report\"", "")),
        &[],
    );
    assert_eq!(code, Some(1), "{text}");
    assert!(
        text.ends_with("\nFAIL: a required bound is broken\n"),
        "{text}"
    );
}

#[test]
fn long_work_is_announced() {
    let bench = Bench::new();
    let mut child = bench
        .command(&["run", "--samples-per-pixel", "8192", "--size", "320x180"])
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let lines = BufReader::new(child.stderr.take().unwrap()).lines();
    let expected = lines
        .map_while(Result::ok)
        .find(|line| line.starts_with("expected: about "));
    child.kill().unwrap();
    child.wait().unwrap();
    let expected = expected.expect("the time is announced before anything is rendered");
    for words in [" min on ", "MB in out", "GB of memory", "cases"] {
        assert!(expected.contains(words), "{expected}");
    }
}

#[cfg(unix)]
#[test]
fn driver_messages_are_hidden_unless_requested_and_files_follow_the_umask() {
    use std::os::unix::fs::PermissionsExt;

    let bench = Bench::new();
    let words = [&quick_command("run", "16")[..], &["--filters", "identity"]].concat();
    let output = bench
        .command(&words)
        .env_remove("XDG_RUNTIME_DIR")
        .output()
        .unwrap();
    assert_done(&output);
    assert_eq!(stderr(&output), "");
    let verbose = [&words[..], &["-v"]].concat();
    let output = bench
        .command(&verbose)
        .env_remove("XDG_RUNTIME_DIR")
        .output()
        .unwrap();
    assert_done(&output);
    let probe = bench.path("probe");
    fs::write(&probe, "").unwrap();
    let mode = |path: &std::path::Path| fs::metadata(path).unwrap().permissions().mode();
    for file in [
        "run.json",
        "report.html",
        "plate/frame.exr",
        "plate/frame.png",
    ] {
        assert_eq!(mode(&bench.path("out").join(file)), mode(&probe), "{file}");
    }
}
