//! Snakemake measures a run in parts, also after a job was killed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tests::text::assert_contains;

use crate::sandbox::{Sandbox, python_with, split, stderr, stdout};

/// Options of every run.
const OPTIONS: &str = "--size 64x32 --samples-per-pixel 16 --jitter-frames 2";

/// Runs the example's Snakefile with two jobs at a time.
fn snakemake(sandbox: &Sandbox) -> Command {
    let mut command = Command::new(python_with(&["snakemake"]));
    let snakefile = tests::root().join("examples/snakemake/Snakefile");
    let words = "-m snakemake --cores 2 --rerun-incomplete --snakefile";
    command.args(split(words));
    command.arg(snakefile).arg("--config");
    command.arg(format!("program={}", env!("CARGO_BIN_EXE_shuttertruth")));
    command.arg(format!("options={OPTIONS}"));
    command.args(["scenes=plate", "filters=identity,kino:default"]);
    // Snakemake keeps files in its cache that no test needs.
    command.env("XDG_CACHE_HOME", sandbox.path("cache"));
    command.current_dir(sandbox.path(""));
    command
}

/// Finds a process that was started in a folder with all of these in its words.
fn find_process(folder: &Path, words: &[&str]) -> Option<String> {
    let is_own = |process: &PathBuf| {
        let text = fs::read_to_string(process.join("cmdline")).unwrap_or_default();
        let arguments: Vec<&str> = text.split('\0').collect();
        arguments[0] == env!("CARGO_BIN_EXE_shuttertruth")
            && words.iter().all(|word| arguments.contains(word))
            && fs::read_link(process.join("cwd")).is_ok_and(|path| path == folder)
    };
    let mut processes = fs::read_dir("/proc")
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let process = processes.find(is_own)?;
    Some(process.file_name()?.to_string_lossy().into_owned())
}

/// Waits for a process and kills it.
fn kill_process(folder: &Path, words: &[&str]) {
    let end = Instant::now() + Duration::from_secs(120);
    let process = loop {
        match find_process(folder, words) {
            Some(process) => break process,
            None => std::thread::sleep(Duration::from_millis(1)),
        }
        assert!(Instant::now() < end, "no job {words:?} began");
    };
    let killed = Command::new("kill").args(["-KILL", &process]).status();
    assert!(killed.unwrap().success(), "the job had ended");
}

/// Runs the Snakefile to its end; returns its messages.
fn finish(sandbox: &Sandbox) -> String {
    let output = snakemake(sandbox).output().unwrap();
    let said = stderr(&output);
    assert!(output.status.success(), "{}{said}", stdout(&output));
    said
}

#[test]
#[ignore = "prove: a job of Snakemake is killed and goes on"]
fn a_killed_job_is_resumed_and_the_merged_run_equals_that_of_one_process() {
    let [shared, alone] = [(); 2].map(|()| Sandbox::new());
    let folder = shared.path("").canonicalize().unwrap();

    let mut command = snakemake(&shared);
    command.stdout(Stdio::null()).stderr(Stdio::piped());
    let first = command.spawn().unwrap();
    kill_process(&folder, &["run", "--part", "filters"]);
    let first = first.wait_with_output().unwrap();
    let said = stderr(&first);
    assert!(!first.status.success(), "a killed job fails:\n{said}");
    assert!(!shared.path("out/run.json").exists());
    let written = || shared.written("out/parts/references/plate/plate/truth_trailing.exr");
    let before = written();

    finish(&shared);
    assert_eq!(written(), before, "a truth was rendered again");
    alone.done(&format!("run {OPTIONS} --filter identity,kino:default"));
    let run = |sandbox: &Sandbox| sandbox.read_comparable("out");
    assert_eq!(run(&shared), run(&alone));
    assert!(shared.path("out/report.html").is_file());
    assert_contains(&finish(&shared), &["Nothing to be done"]);
}
