//! Compilers that would run for long, or take much memory: their limits, and their end with the
//! program.

use std::fs;

use tests::text::assert_contains;

use super::*;
use crate::child::{send, wait_until};
use crate::sandbox::Sandbox;

/// Shell lines that start two processes, which would run for minutes; `PID` names the second.
const SLEEPERS: &str = "/bin/sleep 300 & echo $! > PID.new; /bin/mv PID.new PID; /bin/sleep 300";

#[test]
fn a_signal_that_ends_the_program_ends_its_compiler_and_removes_its_folder() {
    for (signal, code) in [("INT", 130), ("TERM", 143), ("HUP", 129), ("QUIT", 131)] {
        let sandbox = Sandbox::new();
        write_pass(&sandbox, "blur.slang", "");
        let pid = sandbox.path("pid").display().to_string();
        write_compiler(&sandbox, "slangc", &SLEEPERS.replace("PID", &pid));
        fs::create_dir(sandbox.path("temporary")).unwrap();
        let words = ["--default-signal=HUP", env!("CARGO_BIN_EXE_shuttertruth")];
        let mut command = std::process::Command::new("/usr/bin/env");
        let mut child = command
            .args(words)
            .args(["list", "--filter", "translated"])
            .current_dir(sandbox.path(""))
            .env("PATH", sandbox.path("bin"))
            .env("TMPDIR", sandbox.path("temporary"))
            .spawn()
            .unwrap();
        wait_until(&mut child, || sandbox.path("pid").exists());
        send(&child, signal);
        assert_eq!(child.wait().unwrap().code(), Some(code), "{signal}");
        assert!(
            sandbox.has_ended("pid"),
            "{signal} leaves the compiler running"
        );
        let mut left = fs::read_dir(sandbox.path("temporary")).unwrap();
        assert!(
            left.next().is_none(),
            "{signal} leaves the compiler's folder"
        );
    }
}

#[test]
fn a_compiler_has_limits_that_outlive_the_program() {
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.slang", "");
    // The limits are set a moment after the start.
    let wait = "n=0; while [ \"$(ulimit -d)\" = unlimited ] && [ $n -lt 1000 ]; do n=$((n + 1)); /bin/sleep 0.01; done";
    let say = "echo \"$(ulimit -d) KiB, $(ulimit -t) seconds\" >&2; exit 1";
    write_compiler(&sandbox, "slangc", &format!("{wait}\n{say}"));
    let cores = std::thread::available_parallelism().unwrap();
    let seconds = 61 * cores.get();
    let said = refuse(&sandbox);
    assert_contains(&said, &[&format!("2097152 KiB, {seconds} seconds")]);
}

#[test]
fn a_compiler_that_a_signal_kills_is_named_with_its_limit() {
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.slang", "");
    write_compiler(&sandbox, "slangc", "kill -ABRT $$");
    let parts = [
        "blur.slang: slangc ended with signal: 6 (SIGABRT)",
        "2048 MiB",
    ];
    assert_contains(&refuse(&sandbox), &parts);
}

#[test]
fn a_compiler_that_writes_without_end_is_stopped() {
    let sandbox = Sandbox::new();
    write_pass(&sandbox, "blur.slang", "");
    let script = "for word; do case \"$word\" in *.spv) /usr/bin/head -c 20000000 /dev/zero > \"$word\";; esac; done\n\
                  /bin/sleep 300";
    write_compiler(&sandbox, "slangc", script);
    let parts = ["blur.slang: slangc wrote more than 4194304 bytes, the most"];
    assert_contains(&refuse(&sandbox), &parts);
}
