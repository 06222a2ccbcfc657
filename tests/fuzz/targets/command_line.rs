//! Words of the command line, for the program itself.

use std::os::unix::ffi::OsStrExt;
use std::os::unix::process::ExitStatusExt;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use std::{ffi::OsStr, fs::File, io::Read, io::Seek};

use crate::fixture::PROGRAM;
use crate::place::Place;
use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::tokens;

/// Exit codes that the README names.
const CODES: [i32; 5] = [0, 1, 2, 3, 4];

/// Time limit for a program with much work; it is then ended.
const PATIENCE: Duration = Duration::from_secs(5);

/// Command lines in a folder with scenes, a run and a tuning.
pub static TARGET: Target = Target {
    name: "command_line",
    share: 350,
    batch: 50,
    shape: Shape::Words,
    tokens: tokens::WORDS,
    seeds: |_| {
        let lines = include_str!("../commands.txt").lines();
        lines
            .map(|line| Seed::Bytes(line.replace(' ', "\n").into_bytes()))
            .collect()
    },
    run: |place, input| {
        for name in ["scenes", "out", "tuned", "study", "base.json"] {
            place.copy(name);
        }
        let words: Vec<&OsStr> = (input.split(|byte| *byte == b'\n'))
            .filter(|word| !word.contains(&0) && *word != b"/")
            .map(OsStr::from_bytes)
            .collect();
        shuttertruth(place, &words);
    },
};

/// Runs the program; panics unless it ends with a documented code.
pub fn shuttertruth(place: &Place, words: &[impl AsRef<OsStr>]) {
    let mut stderr: File = tempfile::tempfile().expect("a file for temporary text");
    let mut child = Command::new(PROGRAM)
        .current_dir(&place.folder)
        .args(words)
        .env("GITHUB_STEP_SUMMARY", place.folder.join("summary.md"))
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(stderr.try_clone().unwrap())
        .spawn()
        .expect("the program can be started");
    let began = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if began.elapsed() > PATIENCE && asks_for_much(words) {
            let _ = child.kill();
            let _ = child.wait();
            return;
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let mut text = String::new();
    stderr.rewind().unwrap();
    let _ = stderr.read_to_string(&mut text);
    let last: Vec<&str> = text.lines().rev().take(3).collect();
    assert!(
        status.code().is_some_and(|code| CODES.contains(&code)) && status.signal().is_none(),
        "{status}: {}",
        last.join(" / ")
    );
}

/// Returns whether a number is large enough for much work, or all scenes and filters are asked for.
fn asks_for_much(words: &[impl AsRef<OsStr>]) -> bool {
    let words: Vec<String> = (words.iter())
        .map(|word| word.as_ref().to_string_lossy().into_owned())
        .collect();
    let large = |word: &String| {
        let digits = word.split(|c: char| !c.is_ascii_digit());
        digits.map(str::len).max().unwrap_or(0) > 2 || word.contains('e') && word.contains("30")
    };
    let small = ["--size", "16x16", "--samples-per-pixel", "--filters"];
    words.iter().any(large)
        || !small
            .iter()
            .all(|flag| words.iter().any(|word| word == flag))
}
