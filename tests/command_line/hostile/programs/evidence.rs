//! Files in `--out` that a check must not trust.

use std::fs;

use metrics::Measured;
use serde_json::{Value, json};

use crate::sandbox::{IDENTITY, Sandbox, assert_refused, quick_command, stdout};

const RECORD: &str = "out/plate/identity_default/case.json";

/// Makes a sandbox whose scene has a bound that the identity breaks.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write_bound(0.2);
    sandbox
}

/// Writes a good score and the record's hash anew, as anybody could.
fn forge(sandbox: &Sandbox) {
    let mut record: Value = sandbox.read_json(RECORD);
    let good = serde_json::to_value(Measured::score(0.001, 0.001)).unwrap();
    for (pointer, value) in [
        ("/made/scores/moving/flip", good),
        ("/made/intervals/flip_moving/low", json!(0.0)),
        ("/made/intervals/flip_moving/high", json!(0.002)),
    ] {
        *record.pointer_mut(pointer).expect(pointer) = value;
    }
    record["hash"] = json!("");
    let text = record.to_string();
    let hash = blake3::hash(text.as_bytes()).to_hex();
    sandbox.put(
        RECORD,
        text.replacen("\"hash\":\"\"", &format!("\"hash\":\"{hash}\""), 1),
    );
}

#[test]
fn a_check_without_cache_ignores_a_forged_record() {
    let sandbox = set_up();
    let first = sandbox.check(&IDENTITY);
    assert_eq!(first.status.code(), Some(1));
    forge(&sandbox);
    let trusting = sandbox.check(&IDENTITY);
    let code = trusting.status.code();
    assert_eq!(code, Some(0), "a folder of one's own is trusted");
    let anew = sandbox.check(&[&IDENTITY[..], &["--no-cache"]].concat());
    assert_eq!(anew.status.code(), Some(1));
    assert_eq!(stdout(&anew), stdout(&first));
    // The new measurement is kept.
    assert_eq!(stdout(&sandbox.check(&IDENTITY)), stdout(&first));
}

#[test]
fn a_check_refuses_a_folder_tracked_by_git() {
    let sandbox = set_up();
    let first = sandbox.check(&IDENTITY);
    sandbox.git("init -q");
    // The folder is below a work tree without being part of it.
    assert_eq!(stdout(&sandbox.check(&IDENTITY)), stdout(&first));
    forge(&sandbox);
    sandbox.git(&format!("add -f {RECORD}"));
    let parts = [RECORD, "is tracked by git", "--no-cache"];
    assert_refused(&sandbox.check(&IDENTITY), 2, &parts);
    let parts = [RECORD, "is tracked by git", "measure it now"];
    sandbox.refuse("check out/run.json", &parts);

    sandbox.git(&format!("rm -q --cached {RECORD}"));
    fs::create_dir(sandbox.path("kept")).unwrap();
    sandbox.put("kept/frame.exr", "a change brings it");
    sandbox.git("add -f kept/frame.exr");
    let with_truths = [&IDENTITY[..], &["--truths", "kept"]].concat();
    let parts = "kept/frame.exr | is tracked by git | --truths";
    assert_refused(&sandbox.check(&with_truths), 2, parts);

    sandbox.git(&format!("add -f {RECORD}"));
    let words = [&quick_command("check", "64")[..], &IDENTITY].concat();
    let mut without_git = sandbox.command(&words);
    without_git.env("PATH", "/nowhere").env_remove("CI");
    let output = without_git.output().unwrap();
    assert_refused(&output, 2, &["cannot find out", "git: ", "--no-cache"]);
    // Git cannot track a file that does not exist.
    fs::remove_dir_all(sandbox.path("out")).unwrap();
    assert_eq!(without_git.output().unwrap().status.code(), Some(1));
}

/// A repository's settings, such as `core.fsmonitor`, can make git start programs.
#[cfg(unix)]
#[test]
fn a_nested_repository_starts_no_program() {
    let sandbox = set_up();
    sandbox.git("init -q");
    sandbox.git("init -q --bare out");
    let hook = format!("touch {}", sandbox.path("ran").display());
    let config = format!("[core]\nbare = false\nworktree = .\nfsmonitor = {hook}\n");
    sandbox.put("out/config", config);
    assert_refused(&sandbox.check(&IDENTITY), 2, &["cannot find out whether"]);
    assert!(!sandbox.path("ran").exists(), "a program ran");
}
