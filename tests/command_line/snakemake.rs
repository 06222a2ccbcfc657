//! Snakemake runs the jobs of a plan, after one was killed too.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::python::python_with;
use crate::sandbox::{Sandbox, assert_done, split, stderr, stdout};

/// Words behind `plan` and `run`.
const WORDS: &str =
    "--quiet --size 64x32 --samples-per-pixel 16 --jitter-frames 2 --filter kino:default,identity";

/// Runs the example's Snakefile with two jobs at a time.
fn snakemake(sandbox: &Sandbox) -> Command {
    let mut command = Command::new(python_with(&["snakemake"]));
    let snakefile = tests::root().join("examples/snakemake/Snakefile");
    command.args([
        "-m",
        "snakemake",
        "--cores",
        "2",
        "--rerun-incomplete",
        "--snakefile",
    ]);
    command.arg(snakefile).arg("--config");
    command.arg(format!("program={}", env!("CARGO_BIN_EXE_shuttertruth")));
    // It keeps files there that no test needs.
    command.env("XDG_CACHE_HOME", sandbox.path("cache"));
    command.current_dir(sandbox.path(""));
    command
}

/// Finds a process that was started in a folder and whose words contain all of these.
fn find_process(folder: &Path, words: &[&str]) -> Option<String> {
    let is_own = |process: &PathBuf| {
        let text = fs::read_to_string(process.join("cmdline")).unwrap_or_default();
        let own: Vec<&str> = text.split('\0').collect();
        own[0] == env!("CARGO_BIN_EXE_shuttertruth")
            && words.iter().all(|word| own.contains(word))
            && fs::read_link(process.join("cwd")).is_ok_and(|it| it == folder)
    };
    let processes = fs::read_dir("/proc")
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let found = processes.into_iter().find(is_own)?;
    Some(found.file_name()?.to_string_lossy().into_owned())
}

/// Waits for a process and kills it.
fn kill_process(folder: &Path, words: &[&str]) {
    let end = Instant::now() + Duration::from_secs(120);
    let process = loop {
        match find_process(folder, words) {
            Some(process) => break process,
            None => std::thread::sleep(Duration::from_millis(1)),
        }
        assert!(
            Instant::now() < end,
            "no job with the words {words:?} began"
        );
    };
    let killed = Command::new("kill").args(["-KILL", &process]).status();
    assert!(killed.unwrap().success(), "the job had ended");
}

fn assert_ended_well(output: &Output) {
    assert!(
        output.status.success(),
        "{}{}",
        stdout(output),
        stderr(output)
    );
}

#[test]
fn a_killed_job_is_resumed_and_the_merged_run_equals_that_of_one_process() {
    let [shared, alone] = [(); 2].map(|()| Sandbox::two_scenes());
    let words = split(WORDS);
    let plan = shared.execute(&[&["truths", "plan"], &words[..], &["--json"]].concat());
    fs::write(shared.path("plan.jsonl"), plan).unwrap();
    let folder = shared.path("").canonicalize().unwrap();

    let mut command = snakemake(&shared);
    let first = command
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    kill_process(&folder, &["run", "--part", "filters", "slow"]);
    let first = first.wait_with_output().unwrap();
    assert!(
        !first.status.success(),
        "a killed job fails:\n{}",
        stderr(&first)
    );
    assert!(!shared.path("out/run.json").exists());
    let rendered = |sandbox: &Sandbox| {
        let truth = sandbox.path("out/parts/truths/slow/truth_trailing.exr");
        fs::metadata(truth).unwrap().modified().unwrap()
    };
    let before = rendered(&shared);

    let second = snakemake(&shared).output().unwrap();
    assert_ended_well(&second);
    assert_eq!(rendered(&shared), before, "a truth was rendered again");
    assert_done(&alone.shuttertruth(&[&["run"], &words[..]].concat()));
    let run = |sandbox: &Sandbox| fs::read_to_string(sandbox.path("out/run.json")).unwrap();
    assert_eq!(run(&shared), run(&alone));
    assert!(shared.path("out/report.html").is_file());

    let third = snakemake(&shared).output().unwrap();
    assert_ended_well(&third);
    assert!(
        stderr(&third).contains("Nothing to be done"),
        "{}",
        stderr(&third)
    );
}
