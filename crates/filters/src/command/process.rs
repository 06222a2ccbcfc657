//! Run of a program to its end, or until it is stopped.

use std::io;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::output_tail::OutputTail;
use super::process_group::ProcessGroup;

/// End of a program.
pub enum End {
    /// It ended by itself.
    Exited(ExitStatus),
    /// It took too long, and was stopped.
    OutOfTime,
    /// It wrote too large a file, and was stopped.
    TooLarge,
    /// It was stopped on request.
    Interrupted,
}

/// Longest pause between two checks of a running program.
const PAUSE: Duration = Duration::from_millis(20);

/// Lock that lets one program run at a time: every process that appears below this one meanwhile belongs to it.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Runs a program for at most `limit`, and reads what it prints; returns how it ended, and the last lines that it printed. Its
/// descendants end with it, however it ends. `out` is its output file, and the most bytes that this may have.
pub fn run_process(
    mut command: Command,
    limit: Duration,
    out: (&Path, u64),
    interrupted: fn() -> bool,
) -> io::Result<(End, String)> {
    let _turn = (ONE_AT_A_TIME.lock()).unwrap_or_else(PoisonError::into_inner);
    let (output, pipe) = OutputTail::new()?;
    command
        .stdin(Stdio::null())
        .stdout(pipe.try_clone()?)
        .stderr(pipe);
    let mut group = ProcessGroup::spawn(command)?;
    let end = watch(&mut group, limit, out, interrupted);
    // A living process would keep the pipe open.
    drop(group);
    Ok((end?, output.into_lines()))
}

/// Waits until the program ends, breaks a limit or is interrupted.
fn watch(
    group: &mut ProcessGroup,
    limit: Duration,
    (out, max_bytes): (&Path, u64),
    interrupted: fn() -> bool,
) -> io::Result<End> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = group.try_wait()? {
            return Ok(End::Exited(status));
        }
        if interrupted() {
            return Ok(End::Interrupted);
        }
        if start.elapsed() >= limit {
            return Ok(End::OutOfTime);
        }
        if std::fs::symlink_metadata(out).is_ok_and(|found| found.len() > max_bytes) {
            return Ok(End::TooLarge);
        }
        std::thread::sleep(pause);
        pause = (2 * pause).min(PAUSE);
    }
}
