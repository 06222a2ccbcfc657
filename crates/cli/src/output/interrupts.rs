//! Signals that end the program: Ctrl-C, a request to end, a terminal that closes.

use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;

use super::print::print_error;

/// Number of the signal that arrived; 0 before one does.
static SIGNAL: AtomicU8 = AtomicU8::new(0);

/// Number of SIGINT, which Ctrl-C sends.
const INTERRUPT: u8 = 2;

/// Time that work has to end by itself after a signal.
const GRACE: Duration = Duration::from_millis(1500);

/// Words after a signal.
pub const INTERRUPTED_TEXT: &str =
    "interrupted; files that are whole stay, and the same command goes on from there";

/// Makes SIGINT, SIGTERM and SIGHUP end the work under way. Work that does not ask ends with the process a moment later. No file is
/// left half written: files are renamed into place when they are whole. A SIGHUP that is ignored at the start stays ignored, so that
/// `nohup` works.
#[cfg(unix)]
pub fn catch_interrupts() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

    let mut caught = vec![SIGINT, SIGTERM];
    if !is_ignored(SIGHUP) {
        caught.push(SIGHUP);
    }
    // Signals that cannot be caught end the process at once.
    let Ok(mut signals) = signal_hook::iterator::Signals::new(caught) else {
        return;
    };
    std::thread::spawn(move || {
        if let Some(signal) = signals.forever().next() {
            end(signal as u8);
        }
    });
}

/// Makes Ctrl-C end the work under way.
#[cfg(not(unix))]
pub fn catch_interrupts() {
    // A handler that cannot be set leaves Ctrl-C as it is.
    let _ = ctrlc::set_handler(|| end(INTERRUPT));
}

/// Returns true if the process ignores a signal, or if the system does not say so.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_none_or(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Asks work to end, and ends the process if it does not.
fn end(signal: u8) {
    SIGNAL.store(signal, Ordering::Relaxed);
    std::thread::sleep(GRACE);
    print_error(INTERRUPTED_TEXT);
    std::process::exit(interrupted_code().into());
}

/// Returns true after a signal that ends the program.
pub fn was_interrupted() -> bool {
    SIGNAL.load(Ordering::Relaxed) != 0
}

/// Returns the exit code after a signal, as shells have it: 128 and the number of the signal.
pub fn interrupted_code() -> u8 {
    match SIGNAL.load(Ordering::Relaxed) {
        0 => 128 + INTERRUPT,
        signal => 128 + signal,
    }
}
