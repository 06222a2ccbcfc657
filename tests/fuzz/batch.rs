//! A worker process, as its parent sees it.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::ops::Range;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use crate::failure::How;
use crate::target::Target;
use crate::worker::MARK;

/// Address space of a worker, and of every program that it starts, in KiB.
pub const MEMORY: u64 = 4 << 20;

/// Settings that all workers share.
pub struct Terms<'a> {
    /// Folder of the [`fixture`](crate::fixture).
    pub fixture: &'a Path,
    /// Seed of the inputs.
    pub seed: u64,
    /// Longest time of a case.
    pub limit: Duration,
}

/// A case that failed.
pub struct Failed {
    /// Number of the case.
    pub case: u64,
    /// Kind of failure.
    pub how: How,
    /// Input that was tried.
    pub input: Vec<u8>,
}

/// End of a worker.
pub struct Ended {
    /// The case that failed; none if all cases passed.
    pub failed: Option<Failed>,
    /// Time and number of the slowest case.
    pub slowest: (Duration, u64),
}

/// Tries cases in a process of their own, up to the first that fails.
pub fn try_cases(target: &Target, cases: Range<u64>, terms: &Terms) -> Ended {
    let kept = tempfile::NamedTempFile::new().expect("a file for an input");
    let mut words = [terms.seed, cases.start, cases.end]
        .map(|it| it.to_string())
        .to_vec();
    words.push(kept.path().display().to_string());
    observe(target, &words, kept.path(), terms)
}

/// Tries a file's content in a process of its own.
pub fn try_file(target: &Target, path: &Path, terms: &Terms) -> Ended {
    let words = ["file".to_owned(), path.display().to_string()];
    observe(target, &words, path, terms)
}

fn observe(target: &Target, words: &[String], input: &Path, terms: &Terms) -> Ended {
    let stderr = tempfile::NamedTempFile::new().expect("a file for temporary text");
    let mut child = start(target, words, terms, stderr.reopen().unwrap());
    let lines = read_lines(&mut child);
    let failed = |how: How, case: u64| {
        let input = std::fs::read(input).unwrap_or_default();
        Some(Failed { case, how, input })
    };
    let mut case = 0;
    let mut slowest = (Duration::ZERO, 0);
    let mut panic = None;
    let mut began = Instant::now();
    loop {
        match lines.recv_timeout(terms.limit.saturating_sub(began.elapsed())) {
            Ok(line) => match line.split_once(' ') {
                Some(("begin", number)) => {
                    case = number.parse().unwrap_or(case);
                    began = Instant::now();
                }
                Some(("done", _)) => slowest = slowest.max((began.elapsed(), case)),
                Some(("panic", text)) => panic = Some(text.to_owned()),
                _ => {}
            },
            Err(RecvTimeoutError::Timeout) => {
                end(&mut child);
                return Ended {
                    failed: failed(How::Hang(terms.limit), case),
                    slowest,
                };
            }
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    let status = child.wait().expect("a worker that was started");
    let failed = match (panic, status.success()) {
        (Some(text), _) => failed(How::Panic(text), case),
        (None, true) => None,
        (None, false) => failed(How::Ended(describe_end(&status, stderr.path())), case),
    };
    Ended { failed, slowest }
}

/// Starts this program again, with less memory.
fn start(target: &Target, words: &[String], terms: &Terms, stderr: File) -> Child {
    let own = std::env::current_exe().expect("the running program has a path");
    let limited = format!("ulimit -v {MEMORY} 2>/dev/null; ulimit -c 0; exec \"$0\" \"$@\"");
    Command::new("sh")
        .args(["-c", &limited])
        .arg(own)
        .args(["--work", target.name])
        .arg(terms.fixture)
        .args(words)
        // Stacks and arenas of many threads would fill the address space.
        .envs([("RAYON_NUM_THREADS", "2"), ("MALLOC_ARENA_MAX", "4")])
        .env("RUST_BACKTRACE", "0")
        .env_remove("CI")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(stderr)
        .process_group(0)
        .spawn()
        .expect("sh can be started")
}

/// Reads the worker's lines on a thread.
fn read_lines(child: &mut Child) -> Receiver<String> {
    let out = child.stdout.take().expect("its output is a pipe");
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        for line in BufReader::new(out).lines().map_while(Result::ok) {
            if let Some(line) = line.strip_prefix(MARK)
                && sender.send(line.to_owned()).is_err()
            {
                return;
            }
        }
    });
    receiver
}

/// Ends the worker and everything that it started.
fn end(child: &mut Child) {
    let group = format!("-{}", child.id());
    let _ = Command::new("kill").args(["-9", "--", &group]).status();
    let _ = child.kill();
    let _ = child.wait();
}

/// Describes the end: `signal 6: memory allocation of 5368709120 bytes failed`.
fn describe_end(status: &ExitStatus, stderr: &Path) -> String {
    let text = std::fs::read(stderr).unwrap_or_default();
    let text = String::from_utf8_lossy(&text);
    let lines: Vec<&str> = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .collect();
    let last = lines.iter().rev().take(3).rev().copied();
    let last: Vec<&str> = last.collect();
    let how = match (status.signal(), status.code()) {
        (Some(signal), _) => format!("signal {signal}"),
        (None, code) => format!("exit code {}", code.unwrap_or(-1)),
    };
    let last: String = last.join(" ").chars().take(400).collect();
    format!("{how}: {last}")
}
