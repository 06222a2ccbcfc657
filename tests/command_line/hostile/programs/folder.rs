//! One folder shared by several processes.

use std::fs;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::process::Command;

use crate::sandbox::{Sandbox, assert_done, assert_refused, files_below, split};

const RUN: &str = "run --quiet --size 64x32 --samples-per-pixel 16 --filters identity --out out";
const RENDER: &str = "truths render --quiet --samples-per-pixel 16 --out out";

#[test]
fn two_runs_cannot_share_a_folder_at_the_same_time() {
    let sandbox = Sandbox::new();
    sandbox.write_bound(1.0);
    let parts = "another shuttertruth is writing to out | another output folder";
    // The lock file of another process.
    fs::create_dir(sandbox.path("out")).unwrap();
    let other = fs::File::create(sandbox.path("out/.shuttertruth.lock")).unwrap();
    other.try_lock().unwrap();
    for line in [
        RUN,
        RENDER,
        "check --quiet --filters identity --out out",
        "limits calibrate --quiet --filters identity --out out",
        "tune search --quiet --filter jump_flood --objective flip --out out",
        "tune serve --quiet --filter jump_flood --out out",
    ] {
        sandbox.refuse(line, &parts);
        assert_eq!(files_below(&sandbox.path("out")).len(), 1, "{line}");
    }
    // Renders share a folder with each other, but not with other commands.
    other.unlock().unwrap();
    other.try_lock_shared().unwrap();
    sandbox.done(RENDER);
    sandbox.refuse(RUN, &parts);
    // A process that ends releases its lock.
    drop(other);
    sandbox.done(RUN);
    sandbox.done(RUN);
}

#[test]
fn the_next_run_removes_files_of_a_killed_process() {
    let sandbox = Sandbox::new();
    let gone = split("out/ out/plate/ out/plate/identity_default/ out/plate/truth_trailing/");
    let kept = ["out/mine.tmp", "out/mine/.shuttertruth-e.tmp"];
    let gone = gone.iter().map(|it| format!("{it}.shuttertruth-a.tmp"));
    for name in gone.chain(kept.map(str::to_owned)) {
        sandbox.put(&name, "half");
    }
    sandbox.done(RUN);
    let mut left = files_below(&sandbox.path("out"));
    left.retain(|path| path.extension().is_some_and(|it| it == "tmp"));
    let mut kept = kept.map(|name| sandbox.path(name));
    kept.sort();
    assert_eq!(left, kept);
}

#[test]
fn nothing_beyond_a_link_to_a_scene_s_folder_is_removed() {
    let sandbox = Sandbox::new();
    let dead = "elsewhere/.shuttertruth-a.tmp";
    sandbox.put(dead, "half");
    fs::create_dir(sandbox.path("out")).unwrap();
    symlink(sandbox.path("elsewhere"), sandbox.path("out/plate")).unwrap();
    sandbox.done(RUN);
    assert!(sandbox.path(dead).exists());
    assert!(
        sandbox.path("elsewhere/frame.exr").exists(),
        "the run wrote there"
    );
}

#[test]
fn records_that_are_pipes_or_devices_are_named_and_not_read() {
    let sandbox = Sandbox::new();
    sandbox.done(RUN);
    for name in [
        "run.json",
        "plate/frame.json",
        "plate/truth_trailing.json",
        "plate/identity_default/case.json",
    ] {
        let path = sandbox.path("out").join(name);
        let whole = fs::read(&path).unwrap();
        for kind in ["a FIFO", "a device"] {
            fs::remove_file(&path).unwrap();
            if kind == "a FIFO" {
                assert!(
                    Command::new("mkfifo")
                        .arg(&path)
                        .status()
                        .unwrap()
                        .success()
                );
            } else {
                symlink("/dev/zero", &path).unwrap();
            }
            // A read that waits for a writer, or for the end of zeros, would never end.
            let mut run = Command::new("timeout");
            run.args(["60", env!("CARGO_BIN_EXE_shuttertruth")])
                .args(split(RUN));
            let output = run.current_dir(sandbox.path("")).output().unwrap();
            let message = format!("out/{name}: is {kind}");
            assert_refused(&output, 2, &[message]);
        }
        fs::remove_file(&path).unwrap();
        fs::write(&path, whole).unwrap();
    }
    sandbox.done(RUN);
}

#[test]
fn the_umask_decides_who_may_read_the_files() {
    for (umask, expected, words) in [
        ("022", 0o644, RENDER),
        ("027", 0o640, RUN),
        ("077", 0o600, RENDER),
    ] {
        let sandbox = Sandbox::new();
        let program = env!("CARGO_BIN_EXE_shuttertruth");
        let line = format!("umask {umask}; exec {program} {words}");
        let mut shell = Command::new("sh");
        shell.current_dir(sandbox.path("")).args(["-c", &line]);
        assert_done(&shell.output().unwrap());
        for path in files_below(&sandbox.path("out")) {
            let mode = fs::metadata(&path).unwrap().permissions().mode() & 0o777;
            assert_eq!(mode, expected, "{mode:o}: {}", path.display());
        }
    }
}
