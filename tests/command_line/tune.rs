//! `tune`: the journal, what it survives, and what is said of what it found.

use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use filters::Filter;
use suite::{Trial, TrialOutcome, Tuning};

use crate::bench::{Bench, MTL, OBJ, SCENE, assert_done, assert_refused, split, stderr, stdout};

/// Ways of the plate in one frame, in metres, and the families that its scenes claim.
const SCENES: [(&str, &str, &str); 7] = [
    ("a", "-1.6", "translation"),
    ("b", "-1.2", "camera"),
    ("c", "0.9", "thin"),
    ("d", "1.3", "translation"),
    ("e", "-0.8", "camera"),
    ("f", "1.8", "thin"),
    ("g", "-2.0", "translation"),
];

/// A bench with scenes a to g.
fn bench() -> Bench {
    let bench = Bench::new();
    for (name, way, family) in SCENES {
        let scene = SCENE
            .replace("translation = [-1.6,", &format!("translation = [{way},"))
            .replace("\"translation\"", &format!("\"{family}\""));
        let folder = bench.path("scenes").join(name);
        fs::create_dir_all(&folder).unwrap();
        for (file, text) in [
            ("scene.toml", scene.as_str()),
            ("plate.obj", OBJ),
            ("plate.mtl", MTL),
        ] {
            fs::write(folder.join(file), text).unwrap();
        }
    }
    bench
}

/// A tuning of five parameters on six scenes, by what does not depend on a clock.
const TUNE: [&str; 17] = [
    "tune",
    "--quiet",
    "--filter",
    "jump_flood",
    "--from",
    "paper",
    "--vary",
    "samples=2..16,probes,match_threshold,jitter,foreground_extent",
    "--objective",
    "flip,bleed",
    "--scenes",
    "a,b,c,d,e,f,g",
    "--size",
    "64x32",
    "--samples-per-pixel",
    "16",
    "--budget",
];

fn tuning_words<'w>(out: &'w str, budget: &'w str, more: &[&'w str]) -> Vec<&'w str> {
    [&TUNE[..], &[budget, "--out", out], more].concat()
}

fn journal(bench: &Bench, out: &str) -> String {
    fs::read_to_string(bench.path(out).join("journal.jsonl")).unwrap()
}

fn trials(journal: &str) -> Vec<Trial> {
    let lines = journal.lines().skip(1);
    lines
        .map(|line| serde_json::from_str(line).unwrap())
        .collect()
}

fn tuning(bench: &Bench, out: &str) -> Tuning {
    serde_json::from_slice(&fs::read(bench.path(out).join("tune.json")).unwrap()).unwrap()
}

#[test]
fn a_tuning_beats_the_start_and_writes_down_how() {
    let bench = bench();
    let output = bench.shuttertruth(&tuning_words("out", "40", &["--sealed", "plate"]));
    assert_done(&output);
    let table = stdout(&output);
    for part in [
        "jump_flood:paper, 40 trials on 7 scenes",
        "the start",
        "chosen: trial",
        "family left out",
        "held-out scenes, evaluated once at 320x180",
        "FLIP of chosen against start",
    ] {
        assert!(table.contains(part), "\"{part}\" is missing from:\n{table}");
    }
    let journal = journal(&bench, "out");
    let trials = trials(&journal);
    assert_eq!(trials.len(), 40);
    // It begins with what was published and not with what another tuning found.
    let begun = |preset: &str| {
        let filter = Filter::builtin("jump_flood").unwrap();
        let values = filter.settings(Some(preset)).unwrap().values;
        trials[..13].iter().any(|trial| {
            let mut tried = trial.values.iter();
            tried.all(|(name, value)| values[name] == *value)
        })
    };
    assert!(["paper", "july_2024", "corrected"].map(begun) == [true; 3]);
    assert!(!begun("tuned"), "{journal}");
    // The published demo scales each trail by noise; another jitter alone takes some percent off, on these small plates.
    let tuning = tuning(&bench, "out");
    assert!(tuning.chosen.error.unwrap() < -0.01, "{table}");
    assert_eq!(tuning.start.error, Some(0.0));
    assert_eq!(tuning.start.values["samples"], filters::Value::Integer(8));
    assert!(
        tuning.dropped > 0,
        "seven scenes allow to drop what is worse on six"
    );
    let dropped = trials
        .iter()
        .filter(|it| it.outcome == TrialOutcome::Dropped);
    assert!(
        dropped
            .clone()
            .all(|it| it.scenes.len() == 6 && it.loss > tuning.chosen.loss)
    );
    assert_eq!(dropped.count(), tuning.dropped);
    let families: Vec<&str> = tuning
        .folds
        .iter()
        .map(|fold| fold.family.as_str())
        .collect();
    assert_eq!(families, ["camera", "thin", "translation"]);
    assert_eq!(tuning.openings.len(), 1);

    // The choice as a file is what the choice was.
    let params = bench.path("out/params.json");
    let words = split("evaluate --quiet --filter jump_flood --from paper --params");
    let scene = split("--scenes a --size 64x32 --samples-per-pixel 16 --out out");
    let params = [params.to_str().unwrap(), "--objective", "flip,bleed"];
    let output = bench.shuttertruth(&[&words[..], &params, &scene].concat());
    assert_done(&output);
    let answer: suite::Answer = serde_json::from_str(&stdout(&output)).unwrap();
    assert_eq!(answer.scenes["a"], tuning.chosen.scenes["a"]);
    assert_eq!(answer.values, tuning.values);
    // And as the preset of a filter.
    let filter = with_preset(&bench, "out/preset.toml");
    let preset = filter.presets.last().unwrap();
    assert_eq!(
        filter.settings(Some(&preset.name)).unwrap().values,
        tuning.values
    );
    let tuned = preset.tuned.as_ref().unwrap();
    assert_eq!((&tuned.from[..], tuned.trials), ("paper", tuning.trials));
    assert_eq!(tuned.size, [64, 32]);
    assert_eq!(tuned.samples_per_pixel, 16);
    let scenes: Vec<&String> = tuning.journal.scenes.iter().map(|(name, _)| name).collect();
    assert_eq!(tuned.scenes.iter().collect::<Vec<_>>(), scenes);

    // Another look at the same is no second opening; one at something else is.
    assert_done(&bench.shuttertruth(&tuning_words("out", "40", &["--sealed", "plate"])));
    assert_eq!(self::tuning(&bench, "out").openings.len(), 1);
    let other = ["--sealed", "plate", "--sealed-size", "64x32"];
    let output = bench.shuttertruth(&tuning_words("out", "40", &other));
    assert!(
        stdout(&output).contains("evaluated 2 times"),
        "{}",
        stdout(&output)
    );
    assert_eq!(self::journal(&bench, "out"), journal, "no trial was added");
}

#[test]
fn a_score_of_a_trial_is_that_of_a_run() {
    let bench = bench();
    assert_done(&bench.shuttertruth(&tuning_words("out", "1", &[])));
    assert_done(&bench.run(&["--filters", "jump_flood:paper", "--scenes", "a,b,c,d,e,f,g"]));
    let trial = &trials(&journal(&bench, "out"))[0];
    for case in bench.measured_filters() {
        let score = trial.scenes[&case.scene];
        assert_eq!(
            Some(score.flip),
            case.scores.moving.flip.value(),
            "{}",
            case.scene
        );
        let bleed = case.scores.get("bleed_lateral".parse().unwrap());
        assert_eq!(score.bleed, bleed.value(), "{}", case.scene);
    }
}

#[test]
fn a_killed_tuning_goes_on_where_it_was_and_ends_with_the_same_bytes() {
    let bench = bench();
    assert_done(&bench.shuttertruth(&tuning_words("whole", "30", &[])));
    let mut child = bench
        .command(&tuning_words("killed", "30", &[]))
        .spawn()
        .unwrap();
    let path = bench.path("killed/journal.jsonl");
    let began = Instant::now();
    while fs::read_to_string(&path).map_or(0, |text| text.lines().count()) < 8 {
        // Generous: it takes a second or two.
        assert!(
            began.elapsed() < Duration::from_secs(120),
            "no trial after two minutes"
        );
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = journal(&bench, "killed");
    assert!(left.lines().count() < 31, "it was killed on its way");
    // A line that was half written when the power failed.
    fs::write(&path, format!("{left}{{\"trial\":7")).unwrap();
    assert_done(&bench.shuttertruth(&tuning_words("killed", "30", &[])));
    assert_eq!(journal(&bench, "killed"), journal(&bench, "whole"));
}

#[test]
fn a_file_that_is_no_journal_of_this_tuning_is_left_as_it_was() {
    let bench = bench();
    let path = bench.path("out/journal.jsonl");
    fs::create_dir_all(bench.path("out")).unwrap();
    for foreign in [
        "my notes, without an end of line",
        "{\"format\":1}\nand half a line",
        "first line\nsecond line\n",
    ] {
        fs::write(&path, foreign).unwrap();
        let refused = bench.shuttertruth(&tuning_words("out", "4", &[]));
        assert_refused(&refused, 2, &["journal.jsonl:1:", "another --out"]);
        assert_eq!(fs::read_to_string(&path).unwrap(), foreign);
    }
}

#[test]
fn a_smaller_budget_is_the_beginning_of_a_larger_one_and_another_seed_is_another_search() {
    let bench = bench();
    assert_done(&bench.shuttertruth(&tuning_words("out", "12", &[])));
    let first = journal(&bench, "out");
    assert_done(&bench.shuttertruth(&tuning_words("out", "16", &[])));
    let second = journal(&bench, "out");
    assert!(second.starts_with(&first) && second.lines().count() == 17);
    let other = tuning_words("out", "16", &["--search-seed", "2"]);
    assert_refused(
        &bench.shuttertruth(&other),
        2,
        &[
            "journal.jsonl:1: it was begun with another design",
            "another --out",
        ],
    );
    assert_eq!(journal(&bench, "out"), second, "nothing is lost");
}

#[test]
fn what_cannot_be_tuned_is_refused_and_leaves_nothing_behind() {
    let bench = bench();
    fs::write(
        bench.path("scenes/g/scene.toml"),
        SCENE.replace("translation = [-1.6,", "translation = [0,"),
    )
    .unwrap();
    let rows: [(&[&str], &[&str]); 9] = [
        (&["--budget", "0"], &["--budget 0", "allowed is 1 or more"]),
        (
            &["--vary", "sample"],
            &["--vary sample", "no parameter", "samples"],
        ),
        (
            &["--vary", "samples=9..3"],
            &["--vary samples=9..3", "the range is empty"],
        ),
        (
            &["--scenes", "nowhere"],
            &["no scene \"nowhere\"", "allowed: a, b"],
        ),
        (&["--scenes", "a,a"], &["a is named twice"]),
        (&["--sealed", "b"], &["--sealed b", "proves nothing"]),
        (
            &["--cost-at-most", "1x"],
            &["--cost-at-most", "--objective flip,cost"],
        ),
        (&["--objective", "speed"], &["allowed: flip, bleed, cost"]),
        (&["--from", "fastest"], &["no preset \"fastest\"", "paper"]),
    ];
    let usual = [
        ("--budget", "2"),
        ("--filter", "jump_flood"),
        ("--scenes", "a"),
        ("--out", "out"),
    ];
    for (more, parts) in rows {
        let mut words = vec!["tune", "--quiet", "--objective", "flip"];
        if more[0] == "--objective" {
            words.truncate(2);
        }
        for (name, value) in usual.iter().filter(|(name, _)| *name != more[0]) {
            words.extend([name, value]);
        }
        if more[0] == "--sealed" {
            words.extend(["--vary", "samples"]);
            let at = words.iter().position(|word| *word == "a").unwrap();
            words[at] = "a,b";
        }
        assert_refused(&bench.shuttertruth(&[&words[..], more].concat()), 2, parts);
        assert!(
            !bench.path("out").exists(),
            "{more:?} left something behind"
        );
    }
    let still = split("tune --quiet --filter jump_flood --scenes g --size 64x32 --out out");
    let few = ["--samples-per-pixel", "16"];
    let output = bench.shuttertruth(&[&still[..], &few].concat());
    assert_refused(
        &output,
        2,
        &["scene g: nothing moves", "leave it out of --scenes"],
    );
}

/// A filter that is a program: it copies, and fails where its one parameter is above a half.
#[cfg(unix)]
fn fails_above_a_half(bench: &Bench, name: &str, default: &str) {
    use std::os::unix::fs::PermissionsExt;
    let folder = bench.path(name);
    fs::create_dir_all(&folder).unwrap();
    let manifest = format!(
        "name = \"{name}\"\nsummary = \"A program.\"\nalignment = \"trailing\"\n\
         command = [\"./blur.sh\", \"{{frame}}\", \"{{out}}\", \"{{strength}}\"]\n\
         [[parameter]]\nname = \"strength\"\nkind = \"real\"\nrange = [0.0, 1.0]\ndefault = {default}\ndoc = \"None.\"\n\
         [[preset]]\nname = \"default\"\ndoc = \"As it is.\"\n"
    );
    fs::write(folder.join("filter.toml"), manifest).unwrap();
    let script =
        "#!/bin/sh\ncase $3 in 0.[5-9]*|1*) echo too strong >&2; exit 7;; esac\ncp $1 $2\n";
    fs::write(folder.join("blur.sh"), script).unwrap();
    fs::set_permissions(folder.join("blur.sh"), fs::Permissions::from_mode(0o755)).unwrap();
}

#[cfg(unix)]
#[test]
fn a_candidate_that_fails_is_told_of_and_the_others_go_on() {
    let bench = bench();
    fails_above_a_half(&bench, "fragile", "0.25");
    let tune = |filter| {
        let words = [
            "tune",
            "--quiet",
            "--allow-commands",
            "--filter",
            filter,
            "--objective",
            "flip",
            "--scenes",
            "a,b",
        ];
        let more = split("--size 64x32 --samples-per-pixel 16 --budget 8 --out out");
        bench.shuttertruth(&[&words[..], &more].concat())
    };
    let output = tune("./fragile");
    assert_done(&output);
    let tuning = tuning(&bench, "out");
    assert_eq!(tuning.trials, 8);
    assert!((1..8).contains(&tuning.failed.len()), "{:?}", tuning.failed);
    let text = stdout(&output);
    assert!(
        text.contains("failed: trial") && text.contains("too strong"),
        "{text}"
    );
    for (trial, reason) in &tuning.failed {
        assert!(reason.contains("too strong"), "trial {trial}: {reason}");
    }
    // A start that fails leaves nothing to compare with.
    fails_above_a_half(&bench, "broken", "0.75");
    fs::remove_dir_all(bench.path("out")).unwrap();
    let output = tune("./broken");
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("too strong"),
        "{}",
        stderr(&output)
    );
}

/// A limit on the size of files stands for a disk that is full: either way, a write comes back with an error.
#[cfg(unix)]
#[test]
fn a_full_disk_loses_nothing() {
    let bench = bench();
    assert_done(&bench.shuttertruth(&tuning_words("out", "1", &[])));
    let begun = journal(&bench, "out");
    // Blocks of 512 bytes: room for some trials more.
    let blocks = (begun.len() + 2000).div_ceil(512).to_string();
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec {program} \"$@\"");
    let mut full = Command::new("sh");
    full.current_dir(bench.path("")).args(["-c", &script, "sh"]);
    let output = full.args(tuning_words("out", "20", &[])).output().unwrap();
    assert_refused(
        &output,
        2,
        &[
            "journal.jsonl: cannot be written",
            "whole trials are safe",
            "run the same command again",
        ],
    );
    let left = journal(&bench, "out");
    assert!(left.starts_with(&begun) && left.len() > begun.len());
    assert_done(&bench.shuttertruth(&tuning_words("out", "20", &[])));
    assert_done(&bench.shuttertruth(&tuning_words("whole", "20", &[])));
    assert_eq!(journal(&bench, "out"), journal(&bench, "whole"));
}

/// The built-in jump flood with a preset of a file instead of a tuned one of its own.
fn with_preset(bench: &Bench, preset: &str) -> Filter {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shaders/jump_flood");
    let read = |path: &Path| fs::read_to_string(path).unwrap();
    let mut filter: toml::Table = read(&folder.join("filter.toml")).parse().unwrap();
    let mut added: toml::Table = read(&bench.path(preset)).parse().unwrap();
    let presets = filter["preset"].as_array_mut().unwrap();
    presets.retain(|preset| preset["name"].as_str() != Some("tuned"));
    presets.append(added["preset"].as_array_mut().unwrap());
    let copy = bench.path("jump_flood");
    fs::create_dir(&copy).unwrap();
    fs::write(copy.join("filter.toml"), filter.to_string()).unwrap();
    fs::copy(folder.join("jump_flood.wgsl"), copy.join("jump_flood.wgsl")).unwrap();
    Filter::load(&copy).unwrap()
}

#[test]
fn two_presets_are_compared_scene_by_scene() {
    let bench = bench();
    let words = split("compare-presets paper corrected --quiet --filter jump_flood");
    let more = split("--scenes a,b,c,d,e,f,g --size 64x32 --samples-per-pixel 16 --out out");
    let output = bench.shuttertruth(&[&words[..], &more].concat());
    assert_done(&output);
    // Lines break where the terminal ends.
    let text = stdout(&output)
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    assert!(
        text.contains("FLIP of corrected against paper: -"),
        "{text}"
    );
    assert!(
        text.contains("over 7 scenes: corrected is better"),
        "{text}"
    );
    let same = split("compare-presets paper paper --quiet --filter jump_flood");
    let output = bench.shuttertruth(&[&same[..], &more].concat());
    let text = stdout(&output);
    assert!(
        text.contains("+0.0 % (+0.0 % to +0.0 %) over 7 scenes: undecided"),
        "{text}"
    );
    let old = split("tune --quiet --filter jump_flood --compare paper,tuned");
    let output = bench.shuttertruth(&[&old[..], &more].concat());
    assert_refused(&output, 2, &["--compare", "shuttertruth compare-presets"]);
}

#[test]
fn a_study_tells_what_matters() {
    let bench = bench();
    let words = split("sensitivity --quiet --filter jump_flood --from corrected --rows 16");
    let more = split("--vary samples,behind_extent --scenes a,b --size 64x32");
    let few = ["--samples-per-pixel", "16", "--out", "out"];
    let output = bench.shuttertruth(&[&words[..], &more, &few].concat());
    assert_done(&output);
    let found: suite::Sensitivity =
        serde_json::from_slice(&fs::read(bench.path("out/sensitivity.json")).unwrap()).unwrap();
    // Weighted taps do not read the extent at all, which replaced ones alone ask for.
    let extent = &found.parameters["behind_extent"];
    assert!(extent.constant && extent.slice.iter().all(|(_, error)| *error == 0.0));
    // Nine points of 1 to 64, of which two round to the same number.
    let samples = &found.parameters["samples"];
    assert!(!samples.constant && samples.slice.len() == 8, "{samples:?}");
    let table = stdout(&output);
    let row = |name: &str| {
        table
            .lines()
            .position(|line| line.trim_start().starts_with(name))
            .unwrap()
    };
    assert!(
        row("samples") < row("behind_extent"),
        "what matters comes first:\n{table}"
    );
}

#[test]
fn a_cost_is_a_ratio_to_the_start() {
    let bench = bench();
    let words = split("tune --quiet --filter jump_flood --vary samples --scenes a");
    let more = split("--size 64x32 --samples-per-pixel 16 --budget 6 --out out");
    assert_done(&bench.shuttertruth(&[&words[..], &more].concat()));
    let trials = trials(&journal(&bench, "out"));
    assert_eq!(trials[0].cost, Some(1.0));
    assert!(
        trials
            .iter()
            .all(|trial| trial.cost.is_some_and(|cost| cost > 0.0))
    );
    assert!(Path::new(&bench.path("out/tune.json")).is_file());
}
