//! Progress with the remaining time on standard error.

use std::fmt;
use std::io::IsTerminal;
use std::sync::{LazyLock, Mutex};
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressState, ProgressStyle};
use measure::{Monitor, Step, printable};
use terminal_size::{Width, terminal_size_of};
use tracer::Progress;

use super::{is_quiet, print_error, was_interrupted};

/// Time between two log lines without a terminal.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

/// All bars on the screen: one per running step.
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// Makes a command's monitor: a bar on a terminal, lines in a log, nothing with --quiet. It stops
/// work after Ctrl-C.
pub fn make_monitor() -> Monitor {
    Monitor {
        begin: match (is_quiet(), std::io::stderr().is_terminal()) {
            (true, _) => Monitor::SILENT.begin,
            (false, true) => |label| Box::new(Bar::new(label)),
            (false, false) => |label| Box::new(Lines::new(label, Instant::now())),
        },
        interrupted: was_interrupted,
    }
}

/// Progress as one of several bars on a terminal.
struct Bar(ProgressBar);

impl Bar {
    fn new(label: &str) -> Self {
        let bar = BARS.add(ProgressBar::no_length());
        let (label_width, bar_width) = match terminal_size_of(std::io::stderr()) {
            Some((Width(columns), _)) if columns < 80 => (28, 10),
            _ => (36, 20),
        };
        let template =
            format!("{{msg:{label_width}!}} {{bar:{bar_width}}} {{percent:>3}} % {{left}}");
        let style = ProgressStyle::with_template(&template).expect("the template is valid");
        bar.set_style(style.with_key(
            "left",
            |state: &ProgressState, text: &mut dyn fmt::Write| {
                // The remaining time is unknown before the first progress.
                if state.pos() > 0 {
                    let _ = write!(text, "{} left", clock_text(state.eta()));
                }
            },
        ));
        bar.set_message(printable(label).into_owned());
        Self(bar)
    }
}

impl Step for Bar {
    fn advance(&self, Progress { done, total }: Progress) {
        self.0.set_length(total);
        self.0.set_position(done);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.0.finish_and_clear();
        BARS.remove(&self.0);
    }
}

/// Writes a line to standard error, above the bars if any are shown.
pub fn print_above_bars(text: &str) {
    BARS.suspend(|| print_error(text));
}

/// Formats minutes and seconds: `1:30`.
pub fn clock_text(time: Duration) -> String {
    let seconds = time.as_secs_f64().round() as u64;
    format!("{}:{:02}", seconds / 60, seconds % 60)
}

/// Progress as lines of a log.
struct Lines {
    label: String,
    times: Mutex<LineTimes>,
}

/// Times of a log.
struct LineTimes {
    /// End of work that does not predict the rest, such as a pilot.
    began: Instant,
    /// Time of the last line.
    last: Instant,
}

impl Step for Lines {
    fn advance(&self, progress: Progress) {
        if let Some(line) = self.line(progress, Instant::now()) {
            print_error(&line);
        }
    }
}

impl Lines {
    fn new(label: &str, now: Instant) -> Self {
        Self {
            label: label.to_owned(),
            times: Mutex::new(LineTimes {
                began: now,
                last: now,
            }),
        }
    }

    /// Formats a line, `fan trailing, replicate 3: 40 %, 1:30 left`; none if the last line is
    /// recent.
    fn line(&self, progress: Progress, now: Instant) -> Option<String> {
        let mut times = self.times.lock().ok()?;
        if progress.done == 0 {
            times.began = now;
        }
        if now.duration_since(times.last) < BETWEEN_LINES || progress.total == 0 {
            return None;
        }
        times.last = now;
        let elapsed = now.duration_since(times.began);
        let part = progress.done as f64 / progress.total as f64;
        let left = (part > 0.0).then(|| elapsed.mul_f64((1.0 - part) / part));
        let left = left.map_or(String::new(), |left| format!(", {} left", clock_text(left)));
        Some(format!("{}: {:.0} %{left}", self.label, 100.0 * part))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_at_long_intervals_and_tell_the_remaining_time() {
        let began = Instant::now();
        let lines = Lines::new("fan", began);
        let at = |seconds: u64, done| {
            let progress = Progress { done, total: 200 };
            lines.line(progress, began + Duration::from_secs(seconds))
        };
        assert_eq!(at(29, 10), None);
        assert_eq!(at(30, 0).unwrap(), "fan: 0 %");
        assert_eq!(at(59, 40), None);
        // A quarter in the 70 s since the start: three more quarters are left.
        assert_eq!(at(100, 50).unwrap(), "fan: 25 %, 3:30 left");
        assert_eq!(at(101, 60), None);
    }
}
