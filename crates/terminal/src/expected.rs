//! The line before long work: its time, disk space and memory.

use std::path::Path;
use std::time::Duration;

use measure::{RunEstimate, printable_path};

use crate::output::{is_quiet, print_error};

/// Shortest time of work that is announced, in seconds.
const LONG: f64 = 5.0;

/// Prints the expected time, disk space and memory of a run, if it is long.
pub fn print_expected(estimate: &RunEstimate, out: &Path) {
    let mut text = format!(
        "{:.0} MB in {}, {:.1} GB of memory; {} cases",
        (estimate.disk as f64 / 1e6).max(1.0),
        printable_path(out),
        estimate.memory as f64 / 1e9,
        estimate.cases
    );
    if estimate.read_back > 0 {
        text += &format!(", {} of them are there", estimate.read_back);
    }
    print_expected_time(estimate.seconds, &text);
}

/// Prints the expected time of long work, followed by `more`.
pub fn print_expected_time(seconds: f64, more: &str) {
    if seconds < LONG || is_quiet() {
        return;
    }
    let cores = rayon::current_num_threads();
    let time = rough_time(Duration::from_secs_f64(seconds));
    print_error(&format!("expected: about {time} on {cores} cores, {more}"));
}

/// Formats a time without false precision: `20 s`, `4 min`, `2.5 h`.
fn rough_time(time: Duration) -> String {
    match time.as_secs_f64() {
        seconds if seconds < 55.0 => format!("{:.0} s", (seconds / 5.0).ceil() * 5.0),
        seconds if seconds < 5400.0 => format!("{:.0} min", (seconds / 60.0).ceil()),
        seconds => format!("{:.1} h", seconds / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_round() {
        for (seconds, text) in [
            (7.0, "10 s"),
            (56.0, "1 min"),
            (200.0, "4 min"),
            (9000.0, "2.5 h"),
        ] {
            assert_eq!(rough_time(Duration::from_secs_f64(seconds)), text);
        }
    }
}
