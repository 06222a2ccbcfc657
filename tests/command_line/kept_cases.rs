//! Kept cases: a case is measured again only if one of its inputs has changed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::time::SystemTime;

use frame::Alignment;
use metrics::{Measured, Metric};
use tests::filter_folder::{copy_shipped_filter, write_program};

use crate::sandbox::{Sandbox, assert_done, files_below, quick_command, stdout};

/// Two presets of a filter of the tests' own, beside the identity.
const FILTERS: [&str; 4] = ["--filters", "identity", "--filter", "mine"];
const BARS: [&str; 7] = [
    "accumulate_16_trailing",
    "accumulate_1_trailing",
    "accumulate_4_trailing",
    "accumulate_64_trailing",
    "accumulate_8_trailing",
    "identity_trailing",
    "scatter_oracle_trailing",
];
const OF_FILTERS: [&str; 4] = [
    "identity_default",
    "velocity_gather_coarse",
    "velocity_gather_departure",
    "velocity_gather_fine",
];

/// Makes a sandbox whose filter `mine` is a copy of a built-in one.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    copy_shipped_filter("velocity_gather", &sandbox.path("mine"));
    sandbox
}

fn run(sandbox: &Sandbox, more: &[&str]) {
    assert_done(&sandbox.run(&[&FILTERS[..], more].concat()));
}

/// Reads the modification times of all files below `out`, except run.json.
fn read_times(sandbox: &Sandbox) -> BTreeMap<String, SystemTime> {
    let out = sandbox.path("out/plate");
    (files_below(&out).into_iter())
        .map(|path| {
            let name = path.strip_prefix(&out).unwrap().display().to_string();
            (name, fs::metadata(path).unwrap().modified().unwrap())
        })
        .collect()
}

/// Returns the folders of the cases that a run measures although it could have kept them.
fn find_measured_again(sandbox: &Sandbox, more: &[&str]) -> BTreeSet<String> {
    let before = read_times(sandbox);
    run(sandbox, more);
    (read_times(sandbox).into_iter())
        .filter(|(name, time)| name.ends_with("/case.json") && before.get(name) != Some(time))
        .map(|(name, _)| name.trim_end_matches("/case.json").to_owned())
        .collect()
}

fn names<'a>(lists: impl IntoIterator<Item = &'a [&'a str]>) -> BTreeSet<String> {
    let names = lists.into_iter().flatten();
    names.map(|name| (*name).to_owned()).collect()
}

/// Replaces one text by another in a file of the bench.
fn change(sandbox: &Sandbox, file: &str, from: &str, to: &str) {
    let text = fs::read_to_string(sandbox.path(file)).unwrap();
    assert!(text.contains(from), "{file} holds \"{from}\"");
    fs::write(sandbox.path(file), text.replacen(from, to, 1)).unwrap();
}

#[test]
fn a_second_run_touches_no_file_and_prints_the_same() {
    let sandbox = set_up();
    run(&sandbox, &[]);
    let first = fs::read(sandbox.path("out/run.json")).unwrap();
    let before = read_times(&sandbox);
    run(&sandbox, &[]);
    assert_eq!(read_times(&sandbox), before);
    assert!(fs::read(sandbox.path("out/run.json")).unwrap() == first);
    assert!(before.len() > 60, "{} files", before.len());
}

const NONE_KEEPS_IT: &str =
    "[default]\nflip_moving = { limit = 0.0001, why = \"none keeps it\" }\n";
const WORST: &str = "identity_default/worst_flip_moving.png";

/// Reads the modification times of all measured files. Evidence is not measured.
fn read_measured_times(sandbox: &Sandbox) -> BTreeMap<String, SystemTime> {
    let mut times = read_times(sandbox);
    times.retain(|name, _| !name.contains("worst_"));
    times
}

#[test]
fn a_kept_check_keeps_its_intervals() {
    let sandbox = set_up();
    sandbox.write("bounds.toml", NONE_KEEPS_IT);
    let check = || sandbox.check(&FILTERS);
    let first = stdout(&check());
    assert!(first.contains("flip_moving"), "{first}");
    let (run, before) = (sandbox.read_run(), read_measured_times(&sandbox));
    assert_eq!(stdout(&check()), first);
    assert_eq!(read_measured_times(&sandbox), before);
    let text = |run: &suite::Run| serde_json::to_string(run).unwrap();
    assert_eq!(text(&sandbox.read_run()), text(&run));

    let evidence = sandbox.path("out/plate").join(WORST);
    fs::remove_file(&evidence).unwrap();
    check();
    assert!(evidence.is_file(), "the evidence was not made anew");
}

#[test]
fn a_changed_bound_measures_nothing_again() {
    let sandbox = set_up();
    sandbox.write("bounds.toml", &NONE_KEEPS_IT.replace("0.0001", "0.1"));
    let broken = sandbox.check(&FILTERS);
    assert_eq!(broken.status.code(), Some(1), "{}", stdout(&broken));
    let before = read_measured_times(&sandbox);
    let all_keep_it = NONE_KEEPS_IT.replace("0.0001", "0.9");
    sandbox.write(
        "bounds.toml",
        &format!("# A comment moves the line.\n{all_keep_it}"),
    );
    assert_done(&sandbox.check(&FILTERS));
    assert_eq!(read_measured_times(&sandbox), before);
}

/// Lists the names of the files of ladders.
fn list_rungs(sandbox: &Sandbox) -> Vec<String> {
    let names = read_times(sandbox).into_keys();
    names.filter(|name| name.starts_with("ladder_")).collect()
}

#[test]
fn a_run_takes_the_truth_of_a_check_and_adds_the_ladder() {
    let sandbox = set_up();
    sandbox.write("bounds.toml", NONE_KEEPS_IT);
    sandbox.check(&FILTERS);
    let checked = sandbox.read_run();
    // Skill is counted from the sharp picture of the shutter's middle.
    assert_eq!(list_rungs(&sandbox), ["ladder_trailing/n1.exr"]);
    let accumulations = checked.cases.iter();
    let mut accumulations = accumulations.filter(|case| case.filter == "accumulate");
    assert!(accumulations.all(|case| case.preset == "1"));
    let without = |case: &suite::Case| {
        matches!(
            case.scores.get(Metric::SUBFRAMES),
            Measured::NotApplicable { .. }
        )
    };
    assert!(checked.cases.iter().all(without));

    let truth = "truth_trailing.exr";
    let before = read_times(&sandbox)[truth];
    let words = [&quick_command("run", "64")[..], &FILTERS].concat();
    sandbox.execute(&words);
    assert_eq!(
        read_times(&sandbox)[truth],
        before,
        "the truth was rendered again"
    );
    assert_eq!(list_rungs(&sandbox).len(), 7);
    // The output does not depend on what a check left.
    let kept = fs::read_to_string(sandbox.path("out/run.json")).unwrap();
    assert!(!sandbox.read_run().cases.iter().any(without));
    fs::remove_dir_all(sandbox.path("out")).unwrap();
    sandbox.execute(&words);
    assert!(fs::read_to_string(sandbox.path("out/run.json")).unwrap() == kept);
}

#[test]
fn a_check_takes_the_cases_of_a_run_with_intervals() {
    let sandbox = set_up();
    sandbox.write("bounds.toml", NONE_KEEPS_IT);
    sandbox.execute(&[&quick_command("run", "64")[..], &FILTERS, &["--intervals"]].concat());
    let before = read_measured_times(&sandbox);
    sandbox.check(&FILTERS);
    assert_eq!(read_measured_times(&sandbox), before);
}

#[test]
fn a_check_renders_the_ladder_that_a_limit_asks_for() {
    let sandbox = set_up();
    // The frame as it is has the error of about one sub-frame.
    let limit =
        "[filter.\"identity:default\"]\nn_eq = { limit = 100.0, why = \"none keeps it\" }\n";
    sandbox.write("bounds.toml", &format!("{NONE_KEEPS_IT}{limit}"));
    let checked = sandbox.check(&FILTERS);
    assert!(stdout(&checked).contains("n_eq"), "{}", stdout(&checked));
    assert_eq!(list_rungs(&sandbox).len(), 7);
}

#[test]
fn a_change_to_one_case_measures_only_that_case_again() {
    let sandbox = set_up();
    run(&sandbox, &[]);
    let mine = names([&OF_FILTERS[1..]]);

    let kernels = "mine/velocity_gather.wgsl";
    let text = fs::read_to_string(sandbox.path(kernels)).unwrap();
    fs::write(sandbox.path(kernels), format!(" {text}")).unwrap();
    assert_eq!(find_measured_again(&sandbox, &[]), mine, "a byte of WGSL");

    change(&sandbox, "mine/filter.toml", "samples = 8 ", "samples = 7 ");
    assert_eq!(find_measured_again(&sandbox, &[]), mine, "a preset's value");

    let set = ["--set", "velocity_gather.samples=9"];
    let changed: BTreeSet<String> = mine
        .iter()
        .map(|name| format!("{name}_samples_9"))
        .collect();
    assert_eq!(find_measured_again(&sandbox, &set), changed, "a parameter");
    assert_eq!(find_measured_again(&sandbox, &set), BTreeSet::new());

    let filters = names([&OF_FILTERS[..]]);
    let more = ["--jitter-frames", "3"];
    assert_eq!(
        find_measured_again(&sandbox, &more),
        filters,
        "frames of noise"
    );
}

#[test]
fn a_change_to_the_truth_or_the_frame_measures_all_cases_again() {
    let sandbox = set_up();
    run(&sandbox, &[]);
    let all = names([&BARS[..], &OF_FILTERS]);
    for more in [["--seed", "2"], ["--velocity", "previous_frame"]] {
        assert_eq!(find_measured_again(&sandbox, &more), all, "{more:?}");
    }
    change(
        &sandbox,
        "scenes/plate/scene.toml",
        "nothing: it serves",
        "nothing. It serves",
    );
    run(&sandbox, &[]);
    let said = sandbox
        .read_run()
        .cases
        .into_iter()
        .map(|case| case.exposes);
    assert_eq!(
        said.collect::<BTreeSet<_>>(),
        names([&["nothing. It serves the tests of the command line"][..]])
    );
}

#[test]
fn another_common_shutter_measures_the_compared_cases_again() {
    let sandbox = set_up();
    run(&sandbox, &[]);
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Trailing);
    let again = find_measured_again(&sandbox, &["--filter", "bevy:default"]);
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Centred);
    let all = names([&BARS[..], &OF_FILTERS]);
    assert!(again.is_superset(&all), "{again:?}");
    // A narrower run keeps the wider run's shutter.
    assert_eq!(find_measured_again(&sandbox, &[]), BTreeSet::new());
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Centred);
}

#[test]
fn missing_truncated_and_altered_files_are_made_again() {
    let sandbox = set_up();
    run(&sandbox, &[]);
    let contents = |name: &str| fs::read(sandbox.path("out/plate").join(name)).unwrap();
    let run_json = fs::read(sandbox.path("out/run.json")).unwrap();
    let cut = |bytes: &[u8]| bytes[..bytes.len() / 2].to_vec();
    type Damage<'a> = &'a dyn Fn(&[u8]) -> Option<Vec<u8>>;
    let damages: [Damage; 3] = [&|_| None, &|bytes| Some(cut(bytes)), &|bytes| {
        let mut bytes = bytes.to_vec();
        // Damages some bits of a pixel.
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        Some(bytes)
    }];
    let one = names([&["identity_default"][..]]);
    for (name, expected) in [
        ("identity_default/case.json", &one),
        ("identity_default/errors.exr", &one),
        ("identity_default/flip.png", &one),
        ("frame.png", &BTreeSet::new()),
        ("frame.exr", &BTreeSet::new()),
        ("truth_trailing.exr", &BTreeSet::new()),
        ("ladder_trailing/n4.exr", &BTreeSet::new()),
    ] {
        let whole = contents(name);
        // A record has the hashes of its files, and none of itself: whoever can change it can write any hash into it.
        let noticed = if name.ends_with(".json") { 2 } else { 3 };
        for damage in &damages[..noticed] {
            let path = sandbox.path("out/plate").join(name);
            match damage(&whole) {
                None => fs::remove_file(&path).unwrap(),
                Some(bytes) => fs::write(&path, bytes).unwrap(),
            }
            assert_eq!(find_measured_again(&sandbox, &[]), *expected, "{name}");
            assert!(contents(name) == whole, "{name} is not as it was");
            assert!(fs::read(sandbox.path("out/run.json")).unwrap() == run_json);
        }
    }
}

#[cfg(unix)]
#[test]
fn a_program_runs_again_every_time() {
    let sandbox = Sandbox::new();
    write_program(
        &sandbox.path("copy"),
        "copy",
        "echo again >> runs\ncp $1 $2",
        "",
    );
    let runs = || {
        assert_done(&sandbox.run(&["--filter", "copy", "--allow-commands"]));
        let text = fs::read_to_string(sandbox.path("copy/runs")).unwrap();
        text.lines().count()
    };
    let first = runs();
    assert!(first > 0);
    assert_eq!(runs(), 2 * first);
    assert!(!sandbox.path("out/plate/copy_default/case.json").exists());
}
