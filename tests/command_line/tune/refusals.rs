//! Tunings that are refused, and candidates that fail.

use std::fs;

use tests::filter_folder::{write_manifest, write_script};
use tests::text::{assert_contains, squeeze};

use super::{read_tuning, set_up};
use crate::sandbox::{SCENE, Sandbox, assert_done, split, stderr, stdout};

const SEARCH: &str = "tune search --quiet --size 64x32 --samples-per-pixel 16 --out out";

#[test]
fn bad_tunings_are_refused_and_leave_no_files() {
    let sandbox = set_up();
    let still = SCENE.replace("translation = [-1.6,", "translation = [0,");
    sandbox.put("scenes/g/scene.toml", still);
    let search = format!("{SEARCH} --filter jump_flood --budget 2");
    sandbox.refuse_rows(
        &format!("{search} --objective flip"),
        r#"
        --scenes nowhere => no scene "nowhere" | allowed: a, b
        --scenes a,a => a is named twice
        --scenes a,b --held-out b --vary samples => scene b | proves nothing
        --scenes a --vary sample => parameter sample: | no parameter | samples
        --scenes a --vary samples=9..3 => parameter samples=9..3 | the range is empty
        --scenes a --cost-at-most 1x => cost has a limit | objectives: flip,cost
        --scenes a --from fastest => no preset "fastest" | paper
        "#,
    );
    let rows = "--scenes a --objective speed => allowed: flip, bleed, cost";
    sandbox.refuse_rows(&search, rows);
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
