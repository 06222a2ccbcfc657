//! `tune`: the search, the journal, the results and the refusals. A part of tests/command_line,
//! which is linked with the program once.

mod evaluate;
mod page;
mod results;

use std::fs;
use std::process::Command;
use std::sync::OnceLock;

use tests::filter_folder::{write_manifest, write_script};
use tests::text::{assert_contains, squeeze};
use tune::{Trial, Tuning};

use crate::child::wait_until;
use crate::sandbox::{SCENE, Sandbox, assert_done, assert_refused, split, stderr, stdout};

/// Scenes: name, distance that the plate moves in one frame in metres, and family.
const SCENES: [(&str, &str, &str); 7] = [
    ("a", "-1.6", "translation"),
    ("b", "-1.2", "camera"),
    ("c", "0.9", "thin"),
    ("d", "1.3", "translation"),
    ("e", "-0.8", "camera"),
    ("f", "1.8", "thin"),
    ("g", "-2.0", "translation"),
];

/// Makes a sandbox with scenes a to g.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    for (name, way, family) in SCENES {
        sandbox.copy_scene(name, |text| {
            let exposes = text.replace("nothing:", "a copy:");
            let moved = exposes.replace("translation = [-1.6,", &format!("translation = [{way},"));
            moved.replace("\"translation\"", &format!("\"{family}\""))
        });
    }
    sandbox
}

/// Tuning of five parameters by scores that do not depend on a clock.
const TUNE: &str = "tune search --quiet --filter jump_flood --from paper \
    --vary samples=2..16,probes,match_threshold,jitter,foreground_extent --objective flip,bleed \
    --size 64x32 --samples-per-pixel 16";

/// Words for two scenes, or for more.
const ON_TWO: &str = "--scenes a,b";
const ON_SEVEN: &str = "--scenes a,b,c,d,e,f,g";

/// Tunes in a folder; returns the output.
#[track_caller]
fn tune(sandbox: &Sandbox, out: &str, more: &str) -> String {
    sandbox.done(&format!("{TUNE} --out {out} {more}"))
}

fn read_journal(sandbox: &Sandbox, out: &str) -> String {
    fs::read_to_string(sandbox.path(out).join("journal.jsonl")).unwrap()
}

fn read_trials(sandbox: &Sandbox) -> Vec<Trial> {
    let journal = read_journal(sandbox, "out");
    let trials = journal.lines().skip(1).map(serde_json::from_str);
    trials.collect::<Result<_, _>>().unwrap()
}

fn read_tuning(sandbox: &Sandbox) -> Tuning {
    sandbox.read_json("out/tune.json")
}

const SEARCH: &str = "tune search --quiet --size 64x32 --samples-per-pixel 16 --out out";

/// More words of `tune search`, and parts of the message.
const BAD_TUNINGS: [(&str, &[&str]); 7] = [
    (
        "--scenes nowhere",
        &[r#"no scene "nowhere""#, "allowed: a, b"],
    ),
    ("--scenes a,a", &["a is named twice"]),
    (
        "--scenes a,b --held-out b --vary samples",
        &["scene b", "proves nothing"],
    ),
    (
        "--scenes a --vary sample",
        &["parameter sample:", "no parameter", "samples"],
    ),
    (
        "--scenes a --vary samples=9..3",
        &["parameter samples=9..3", "the range is empty"],
    ),
    (
        "--scenes a --cost-at-most 1x",
        &["cost has a limit", "objectives: flip,cost"],
    ),
    (
        "--scenes a --from fastest",
        &[r#"no preset "fastest""#, "paper"],
    ),
];

/// Words of a command line, and the message.
const BAD_WORDS: [(&str, &str); 4] = [
    (
        "tune search --filter jump_flood --budget 10000000000000 --out out",
        "10000000000000 is not in 1..=1000000",
    ),
    (
        "tune sensitivity --filter jump_flood --rows 10000000000000 --out out",
        "10000000000000 is not in 2..=1000000",
    ),
    (
        "tune --filter jump_flood",
        "tune: use shuttertruth tune search",
    ),
    (
        "compare-presets a b",
        "compare-presets: use shuttertruth tune compare",
    ),
];

#[test]
fn bad_tunings_are_refused_and_leave_no_files() {
    let sandbox = set_up();
    let still = SCENE.replace("translation = [-1.6,", "translation = [0,");
    sandbox.put("scenes/g/scene.toml", still);
    let search = format!("{SEARCH} --filter jump_flood --budget 2");
    sandbox.refuse_each(&format!("{search} --objective flip"), &BAD_TUNINGS);
    for (words, message) in BAD_WORDS {
        sandbox.refuse(words, &[message]);
    }
    let speed = format!("{search} --scenes a --objective speed");
    sandbox.refuse(&speed, &["allowed: flip, bleed, cost"]);
    assert!(!sandbox.path("out").exists(), "nothing is written");
    let parts = ["scene g: nothing moves", "leave the scene out"];
    sandbox.refuse(&format!("{search} --scenes g"), &parts);
}

#[test]
fn a_choice_that_the_scenes_cannot_tell_from_the_start_gets_no_preset() {
    let sandbox = set_up();
    fs::create_dir(sandbox.path("out")).unwrap();
    sandbox.put("out/preset.toml", "of an earlier tuning");
    let more = "--filter jump_flood --from paper --vary samples=2..16,jitter \
        --objective flip --scenes a,b --budget 12";
    let text = squeeze(&sandbox.done(&format!("{SEARCH} {more}")));
    let reason = match read_tuning(&sandbox).choice.trial {
        0 => "no trial beats it".to_owned(),
        trial => format!("2 scenes cannot separate trial {trial} from it, and 5 or more may"),
    };
    let sentence = format!("keep the start, no preset.toml is written: {reason}");
    assert_contains(&text, &[&sentence]);
    assert!(!sandbox.path("out/preset.toml").exists());
    assert!(sandbox.path("out/params.json").is_file());
}

/// Writes a filter that is a program: it copies its input, and fails if its one parameter is above
/// a half.
#[cfg(unix)]
fn fails_above_a_half(sandbox: &Sandbox, name: &str, default: &str) {
    let parameter = format!(
        "command = [\"./blur.sh\", \"{{frame}}\", \"{{out}}\", \"{{strength}}\"]\n\
         [[parameter]]\nname = \"strength\"\nkind = \"real\"\nrange = [0.0, 1.0]\ndefault = {default}\ndoc = \"None.\"\n\
         [[preset]]\nname = \"default\"\ndoc = \"As it is.\""
    );
    write_manifest(&sandbox.path(name), name, &parameter);
    let script = "case $3 in 0.[5-9]*|1*) echo too strong >&2; exit 7;; esac\ncp $1 $2";
    write_script(&sandbox.path(name).join("blur.sh"), script);
}

#[cfg(unix)]
#[test]
fn a_failing_candidate_is_reported_and_the_tuning_goes_on() {
    let sandbox = set_up();
    fails_above_a_half(&sandbox, "fragile", "0.25");
    fails_above_a_half(&sandbox, "broken", "0.75");
    let tune = |filter: &str| {
        let more = "--allow-commands --objective flip --scenes a,b --budget 8";
        let line = format!("{SEARCH} {more} --filter {filter}");
        sandbox.shuttertruth(&split(&line))
    };
    let output = tune("./fragile");
    assert_done(&output);
    let tuning = read_tuning(&sandbox);
    assert_eq!(tuning.trials, 8);
    assert!((1..8).contains(&tuning.failed.len()), "{:?}", tuning.failed);
    assert_contains(&stdout(&output), &["failed: trial", "too strong"]);
    for reason in tuning.failed.values() {
        assert_contains(reason, &["too strong"]);
    }
    // A failing start leaves nothing to compare with.
    fs::remove_dir_all(sandbox.path("out")).unwrap();
    let output = tune("./broken");
    assert_eq!(output.status.code(), Some(2));
    assert_contains(&stderr(&output), &["too strong"]);
}

/// Thirteen trials of presets and of a fixed design, and three that depend on the ones before.
const BUDGET: &str = "--scenes a,b --budget 16";

/// Returns the journal of an undisturbed tuning, which runs once for all tests.
fn whole() -> &'static str {
    static JOURNAL: OnceLock<String> = OnceLock::new();
    JOURNAL.get_or_init(|| {
        let sandbox = set_up();
        tune(&sandbox, "out", BUDGET);
        read_journal(&sandbox, "out")
    })
}

#[test]
fn a_killed_tuning_resumes_and_ends_with_the_same_bytes() {
    let sandbox = set_up();
    let words = format!("{TUNE} --out out {BUDGET}");
    let mut child = sandbox.command(&split(&words)).spawn().unwrap();
    let path = sandbox.path("out/journal.jsonl");
    wait_until(&mut child, || {
        fs::read_to_string(&path).is_ok_and(|text| text.lines().count() >= 4)
    });
    child.kill().unwrap();
    child.wait().unwrap();
    let left = read_journal(&sandbox, "out");
    assert!(left.lines().count() < 17, "it was killed on its way");
    // A power failure left this line half-written.
    fs::write(&path, format!("{left}{{\"trial\":7")).unwrap();
    tune(&sandbox, "out", BUDGET);
    assert_eq!(read_journal(&sandbox, "out"), whole());
}

#[test]
fn a_larger_budget_extends_a_smaller_one_and_another_seed_searches_differently() {
    let sandbox = set_up();
    let mut before = String::new();
    for (budget, lines) in [("4", 5), ("8", 9)] {
        tune(&sandbox, "out", &format!("{ON_TWO} --budget {budget}"));
        let journal = read_journal(&sandbox, "out");
        assert!(journal.starts_with(&before) && journal.lines().count() == lines);
        before = journal;
    }
    let other = format!("{TUNE} --out out {ON_TWO} --budget 8 --search-seed 2");
    let output = sandbox.shuttertruth(&split(&other));
    let parts = [
        "journal.jsonl:1: it was begun with another seed: found 1, this command has 2",
        "to go on with it, search with the seed 1",
        "another output folder",
    ];
    assert_refused(&output, 2, &parts);
    let said = stderr(&output);
    assert!(said.len() < 400, "a wall of numbers: {said}");
    assert_eq!(read_journal(&sandbox, "out"), before, "nothing is lost");
}

#[test]
fn an_edited_journal_is_refused_with_its_line() {
    let sandbox = set_up();
    let tuning = format!("{ON_TWO} --budget 4");
    tune(&sandbox, "out", &tuning);
    let journal = read_journal(&sandbox, "out");
    let lines: Vec<&str> = journal.lines().collect();
    let without_a_trial = [&lines[..2], &lines[3..]].concat().join("\n") + "\n";
    let flip = journal.find("\"flip\":").unwrap() + "\"flip\":".len();
    let negative = format!("{}-{}", &journal[..flip], &journal[flip..]);
    for (edited, reason) in [
        (without_a_trial, ":3: trial 2, expected 1"),
        (negative, ":2: flip is -"),
        (
            journal.replacen("{\"trial\":1", "\"trial\":1", 1),
            ":3: is no trial",
        ),
    ] {
        assert_ne!(edited, journal);
        sandbox.put("out/journal.jsonl", &edited);
        let line = format!("{TUNE} --out out {tuning}");
        sandbox.refuse(&line, &[&format!("journal.jsonl{reason}"), "begin anew"]);
        assert_eq!(read_journal(&sandbox, "out"), edited, "nothing is lost");
    }
}

/// Limits the size of files, as a substitute for a full disk: either way, a write fails.
#[cfg(unix)]
#[test]
fn a_full_disk_loses_nothing() {
    let sandbox = set_up();
    tune(&sandbox, "out", &format!("{ON_TWO} --budget 1"));
    let begun = read_journal(&sandbox, "out");
    // Blocks of 512 bytes, with room for a few more trials.
    let blocks = (begun.len() + 2000).div_ceil(512).to_string();
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec {program} \"$@\"");
    let mut full = Command::new("sh");
    full.current_dir(sandbox.path(""))
        .args(["-c", &script, "sh"]);
    let words = format!("{TUNE} --out out {BUDGET}");
    let output = full.args(split(&words)).output().unwrap();
    let parts = [
        "journal.jsonl: cannot be written",
        "whole trials are safe",
        "run the same command again",
    ];
    assert_refused(&output, 2, &parts);
    let left = read_journal(&sandbox, "out");
    assert!(left.starts_with(&begun) && left.len() > begun.len());
    tune(&sandbox, "out", BUDGET);
    assert_eq!(read_journal(&sandbox, "out"), whole());
}
