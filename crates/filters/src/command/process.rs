//! A program that runs to its end, or is ended.

use std::io;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::group::Group;
use super::printed::Printed;

/// How a program ended.
pub enum End {
    /// By itself.
    Exited(ExitStatus),
    /// It took too long, and was stopped.
    OutOfTime,
    /// It wrote too large a file, and was stopped.
    TooLarge,
    /// It was stopped on request.
    Interrupted,
}

/// What a program may take.
pub struct Limits<'a> {
    /// How long it may run.
    pub time: Duration,
    /// The file that it is to write, and how many bytes that may hold.
    pub out: (&'a Path, u64),
}

/// Longest pause between two looks at a running program.
const PAUSE: Duration = Duration::from_millis(20);

/// Whatever appears below this process while a program runs is that program's.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Runs a program and reads what it prints; returns how it ended, and the last lines that it printed. Whatever it has started
/// ends with it, however it ends.
pub fn run(
    mut command: Command,
    limits: &Limits,
    interrupted: fn() -> bool,
) -> io::Result<(End, String)> {
    let _turn = (ONE_AT_A_TIME.lock()).unwrap_or_else(PoisonError::into_inner);
    let (printed, pipe) = Printed::new()?;
    command
        .stdin(Stdio::null())
        .stdout(pipe.try_clone()?)
        .stderr(pipe);
    let mut group = Group::spawn(command)?;
    let end = watch(&mut group, limits, interrupted);
    // What is alive would keep the pipe open.
    drop(group);
    Ok((end?, printed.last_lines()))
}

fn watch(group: &mut Group, limits: &Limits, interrupted: fn() -> bool) -> io::Result<End> {
    let start = Instant::now();
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = group.try_wait()? {
            return Ok(End::Exited(status));
        }
        if interrupted() {
            return Ok(End::Interrupted);
        }
        if start.elapsed() >= limits.time {
            return Ok(End::OutOfTime);
        }
        let (out, most) = limits.out;
        if std::fs::symlink_metadata(out).is_ok_and(|found| found.len() > most) {
            return Ok(End::TooLarge);
        }
        std::thread::sleep(pause);
        pause = (2 * pause).min(PAUSE);
    }
}
