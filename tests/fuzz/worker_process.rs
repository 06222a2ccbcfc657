//! A worker process: as its parent sees it, and its work. Its end does not end the fuzzer.

use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::ops::Range;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::Path;
use std::process::{Child, Command, ExitCode, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

use crate::options::Options;
use crate::place::{Place, last_lines};
use crate::seeds::Seeds;
use crate::target::Target;

/// Address space of a worker, and of every program that it starts, in KiB.
const MEMORY: u64 = 4 << 20;

/// Characters of a failure in reports.
const MAX_CHARACTERS: usize = 400;

/// First words of a failure by panic.
pub const PANICKED: &str = "panicked at ";

/// End of a worker.
pub struct Ended {
    /// Number of the case that failed, and how; none if all cases passed.
    pub failed: Option<(u64, String)>,
    /// Time and number of the slowest case.
    pub slowest: (Duration, u64),
}

/// Tries cases in a process of their own, up to the first that fails or takes longer than `limit`.
pub fn try_cases(target: &Target, cases: &Range<u64>, options: &Options, limit: Duration) -> Ended {
    let stderr = tempfile::NamedTempFile::new().expect("a file for temporary text");
    let mut child = start(target, cases, options, stderr.reopen().unwrap());
    let lines = read_lines(&mut child);
    let mut case = cases.start;
    let mut slowest = (Duration::ZERO, 0);
    let mut panic = None;
    let mut began = Instant::now();
    while let Ok(line) = lines.recv_timeout(limit.saturating_sub(began.elapsed())) {
        match line.strip_prefix("begin ") {
            Some(number) => {
                case = number.parse().unwrap_or(case);
                began = Instant::now();
            }
            None if line == "done" => slowest = slowest.max((began.elapsed(), case)),
            None => panic = Some(line),
        }
    }
    let how = match began.elapsed() < limit {
        true => describe_end(&mut child, panic, stderr.path()),
        false => {
            end(&mut child);
            Some(format!("no end after {} s", limit.as_secs()))
        }
    };
    Ended {
        failed: how.map(|how| (case, how.chars().take(MAX_CHARACTERS).collect())),
        slowest,
    }
}

/// Starts this program again, with less memory.
fn start(target: &Target, cases: &Range<u64>, options: &Options, stderr: File) -> Child {
    let own = std::env::current_exe().expect("the running program has a path");
    let limited = format!("ulimit -v {MEMORY} 2>/dev/null; ulimit -c 0; exec \"$0\" \"$@\"");
    let input = options.input.iter();
    let numbers = [options.seed, cases.start, cases.end];
    let [seed, start, end] = numbers.map(|number| number.to_string());
    let mut sh = Command::new("sh");
    sh.args(["-c", &limited]).arg(own);
    sh.args(["--targets", target.name, "--seed", &seed]);
    sh.args(["--work", &start, &end, "--fixture"]);
    sh.arg(&options.fixture);
    sh.args(input.flat_map(|path| [Path::new("--input"), path]));
    // Stacks and arenas of many threads would fill the address space.
    sh.envs([("RAYON_NUM_THREADS", "2"), ("MALLOC_ARENA_MAX", "4")]);
    sh.env("RUST_BACKTRACE", "0").env_remove("CI");
    sh.stdin(Stdio::null()).stdout(Stdio::piped());
    let child = sh.stderr(stderr).process_group(0).spawn();
    child.expect("sh can be started")
}

/// Reads the worker's lines on a thread.
fn read_lines(child: &mut Child) -> Receiver<String> {
    let out = child.stdout.take().expect("its output is a pipe");
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        let lines = BufReader::new(out).lines().map_while(Result::ok);
        let mut own = lines.filter_map(|line| line.strip_prefix(MARK).map(str::to_owned));
        own.try_for_each(|line| sender.send(line))
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

/// Describes the end: `ended by signal 6: memory allocation of 5368709120 bytes failed`; none if all went well.
fn describe_end(child: &mut Child, panic: Option<String>, stderr: &Path) -> Option<String> {
    let status = child.wait().expect("a worker that was started");
    let how = match (status.code(), status.signal()) {
        (Some(0), _) => return None,
        // A panic that was caught does not end the process.
        (Some(101), _) if panic.is_some() => return panic,
        (_, Some(signal)) => format!("signal {signal}"),
        (code, None) => format!("exit code {}", code.unwrap_or_default()),
    };
    Some(format!("ended by {how}: {}", last_lines(stderr)))
}

/// Prefix of every line for the parent.
pub const MARK: &str = "@fuzz ";

/// Tries inputs one by one and reports each to the parent; ends at the first panic.
pub fn work(options: &Options, cases: Range<u64>) -> ExitCode {
    std::panic::set_hook(Box::new(|panic| {
        say(&panic.to_string().replace('\n', " "));
    }));
    let target = options.targets[0];
    let mut place = Place::new(target.name, &options.fixture);
    let seeds = Seeds::read(target, options, &place);
    for case in cases {
        let input = seeds.make(&place, case);
        say(&format!("begin {case}"));
        let read = (target.run)(&mut place, &input);
        let is_refused = read.is_none() && seeds.is_valid(case);
        assert!(!is_refused, "a valid seed was refused");
        place.check();
        say("done");
    }
    ExitCode::SUCCESS
}

fn say(line: &str) {
    let mut out = std::io::stdout().lock();
    // If the parent is gone, nobody reads the line.
    if writeln!(out, "{MARK}{line}")
        .and_then(|()| out.flush())
        .is_err()
    {
        std::process::exit(0);
    }
}
