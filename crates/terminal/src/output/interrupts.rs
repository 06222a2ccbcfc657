//! Signals that end the program: Ctrl-C, a request to end, a closing terminal.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::register_usize;

use super::print_error;

/// Number of the signal that arrived; 0 before.
static SIGNAL: LazyLock<Arc<AtomicUsize>> = LazyLock::new(Arc::default);

/// Time for work to end by itself after a signal.
const GRACE: Duration = Duration::from_millis(1500);

/// Time between two checks for a signal.
const BETWEEN_LOOKS: Duration = Duration::from_millis(50);

/// Words after a signal.
pub const INTERRUPTED_TEXT: &str =
    "interrupted; finished files are kept, and the same command continues";

/// Makes signals end the current work and the programs that it runs. Work that does not check for
/// signals ends with the process a moment later. No file is left half-written: files are renamed
/// into place when complete.
pub fn catch_interrupts() {
    for signal in caught_signals() {
        // A signal that cannot be caught ends the process at once.
        let _ = register_usize(signal, Arc::clone(&SIGNAL), signal as usize);
    }
    std::thread::spawn(|| {
        while !was_interrupted() {
            std::thread::sleep(BETWEEN_LOOKS);
        }
        process::stop();
        std::thread::sleep(GRACE);
        print_error(INTERRUPTED_TEXT);
        std::process::exit(interrupted_code().into());
    });
}

/// Lists the signals that end the program. A SIGHUP ignored at the start stays ignored, so that
/// `nohup` works.
fn caught_signals() -> Vec<i32> {
    let mut signals = vec![SIGINT, SIGTERM];
    #[cfg(unix)]
    {
        use signal_hook::consts::{SIGHUP, SIGQUIT};
        signals.push(SIGQUIT);
        signals.extend((!is_ignored(SIGHUP)).then_some(SIGHUP));
    }
    signals
}

/// Returns true if the process ignores a signal, or if that is unknown; only Linux reports it.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_none_or(|mask| mask >> (signal - 1) & 1 == 1)
}

/// Returns true after a signal that ends the program.
pub fn was_interrupted() -> bool {
    SIGNAL.load(Ordering::Relaxed) != 0
}

/// Returns the exit code after a signal, as in shells: 128 plus the signal's number.
pub fn interrupted_code() -> u8 {
    let signal = match SIGNAL.load(Ordering::Relaxed) {
        0 => SIGINT as usize,
        signal => signal,
    };
    128 + signal as u8
}
