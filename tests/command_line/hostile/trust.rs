//! The rules of `docs/trust.md`.

use std::fs;
use std::process::{Command, Output};

use frame::Replicate;
use metrics::Measured;
use serde_json::{Value, json};
use tests::text::assert_contains;

use crate::sandbox::*;

const BLUR: &str =
    "engine blur --allow-commands --filter ./mine --frame out/plate/frame.exr --out b.exr";

/// Blurs with the script as the filter, for a minute at most.
fn blur(sandbox: &Sandbox, lines: &str, more: &str) -> Output {
    sandbox.write_program("mine", lines, more);
    let mut command = Command::new("timeout");
    command.arg("60").arg(env!("CARGO_BIN_EXE_shuttertruth"));
    command.envs([("GITHUB_TOKEN", "a"), ("CUDA_VISIBLE_DEVICES", "1")]);
    command.current_dir(sandbox.path("")).args(split(BLUR));
    command.output().unwrap()
}

#[test]
fn no_command_runs_a_program_without_permission() {
    let sandbox = Sandbox::measured();
    sandbox.write_program("mine", "touch ran; cp $1 $2", "");
    for line in [
        "run --out new --filter mine",
        "check --out new --filter mine",
        "limits calibrate --out new --filter mine",
        "engine blur --filter ./mine --frame out/plate/frame.exr --out b.exr",
        "tune search --out new --filter ./mine",
        "tune evaluate --out new --filter ./mine --params p.json",
    ] {
        let parts = [
            "./mine/filter.toml:4:",
            "`./blur.sh {frame} {out}`",
            "--allow-commands",
        ];
        sandbox.refuse(line, &parts);
        assert!(!sandbox.path("new").exists(), "{line}");
    }
    sandbox.done("list --filter mine");
    assert!(!sandbox.path("mine/ran").exists(), "it ran");
    sandbox.done(BLUR);
    assert!(sandbox.path("mine/ran").exists());
}

#[test]
fn a_program_gets_no_secret_from_the_environment() {
    let sandbox = Sandbox::measured();
    let named = "environment = [\"CUDA_VISIBLE_DEVICES\"]";
    assert_done(&blur(&sandbox, "env > seen; cp $1 $2", named));
    let seen = sandbox.text("mine/seen");
    assert!(!seen.contains("TOKEN"), "{seen}");
    assert_contains(&seen, &["CUDA_VISIBLE_DEVICES=1", "PATH="]);
}

/// Signals and the time limit are tested in `command_filter`.
#[cfg(target_os = "linux")]
#[test]
fn a_session_that_a_program_started_ends_with_it() {
    let sandbox = Sandbox::measured();
    let lines = "setsid sh -c 'echo $$ > pid.new; mv pid.new pid; exec sleep 300' &
                 while [ ! -e pid ]; do sleep 0.01; done; exit 7";
    assert_refused(
        &blur(&sandbox, lines, ""),
        2,
        &["ended with exit status: 7"],
    );
    assert!(sandbox.has_ended("mine/pid"));
}

/// Lines of a program that leaves something else in place of its output, and a part of the message.
/// The limit is 64 x 32 pixels of 256 bytes, and 1 MiB.
const OUTPUTS: [(&str, &str); 5] = [
    ("mkfifo $2", "left a pipe or a device in the place of {out}"),
    ("ln -s /dev/zero $2", "left a link in the place of {out}"),
    ("mkdir $2", "left a folder in the place of {out}"),
    (
        "head -c 20000000 /dev/zero > $2; sleep 300",
        "wrote an {out} of more than 1572864 bytes",
    ),
    (
        "truncate -s 1T $2",
        "wrote an {out} of more than 1572864 bytes",
    ),
];

#[test]
fn a_program_leaves_one_regular_file_of_limited_size_in_a_private_folder() {
    let sandbox = Sandbox::measured();
    for (lines, part) in OUTPUTS {
        assert_refused(&blur(&sandbox, lines, ""), 2, &[part]);
    }
    assert_done(&blur(&sandbox, "ls -ld $(dirname $2) > mode; cp $1 $2", ""));
    assert!(sandbox.text("mine/mode").starts_with("drwx------"));
}

const RECORD: &str = "out/plate/identity_default/case.json";

/// Measures the identity, which breaks a bound, and writes a good score into its record.
fn forged() -> Sandbox {
    let sandbox = Sandbox::checked();
    sandbox.write_bound(0.2);
    assert_eq!(sandbox.check(&IDENTITY).status.code(), Some(1));
    let mut record: Value = sandbox.read_json(RECORD);
    let good = serde_json::to_value(Measured::score(0.001, 0.001)).unwrap();
    for (pointer, value) in [
        ("/made/scores/moving/flip", good),
        ("/made/intervals/flip_moving/low", json!(0.0)),
        ("/made/intervals/flip_moving/high", json!(0.002)),
        ("/hash", json!("")),
    ] {
        *record.pointer_mut(pointer).expect(pointer) = value;
    }
    let text = record.to_string();
    let hash = format!("\"hash\":\"{}\"", blake3::hash(text.as_bytes()).to_hex());
    sandbox.put(RECORD, text.replacen("\"hash\":\"\"", &hash, 1));
    sandbox
}

#[test]
fn a_check_without_cache_ignores_a_forged_record() {
    let sandbox = forged();
    assert_done(&sandbox.check(&IDENTITY));
    let anew = sandbox.check(&[&IDENTITY[..], &["--no-cache"]].concat());
    assert_eq!(anew.status.code(), Some(1));
}

#[test]
fn a_check_refuses_folders_tracked_by_git() {
    let sandbox = forged();
    sandbox.git("init -q");
    sandbox.put("kept/frame.exr", "a change brings it");
    sandbox.git("add -f kept/frame.exr");
    let with_truths = [&IDENTITY[..], &["--truths", "kept"]].concat();
    let parts = ["kept/frame.exr", "is tracked by git", "--truths"];
    assert_refused(&sandbox.check(&with_truths), 2, &parts);
    sandbox.git(&format!("add -f {RECORD}"));
    let parts = [RECORD, "is tracked by git"];
    assert_refused(&sandbox.check(&IDENTITY), 2, &parts);
    sandbox.refuse("check --run out/run.json", &parts);
}

/// A repository's settings, such as `core.fsmonitor`, can make git start programs.
#[test]
fn a_check_uses_no_setting_of_a_repository() {
    let sandbox = forged();
    sandbox.git("init -q");
    sandbox.git("init -q --bare out");
    let hook = format!("touch {}", sandbox.path("ran").display());
    let config = format!("[core]\nbare = false\nworktree = .\nfsmonitor = {hook}\n");
    sandbox.put("out/config", config);
    assert_refused(&sandbox.check(&IDENTITY), 2, &["cannot find out whether"]);
    assert!(!sandbox.path("ran").exists(), "a program ran");
}

#[test]
fn no_name_in_a_file_leads_out_of_its_folder() {
    let sandbox = Sandbox::measured();
    let mut run: Value = sandbox.read_json("out/run.json");
    run["cases"][0]["folder"] = json!("../x");
    sandbox.put("out/run.json", run.to_string());
    let part = "has to be in a folder below run.json";
    sandbox.refuse("report out --html page.html", &[part]);

    sandbox.write_filter("mine", "", "");
    sandbox.put("secret", "the secret");
    let manifest = sandbox.path("mine/filter.toml");
    fs::remove_file(&manifest).unwrap();
    std::os::unix::fs::symlink("../secret", manifest).unwrap();
    let part = "is a link to a file outside of the filter's folder";
    sandbox.refuse("list --filter mine", &[part]);

    sandbox.done("truths render --quiet --samples-per-pixel 16 --replicates 0..2 --out part");
    let path = sandbox.path("part/plate/truth_trailing/replicate_000.exr");
    let mut replicate = Replicate::read(&path).unwrap();
    replicate.provenance.scene = "../../etc".to_owned();
    replicate.write(&path).unwrap();
    let part = "replicate_000.exr holds ../../etc/truth_trailing";
    sandbox.refuse("truths merge part --out whole", &[part]);
}
