//! Kept cases: a case is measured again only if one of its inputs has changed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::time::SystemTime;

use frame::Alignment;
use metrics::{Measured, Metric};
use tests::filter_folder::{copy_shipped_filter, write_program};

use crate::bench::{Bench, assert_done, files_below, quick_command, stdout};

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

/// Makes a bench whose filter `mine` is a copy of a built-in one.
fn set_up() -> Bench {
    let bench = Bench::new();
    copy_shipped_filter("velocity_gather", &bench.path("mine"));
    bench
}

fn run(bench: &Bench, more: &[&str]) {
    assert_done(&bench.run(&[&FILTERS[..], more].concat()));
}

/// Reads the modification times of all files below `out`, except run.json.
fn read_times(bench: &Bench) -> BTreeMap<String, SystemTime> {
    let out = bench.path("out/plate");
    (files_below(&out).into_iter())
        .map(|path| {
            let name = path.strip_prefix(&out).unwrap().display().to_string();
            (name, fs::metadata(path).unwrap().modified().unwrap())
        })
        .collect()
}

/// Returns the folders of the cases that a run measures although it could have kept them.
fn find_measured_again(bench: &Bench, more: &[&str]) -> BTreeSet<String> {
    let before = read_times(bench);
    run(bench, more);
    (read_times(bench).into_iter())
        .filter(|(name, time)| name.ends_with("/case.json") && before.get(name) != Some(time))
        .map(|(name, _)| name.trim_end_matches("/case.json").to_owned())
        .collect()
}

fn names<'a>(lists: impl IntoIterator<Item = &'a [&'a str]>) -> BTreeSet<String> {
    let names = lists.into_iter().flatten();
    names.map(|name| (*name).to_owned()).collect()
}

/// Replaces one text by another in a file of the bench.
fn change(bench: &Bench, file: &str, from: &str, to: &str) {
    let text = fs::read_to_string(bench.path(file)).unwrap();
    assert!(text.contains(from), "{file} holds \"{from}\"");
    fs::write(bench.path(file), text.replacen(from, to, 1)).unwrap();
}

#[test]
fn a_second_run_touches_no_file_and_prints_the_same() {
    let bench = set_up();
    run(&bench, &[]);
    let first = fs::read(bench.path("out/run.json")).unwrap();
    let before = read_times(&bench);
    run(&bench, &[]);
    assert_eq!(read_times(&bench), before);
    assert!(fs::read(bench.path("out/run.json")).unwrap() == first);
    assert!(before.len() > 60, "{} files", before.len());
}

const NONE_KEEPS_IT: &str =
    "[default]\nflip_moving = { limit = 0.0001, why = \"none keeps it\" }\n";
const WORST: &str = "identity_default/worst_flip_moving.png";

/// Reads the modification times of all measured files. Evidence is not measured.
fn read_measured_times(bench: &Bench) -> BTreeMap<String, SystemTime> {
    let mut times = read_times(bench);
    times.retain(|name, _| !name.contains("worst_"));
    times
}

#[test]
fn a_kept_check_keeps_its_intervals() {
    let bench = set_up();
    bench.write("bounds.toml", NONE_KEEPS_IT);
    let check = || bench.check(&FILTERS);
    let first = stdout(&check());
    assert!(first.contains("flip_moving"), "{first}");
    let (run, before) = (bench.read_run(), read_measured_times(&bench));
    assert_eq!(stdout(&check()), first);
    assert_eq!(read_measured_times(&bench), before);
    let text = |run: &suite::Run| serde_json::to_string(run).unwrap();
    assert_eq!(text(&bench.read_run()), text(&run));

    let evidence = bench.path("out/plate").join(WORST);
    fs::remove_file(&evidence).unwrap();
    check();
    assert!(evidence.is_file(), "the evidence was not made anew");
}

#[test]
fn a_changed_bound_measures_nothing_again() {
    let bench = set_up();
    bench.write("bounds.toml", &NONE_KEEPS_IT.replace("0.0001", "0.1"));
    let broken = bench.check(&FILTERS);
    assert_eq!(broken.status.code(), Some(1), "{}", stdout(&broken));
    let before = read_measured_times(&bench);
    let all_keep_it = NONE_KEEPS_IT.replace("0.0001", "0.9");
    bench.write(
        "bounds.toml",
        &format!("# A comment moves the line.\n{all_keep_it}"),
    );
    assert_done(&bench.check(&FILTERS));
    assert_eq!(read_measured_times(&bench), before);
}

/// Lists the names of the files of ladders.
fn list_rungs(bench: &Bench) -> Vec<String> {
    let names = read_times(bench).into_keys();
    names.filter(|name| name.starts_with("ladder_")).collect()
}

#[test]
fn a_run_takes_the_truth_of_a_check_and_adds_the_ladder() {
    let bench = set_up();
    bench.write("bounds.toml", NONE_KEEPS_IT);
    bench.check(&FILTERS);
    let checked = bench.read_run();
    // Skill is counted from the sharp picture of the shutter's middle.
    assert_eq!(list_rungs(&bench), ["ladder_trailing/n1.exr"]);
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
    let before = read_times(&bench)[truth];
    let words = [&quick_command("run", "64")[..], &FILTERS].concat();
    bench.execute(&words);
    assert_eq!(
        read_times(&bench)[truth],
        before,
        "the truth was rendered again"
    );
    assert_eq!(list_rungs(&bench).len(), 7);
    // The output does not depend on what a check left.
    let kept = fs::read_to_string(bench.path("out/run.json")).unwrap();
    assert!(!bench.read_run().cases.iter().any(without));
    fs::remove_dir_all(bench.path("out")).unwrap();
    bench.execute(&words);
    assert!(fs::read_to_string(bench.path("out/run.json")).unwrap() == kept);
}

#[test]
fn a_check_takes_the_cases_of_a_run_with_intervals() {
    let bench = set_up();
    bench.write("bounds.toml", NONE_KEEPS_IT);
    bench.execute(&[&quick_command("run", "64")[..], &FILTERS, &["--intervals"]].concat());
    let before = read_measured_times(&bench);
    bench.check(&FILTERS);
    assert_eq!(read_measured_times(&bench), before);
}

#[test]
fn a_check_renders_the_ladder_that_a_limit_asks_for() {
    let bench = set_up();
    // The frame as it is has the error of about one sub-frame.
    let limit =
        "[filter.\"identity:default\"]\nn_eq = { limit = 100.0, why = \"none keeps it\" }\n";
    bench.write("bounds.toml", &format!("{NONE_KEEPS_IT}{limit}"));
    let checked = bench.check(&FILTERS);
    assert!(stdout(&checked).contains("n_eq"), "{}", stdout(&checked));
    assert_eq!(list_rungs(&bench).len(), 7);
}

#[test]
fn a_change_to_one_case_measures_only_that_case_again() {
    let bench = set_up();
    run(&bench, &[]);
    let mine = names([&OF_FILTERS[1..]]);

    let kernels = "mine/velocity_gather.wgsl";
    let text = fs::read_to_string(bench.path(kernels)).unwrap();
    fs::write(bench.path(kernels), format!(" {text}")).unwrap();
    assert_eq!(find_measured_again(&bench, &[]), mine, "a byte of WGSL");

    change(&bench, "mine/filter.toml", "samples = 8 ", "samples = 7 ");
    assert_eq!(find_measured_again(&bench, &[]), mine, "a preset's value");

    let set = ["--set", "velocity_gather.samples=9"];
    let changed: BTreeSet<String> = mine
        .iter()
        .map(|name| format!("{name}_samples_9"))
        .collect();
    assert_eq!(find_measured_again(&bench, &set), changed, "a parameter");
    assert_eq!(find_measured_again(&bench, &set), BTreeSet::new());

    let filters = names([&OF_FILTERS[..]]);
    let more = ["--jitter-frames", "3"];
    assert_eq!(
        find_measured_again(&bench, &more),
        filters,
        "frames of noise"
    );
}

#[test]
fn a_change_to_the_truth_or_the_frame_measures_all_cases_again() {
    let bench = set_up();
    run(&bench, &[]);
    let all = names([&BARS[..], &OF_FILTERS]);
    for more in [["--seed", "2"], ["--velocity", "previous_frame"]] {
        assert_eq!(find_measured_again(&bench, &more), all, "{more:?}");
    }
    change(
        &bench,
        "scenes/plate/scene.toml",
        "nothing: it serves",
        "nothing. It serves",
    );
    run(&bench, &[]);
    let said = bench.read_run().cases.into_iter().map(|case| case.exposes);
    assert_eq!(
        said.collect::<BTreeSet<_>>(),
        names([&["nothing. It serves the tests of the command line"][..]])
    );
}

#[test]
fn another_common_shutter_measures_the_compared_cases_again() {
    let bench = set_up();
    run(&bench, &[]);
    assert_eq!(bench.read_run().common_alignment, Alignment::Trailing);
    let again = find_measured_again(&bench, &["--filter", "bevy:default"]);
    assert_eq!(bench.read_run().common_alignment, Alignment::Centred);
    let all = names([&BARS[..], &OF_FILTERS]);
    assert!(again.is_superset(&all), "{again:?}");
    // A narrower run keeps the wider run's shutter.
    assert_eq!(find_measured_again(&bench, &[]), BTreeSet::new());
    assert_eq!(bench.read_run().common_alignment, Alignment::Centred);
}

#[test]
fn missing_truncated_and_altered_files_are_made_again() {
    let bench = set_up();
    run(&bench, &[]);
    let contents = |name: &str| fs::read(bench.path("out/plate").join(name)).unwrap();
    let run_json = fs::read(bench.path("out/run.json")).unwrap();
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
            let path = bench.path("out/plate").join(name);
            match damage(&whole) {
                None => fs::remove_file(&path).unwrap(),
                Some(bytes) => fs::write(&path, bytes).unwrap(),
            }
            assert_eq!(find_measured_again(&bench, &[]), *expected, "{name}");
            assert!(contents(name) == whole, "{name} is not as it was");
            assert!(fs::read(bench.path("out/run.json")).unwrap() == run_json);
        }
    }
}

#[cfg(unix)]
#[test]
fn a_program_runs_again_every_time() {
    let bench = Bench::new();
    write_program(
        &bench.path("copy"),
        "copy",
        "echo again >> runs\ncp $1 $2",
        "",
    );
    let runs = || {
        assert_done(&bench.run(&["--filter", "copy", "--allow-commands"]));
        let text = fs::read_to_string(bench.path("copy/runs")).unwrap();
        text.lines().count()
    };
    let first = runs();
    assert!(first > 0);
    assert_eq!(runs(), 2 * first);
    assert!(!bench.path("out/plate/copy_default/case.json").exists());
}
