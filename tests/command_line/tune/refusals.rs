//! Tunings that are refused, and candidates that fail.

use std::fs;

use tests::filter_folder::{write_manifest, write_script};

use super::{read_tuning, set_up};
use crate::sandbox::{SCENE, Sandbox, assert_done, assert_refused, split, stderr, stdout};

#[test]
fn bad_tunings_are_refused_and_leave_no_files() {
    let sandbox = set_up();
    fs::write(
        sandbox.path("scenes/g/scene.toml"),
        SCENE.replace("translation = [-1.6,", "translation = [0,"),
    )
    .unwrap();
    let rows: [(&[&str], &[&str]); 9] = [
        (&["--budget", "0"], &["--budget <N>", "0 is not in 1.."]),
        (
            &["--vary", "sample"],
            &["parameter sample:", "no parameter", "samples"],
        ),
        (
            &["--vary", "samples=9..3"],
            &["parameter samples=9..3", "the range is empty"],
        ),
        (
            &["--scenes", "nowhere"],
            &["no scene \"nowhere\"", "allowed: a, b"],
        ),
        (&["--scenes", "a,a"], &["a is named twice"]),
        (&["--held-out", "b"], &["scene b", "proves nothing"]),
        (
            &["--cost-at-most", "1x"],
            &["cost has a limit", "objectives: flip,cost"],
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
        let mut words = vec!["tune", "search", "--quiet", "--objective", "flip"];
        if more[0] == "--objective" {
            words.truncate(2);
        }
        for (name, value) in usual.iter().filter(|(name, _)| *name != more[0]) {
            words.extend([name, value]);
        }
        if more[0] == "--held-out" {
            words.extend(["--vary", "samples"]);
            let at = words.iter().position(|word| *word == "a").unwrap();
            words[at] = "a,b";
        }
        assert_refused(
            &sandbox.shuttertruth(&[&words[..], more].concat()),
            2,
            parts,
        );
        assert!(
            !sandbox.path("out").exists(),
            "{more:?} left something behind"
        );
    }
    let still = split("tune search --quiet --filter jump_flood --scenes g --size 64x32 --out out");
    let few = ["--samples-per-pixel", "16"];
    let output = sandbox.shuttertruth(&[&still[..], &few].concat());
    assert_refused(
        &output,
        2,
        &["scene g: nothing moves", "leave the scene out"],
    );
}

#[test]
fn a_choice_that_the_scenes_cannot_tell_from_the_start_gets_no_preset() {
    let sandbox = set_up();
    let words =
        split("tune search --quiet --filter jump_flood --from paper --vary samples=2..16,jitter");
    let few = split("--objective flip --scenes a,b --size 64x32 --samples-per-pixel 16 --out out");
    fs::create_dir(sandbox.path("out")).unwrap();
    fs::write(sandbox.path("out/preset.toml"), "of an earlier tuning").unwrap();
    let text = sandbox.execute(&[&words[..], &few, &["--budget", "12"]].concat());
    let text: Vec<&str> = text.split_whitespace().collect();
    let text = text.join(" ");
    let trial = read_tuning(&sandbox, "out").choice.trial;
    let reason = match trial {
        0 => "no trial beats it".to_owned(),
        trial => format!("2 scenes cannot tell trial {trial} from it, and 5 or more may"),
    };
    let sentence = format!("keep the start, no preset.toml is written: {reason}");
    assert!(text.contains(&sentence), "{text}");
    assert!(!sandbox.path("out/preset.toml").exists());
    assert!(sandbox.path("out/params.json").is_file());
}

/// Writes a filter that is a program: it copies its input, and fails if its one parameter is above a half.
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
    let tune = |filter| {
        let words = [
            "tune",
            "search",
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
        sandbox.shuttertruth(&[&words[..], &more].concat())
    };
    let output = tune("./fragile");
    assert_done(&output);
    let tuning = read_tuning(&sandbox, "out");
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
    fails_above_a_half(&sandbox, "broken", "0.75");
    fs::remove_dir_all(sandbox.path("out")).unwrap();
    let output = tune("./broken");
    assert_eq!(output.status.code(), Some(2));
    assert!(
        stderr(&output).contains("too strong"),
        "{}",
        stderr(&output)
    );
}
