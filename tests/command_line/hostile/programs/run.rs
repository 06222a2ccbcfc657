//! Filters that are programs: permission, environment, end.

use std::process::{Command, Output};

use frame::{ExrFile, Raster, write_exr};
use tests::text::assert_contains;

use crate::child::{assert_ends_at_ctrl_c, wait_until};
use crate::sandbox::*;

/// Makes a sandbox with a frame of 16 x 16 pixels, which is quick to blur.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    let mut file = ExrFile::new(16, 16);
    file.push_color("", &Raster::filled(16, 16, [0.5; 3]));
    for name in ["velocity.X", "velocity.Y", "Z"] {
        file.push_plane(name, &Raster::filled(16, 16, 1.0));
    }
    file.set("exposure", 0.5);
    write_exr(&sandbox.path("frame.exr"), &file).unwrap();
    sandbox
}

const BLUR: &str = "engine blur --allow-commands --filter ./mine --frame frame.exr --out b.exr";

/// Makes the command `blur` with a timeout of a minute.
fn command(sandbox: &Sandbox) -> Command {
    let mut command = Command::new("timeout");
    command.arg("60").arg(env!("CARGO_BIN_EXE_shuttertruth"));
    command.current_dir(sandbox.path("")).args(split(BLUR));
    command
}

/// Blurs with the script as the filter.
fn blur(sandbox: &Sandbox, lines: &str, more: &str) -> Output {
    sandbox.write_program("mine", lines, more);
    command(sandbox).output().unwrap()
}

#[test]
fn no_command_runs_a_program_without_permission() {
    let sandbox = set_up();
    sandbox.write_program("mine", "touch ran; cp $1 $2", "");
    for line in [
        "run --out out --filter mine",
        "check --out out --filter mine",
        "limits calibrate --out out --filter mine",
        "engine blur --filter ./mine --frame frame.exr --out b.exr",
        "tune search --out out --filter ./mine",
        "tune evaluate --out out --filter ./mine --params p.json",
        "tune serve --out out --filter ./mine",
    ] {
        let script = "`./blur.sh {frame} {out}`";
        let parts = ["./mine/filter.toml:4: ", script, "--allow-commands"];
        sandbox.refuse(line, &parts);
        assert!(!sandbox.path("out").exists(), "{line}");
    }
    let listed = sandbox.done("list --filter mine");
    assert_contains(&listed, &["runs: ./blur.sh {frame} {out}"]);
    assert!(!sandbox.path("mine/ran").exists(), "it ran");
    sandbox.done(BLUR);
    assert!(sandbox.path("mine/ran").exists());
}

#[test]
fn a_program_gets_no_secret_from_the_environment() {
    let sandbox = set_up();
    let named = "environment = [\"CUDA_VISIBLE_DEVICES\", \"NOT_SET\"]";
    sandbox.write_program("mine", "env > seen; cp $1 $2", named);
    let mut command = command(&sandbox);
    let secrets = ["GITHUB_TOKEN", "ACTIONS_RUNTIME_TOKEN", "MY_SECRET"];
    command.envs(secrets.map(|name| (name, "hidden")));
    command.envs([("LC_ALL", "C"), ("HOME", "/somewhere")]);
    command.env("CUDA_VISIBLE_DEVICES", "1");
    assert_done(&command.output().unwrap());
    let seen = sandbox.text("mine/seen");
    for hidden in ["hidden", "TOKEN", "NOT_SET"] {
        assert!(!seen.contains(hidden), "{seen}");
    }
    let lines = "CUDA_VISIBLE_DEVICES=1 | LC_ALL=C | HOME=/somewhere | PATH=";
    assert_contains(&seen, &lines);
    let listed = sandbox.done("list --filter mine");
    assert_contains(&listed, &["environment: CUDA_VISIBLE_DEVICES NOT_SET"]);
    for name in ["A=B", "", "1A"] {
        sandbox.write_program("mine", "", &format!("environment = [\"{name}\"]"));
        let part = format!("mine/filter.toml:5: environment: \"{name}\" names no variable");
        sandbox.refuse(BLUR, &[&part]);
    }
    let kernels = "name = \"mine\"\nsummary = \"\"\nalignment = \"trailing\"\n\
                   environment = [\"A\"]\n[[pass]]\nentry = \"blur\"\n";
    sandbox.put("mine/filter.toml", kernels);
    sandbox.refuse(BLUR, &["mine/filter.toml:4: environment: is for a program"]);
}

/// Shell line that leaves a process behind in its own session; `pid` names it.
#[cfg(target_os = "linux")]
const LEAVES_ONE: &str = "(setsid sh -c 'echo $$ > pid.new; mv pid.new pid; exec sleep 300' &)\n\
                          while [ ! -e pid ]; do sleep 0.01; done";

#[cfg(target_os = "linux")]
#[test]
fn a_child_session_ends_with_its_program() {
    for (rest, more, code, part) in [
        ("cp $1 $2", "", 0, ""),
        ("exit 7", "", 2, "ended with exit status: 7"),
        ("sleep 300", "time_limit = 1", 2, "took longer than 1 s"),
    ] {
        let sandbox = set_up();
        let output = blur(&sandbox, &format!("{LEAVES_ONE}\n{rest}"), more);
        assert_eq!(output.status.code(), Some(code), "{rest}");
        assert_contains(&String::from_utf8_lossy(&output.stderr), &[part]);
        let has_ended = sandbox.has_ended("mine/pid");
        assert!(has_ended, "it lives on after: {rest}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_child_session_ends_at_ctrl_c() {
    let sandbox = set_up();
    sandbox.write_program("mine", &format!("{LEAVES_ONE}\nsleep 300"), "");
    let mut child = sandbox.command(&split(BLUR)).spawn().unwrap();
    wait_until(&mut child, || sandbox.path("mine/pid").exists());
    assert_ends_at_ctrl_c(child);
    assert!(sandbox.has_ended("mine/pid"));
}

#[test]
fn an_output_that_is_not_a_regular_file_is_refused() {
    let sandbox = set_up();
    for (lines, found) in [
        ("mkfifo $2", "a pipe or a device"),
        ("ln -s /dev/zero $2", "a link"),
        ("ln -s $1 $2", "a link"),
        ("mkdir $2", "a folder"),
    ] {
        let part = format!("left {found} in the place of {{out}}");
        assert_refused(&blur(&sandbox, lines, ""), 2, &[&part, "a regular file"]);
    }
    // No other user may read the folder of the files.
    assert_done(&blur(&sandbox, "ls -ld $(dirname $2) > mode; cp $1 $2", ""));
    let mode = sandbox.text("mine/mode");
    assert!(mode.starts_with("drwx------"), "{mode}");
}

#[test]
fn the_output_of_a_program_is_limited() {
    let sandbox = set_up();
    // The limit is 16 x 16 pixels of 256 bytes, and 1 MiB.
    let parts = ["wrote an {out} of more than 1114112 bytes", "16x16 pixels"];
    let endless = "head -c 20000000 /dev/zero > $2; sleep 300";
    for lines in [endless, "truncate -s 1T $2"] {
        assert_refused(&blur(&sandbox, lines, ""), 2, &parts);
    }
    // 300 MB on standard output, although no file may exceed 50 MB: the program keeps only the end, in memory.
    let lines = "yes | head -c 300000000; echo the end >&2; exit 7";
    sandbox.write_program("mine", lines, "");
    let program = env!("CARGO_BIN_EXE_shuttertruth");
    let limited = format!("ulimit -f 100000; exec timeout 60 {program} {BLUR}");
    let mut shell = Command::new("sh");
    shell.current_dir(sandbox.path("")).args(["-c", &limited]);
    let output = shell.output().unwrap();
    let parts = ["ended with exit status: 7", "\n  | y\n  | y\n  | the end"];
    assert_refused(&output, 2, &parts);
    assert!(output.stderr.len() < 1000, "ten lines are shown");
}

#[test]
fn a_program_that_closes_its_pipes_and_goes_on_is_stopped() {
    let output = blur(&set_up(), "exec >&- 2>&-; sleep 300", "time_limit = 1");
    assert_refused(&output, 2, &["took longer than 1 s", "printed nothing"]);
}
