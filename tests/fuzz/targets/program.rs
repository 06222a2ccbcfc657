//! The program itself: words of its command line, and records of earlier measurements that a `run` reads back.

use std::ffi::OsStr;
use std::fs;
use std::os::unix::ffi::OsStrExt;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::commands;
use crate::fixture::{PROGRAM, RENDER};
use crate::place::{Place, last_lines};

/// Exit codes that the README names.
const CODES: [i32; 5] = [0, 1, 2, 3, 4];

/// Time limit for a program with much work; after that it is ended.
const PATIENCE: Duration = Duration::from_secs(2);

/// Runs a command line in a folder with scenes, a run and a tuning.
pub fn command_line(place: &mut Place, input: &[u8]) -> Option<()> {
    for name in ["scenes", "out", "tuned", "study", "base.json"] {
        place.copy(name);
    }
    let words = input.strip_suffix(b"\n").unwrap_or(input);
    let words = words.split(|byte| *byte == b'\n').map(OsStr::from_bytes);
    // A line may name any file as the one to write, also the file that no case may change.
    let is_safe = |word: &&OsStr| {
        let bytes = word.as_bytes();
        !bytes.contains(&0) && *word != "/" && !bytes.ends_with(b"../canary.txt")
    };
    let words: Vec<&OsStr> = words.filter(is_safe).collect();
    shuttertruth(place, &words, Stdio::null());
    Some(())
}

/// Runs the program with the input as one of its records.
pub fn records(place: &mut Place, input: &[u8]) -> Option<()> {
    let file = match input.windows(9).any(|it| it == b"frame.exr") {
        true => "out/plate/frame.json",
        false => "out/plate/mcguire_paper/case.json",
    };
    let line = format!("run {RENDER} --filters velocity_gather:departure,mcguire:paper --out out");
    commands::run(place, file, input, &[line])
}

/// Runs a line of the program, and returns its code.
pub fn run_line(place: &Place, line: &str) -> i32 {
    shuttertruth(place, &split(line), Stdio::null())
}

fn split(line: &str) -> Vec<&OsStr> {
    line.split(' ').map(OsStr::new).collect()
}

/// Runs the program with its output in the file `stdout`. Panics unless it ends with a documented code, and returns that.
fn shuttertruth(place: &Place, words: &[&OsStr], stdin: Stdio) -> i32 {
    let [stdout, stderr] = ["stdout", "stderr"].map(|name| place.write(name, ""));
    let open = |path| fs::File::options().append(true).open(path).unwrap();
    let mut command = Command::new(PROGRAM);
    command.current_dir(&place.folder).args(words);
    command.env("GITHUB_STEP_SUMMARY", place.folder.join("summary.md"));
    command.stdin(stdin);
    command.stdout(open(&stdout)).stderr(open(&stderr));
    let mut child = command.spawn().expect("the program can be started");
    let began = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if began.elapsed() > PATIENCE && asks_for_much(words) {
            let _ = child.kill();
            let _ = child.wait();
            return 0;
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let code = status.code().filter(|code| CODES.contains(code));
    code.unwrap_or_else(|| panic!("{status}: {}", last_lines(&stderr)))
}

/// Returns whether a number is large enough for much work, or all scenes and filters are requested.
fn asks_for_much(words: &[&OsStr]) -> bool {
    let small = ["--size", "16x16", "--samples-per-pixel", "--filters"];
    let is_large = |word: &&OsStr| {
        let word = word.to_string_lossy();
        let mut numbers = word.split(|c: char| !c.is_ascii_digit());
        numbers.any(|digits| digits.len() > 2)
    };
    words.iter().any(is_large) || !small.iter().all(|flag| words.contains(&OsStr::new(flag)))
}
