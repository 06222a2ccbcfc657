//! Kept cases: a case is measured again only if one of its inputs has changed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;
use std::sync::OnceLock;
use std::time::SystemTime;

use frame::Alignment;
use metrics::Metric;
use tests::filter_folder::{copy_shipped_filter, write_program};

use crate::sandbox::{Files, Sandbox, assert_done, files_below, quick_command, stderr, stdout};

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

const NONE_KEEPS_IT: &str =
    "[default]\nflip_moving = { limit = 0.0001, why = \"none keeps it\" }\n";
const WORST: &str = "identity_default/worst_flip_moving.png";

/// Makes a sandbox whose filter `mine` is a copy of a built-in one.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    copy_shipped_filter("velocity_gather", &sandbox.path("mine"));
    sandbox
}

/// Makes a sandbox with a finished run, which is made once for all tests.
fn measured() -> Sandbox {
    static FILES: OnceLock<Files> = OnceLock::new();
    Sandbox::of(FILES.get_or_init(|| {
        let sandbox = set_up();
        run(&sandbox, &[]);
        sandbox.read_files()
    }))
}

/// Makes a sandbox with a finished check, in which every case breaks its bound.
fn checked() -> Sandbox {
    static FILES: OnceLock<Files> = OnceLock::new();
    Sandbox::of(FILES.get_or_init(|| {
        let sandbox = set_up();
        sandbox.write("bounds.toml", NONE_KEEPS_IT);
        let output = sandbox.check(&FILTERS);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        sandbox.read_files()
    }))
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

/// Reads the modification times of all measured files. Evidence is not measured.
fn read_measured_times(sandbox: &Sandbox) -> BTreeMap<String, SystemTime> {
    let mut times = read_times(sandbox);
    times.retain(|name, _| !name.contains("worst_"));
    times
}

#[test]
fn a_second_run_touches_no_file() {
    let sandbox = measured();
    let read = || fs::read(sandbox.path("out/run.json")).unwrap();
    let (first, before) = (read(), read_times(&sandbox));
    run(&sandbox, &[]);
    assert_eq!(read_times(&sandbox), before);
    assert!(read() == first);
    assert!(before.len() > 60, "{} files", before.len());
}

#[test]
fn a_kept_check_keeps_its_intervals_under_any_bound() {
    let sandbox = checked();
    let text = || serde_json::to_string(&sandbox.read_run()).unwrap();
    let (first, before) = (text(), read_measured_times(&sandbox));
    let evidence = sandbox.path("out/plate").join(WORST);
    fs::remove_file(&evidence).unwrap();
    let printed = stdout(&sandbox.check(&FILTERS));
    assert!(printed.contains("BROKEN flip_moving"), "{printed}");
    assert!(text() == first);
    assert!(evidence.is_file(), "the evidence was not made anew");
    assert_eq!(stdout(&sandbox.check(&FILTERS)), printed);

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
    let sandbox = checked();
    let cases = sandbox.read_run().cases;
    // Skill is counted from the sharp picture of the shutter's middle.
    assert_eq!(list_rungs(&sandbox), ["ladder_trailing/n1.exr"]);
    let mut accumulations = cases.iter().filter(|case| case.filter == "accumulate");
    assert!(accumulations.all(|case| case.preset == "1"));
    let without = |case: &suite::Case| case.scores.get(Metric::SUBFRAMES).value().is_none();
    assert!(cases.iter().all(without));

    let truth = || read_times(&sandbox)["truth_trailing.exr"];
    let before = truth();
    let words = [&quick_command("run", "64")[..], &FILTERS].concat();
    sandbox.execute(&words);
    assert_eq!(truth(), before, "the truth was rendered again");
    assert_eq!(list_rungs(&sandbox).len(), 7);
    // The output does not depend on what a check left.
    let read = || fs::read_to_string(sandbox.path("out/run.json")).unwrap();
    let kept = read();
    assert!(!sandbox.read_run().cases.iter().any(without));
    fs::remove_dir_all(sandbox.path("out")).unwrap();
    sandbox.execute(&words);
    assert!(read() == kept);
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
    let sandbox = checked();
    // The frame as it is has the error of about one sub-frame.
    let limit =
        "[filter.\"identity:default\"]\nn_eq = { limit = 100.0, why = \"none keeps it\" }\n";
    sandbox.write("bounds.toml", &format!("{NONE_KEEPS_IT}{limit}"));
    let printed = stdout(&sandbox.check(&FILTERS));
    assert!(printed.contains("n_eq"), "{printed}");
    assert_eq!(list_rungs(&sandbox).len(), 7);
}

#[test]
fn a_change_to_one_case_measures_only_that_case_again() {
    let sandbox = measured();
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
    let sandbox = measured();
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
    let sandbox = measured();
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Trailing);
    let again = find_measured_again(&sandbox, &["--filter", "bevy:default"]);
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Centred);
    let all = names([&BARS[..], &OF_FILTERS]);
    assert!(again.is_superset(&all), "{again:?}");
    // A narrower run keeps the wider run's shutter.
    assert_eq!(find_measured_again(&sandbox, &[]), BTreeSet::new());
    assert_eq!(sandbox.read_run().common_alignment, Alignment::Centred);
}

/// Removes a file, cuts it in half, or changes one bit of a pixel.
fn damage(path: &Path, kind: &str) {
    let mut bytes = fs::read(path).unwrap();
    let middle = bytes.len() / 2;
    match kind {
        "missing" => return fs::remove_file(path).unwrap(),
        "cut" => bytes.truncate(middle),
        _ => bytes[middle] ^= 1,
    }
    fs::write(path, bytes).unwrap();
}

#[test]
fn missing_truncated_and_altered_files_are_made_again() {
    let sandbox = measured();
    let out = sandbox.path("out");
    let read = |name: &str| fs::read(out.join(name)).unwrap();
    let run_json = read("run.json");
    // Files that one run makes again; each of the first belongs to another case.
    let groups: [&[&str]; 5] = [
        &[
            "identity_default/errors.exr",
            "velocity_gather_coarse/flip.png",
            "velocity_gather_fine/case.json",
        ],
        &["frame.png"],
        &["frame.exr"],
        &["truth_trailing.exr"],
        &["ladder_trailing/n4.exr"],
    ];
    for (group, kind) in groups
        .iter()
        .flat_map(|group| ["missing", "cut", "altered"].map(|kind| (group, kind)))
    {
        // A record has the hashes of its files, and none of itself: whoever can change it can write any hash into it.
        let is_noticed = |name: &&&str| kind != "altered" || !name.ends_with(".json");
        let files: Vec<String> = group
            .iter()
            .filter(is_noticed)
            .map(|name| format!("plate/{name}"))
            .collect();
        let whole: Vec<_> = files.iter().map(|name| read(name)).collect();
        for name in &files {
            damage(&out.join(name), kind);
        }
        let cases = files
            .iter()
            .filter_map(|name| name["plate/".len()..].split_once('/'));
        let due = cases
            .map(|(case, _)| case)
            .filter(|case| !case.starts_with("ladder"));
        let due: BTreeSet<String> = due.map(str::to_owned).collect();
        assert_eq!(find_measured_again(&sandbox, &[]), due, "{kind}: {files:?}");
        for (name, whole) in files.iter().zip(whole) {
            assert!(read(name) == whole, "{kind}: {name} is not as it was");
        }
        assert!(read("run.json") == run_json);
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
