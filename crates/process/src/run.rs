//! Run of a program to its end, or until it is stopped.

use std::io;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::limits::Limits;
use crate::process_group::ProcessGroup;

/// End of a program.
#[derive(Debug)]
pub enum End {
    /// It ended by itself.
    Exited(ExitStatus),
    /// It took too long, and was stopped.
    OutOfTime,
    /// It wrote too large a file, and was stopped.
    TooLarge,
    /// [`stop`] stopped it.
    Stopped,
}

/// Longest pause between two checks of a running program.
const PAUSE: Duration = Duration::from_millis(20);

/// Lock that lets one program run at a time: every process that appears below this one meanwhile
/// belongs to that program.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Whether [`stop`] has been called.
static STOPPED: AtomicBool = AtomicBool::new(false);

/// Stops the program that runs, within some 20 ms, and all that are started later. Call this before
/// this process ends, so that no program outlives it.
pub fn stop() {
    STOPPED.store(true, Ordering::Relaxed);
}

/// Lets programs start again after [`stop`], for a process that goes on.
pub fn resume() {
    STOPPED.store(false, Ordering::Relaxed);
}

/// Runs a program with nothing on its standard input, and returns how it ended. Whatever it started
/// ends with it. Programs run one at a time.
///
/// # Errors
/// The program cannot be started, or the system refuses to watch it.
pub fn run(mut command: Command, limits: &Limits) -> io::Result<End> {
    let _turn = (ONE_AT_A_TIME.lock()).unwrap_or_else(PoisonError::into_inner);
    if STOPPED.load(Ordering::Relaxed) {
        return Ok(End::Stopped);
    }
    command.stdin(Stdio::null());
    let mut group = ProcessGroup::spawn(command, limits)?;
    watch(&mut group, limits)
}

/// Waits until the program ends, breaks a limit or is stopped.
fn watch(group: &mut ProcessGroup, limits: &Limits) -> io::Result<End> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = group.try_wait()? {
            return Ok(End::Exited(status));
        }
        if STOPPED.load(Ordering::Relaxed) {
            return Ok(End::Stopped);
        }
        if start.elapsed() >= limits.time {
            return Ok(End::OutOfTime);
        }
        if let Some(output) = &limits.output
            && std::fs::symlink_metadata(&output.path).is_ok_and(|file| file.len() > output.bytes)
        {
            return Ok(End::TooLarge);
        }
        std::thread::sleep(pause);
        pause = (2 * pause).min(PAUSE);
    }
}
