//! A program that runs to its end, or is ended.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use process_wrap::std::CommandWrap;

/// How a program ended.
pub enum End {
    /// By itself.
    Exited(ExitStatus),
    /// It took too long, and was stopped.
    OutOfTime,
    /// It was stopped on request.
    Interrupted,
}

/// Lines, and bytes, of what a program printed that a message shows.
const LAST_LINES: usize = 10;
const LAST_BYTES: u64 = 4096;

/// Longest pause between two looks at a running program.
const PAUSE: Duration = Duration::from_millis(20);

/// Runs a program with its errors and its output together kept aside; returns how it ended, and the last lines that it
/// printed. Where it is stopped, whatever it has started is stopped with it.
pub fn run(
    mut command: Command,
    time_limit: Duration,
    interrupted: fn() -> bool,
) -> io::Result<(End, String)> {
    // A file and no pipe: a pipe that nobody reads fills up and stops the program, and one that is read to its end waits
    // for everything that the program left behind.
    let printed = tempfile::tempfile()?;
    command
        .stdin(Stdio::null())
        .stdout(printed.try_clone()?)
        .stderr(printed.try_clone()?);
    let mut command = CommandWrap::from(command);
    #[cfg(unix)]
    command.wrap(process_wrap::std::ProcessGroup::leader());
    #[cfg(windows)]
    command.wrap(process_wrap::std::JobObject);
    let start = Instant::now();
    let mut child = command.spawn()?;
    let mut pause = Duration::from_millis(1);
    let end = loop {
        if let Some(status) = child.try_wait()? {
            break End::Exited(status);
        }
        let end = match (interrupted(), start.elapsed() >= time_limit) {
            (true, _) => End::Interrupted,
            (_, true) => End::OutOfTime,
            _ => {
                std::thread::sleep(pause);
                pause = (2 * pause).min(PAUSE);
                continue;
            }
        };
        child.kill()?;
        break end;
    };
    Ok((end, last_lines(printed)?))
}

fn last_lines(mut printed: File) -> io::Result<String> {
    let length = printed.seek(SeekFrom::End(0))?;
    printed.seek(SeekFrom::Start(length.saturating_sub(LAST_BYTES)))?;
    let mut bytes = Vec::new();
    printed.take(LAST_BYTES).read_to_end(&mut bytes)?;
    let text = String::from_utf8_lossy(&bytes);
    let lines: Vec<&str> = text.trim_end().lines().collect();
    Ok(lines[lines.len().saturating_sub(LAST_LINES)..].join("\n"))
}
