//! Progress with the remaining time on standard error, and Ctrl-C.

use std::fmt;
use std::io::{IsTerminal, Write};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex};
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressState, ProgressStyle};
use tracer::Progress;

use crate::printable::printable;

/// Between two lines where no terminal shows a bar: what a log of some hours can hold.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// All bars on the screen: a long step has one, and so has the part of it that is under way.
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// How long work has to end by itself after Ctrl-C.
const GRACE: Duration = Duration::from_millis(1500);

/// What a process ends with that Ctrl-C ended.
pub(crate) const INTERRUPTED_CODE: u8 = 130;

/// Makes Ctrl-C end the work that is under way, so that it can say how far it came. Work that does not look ends with the
/// process a moment later. No file is left half written: files are renamed into place when they are whole.
pub fn catch_interrupts() {
    // A handler that cannot be set leaves Ctrl-C as it is.
    let _ = ctrlc::set_handler(|| {
        INTERRUPTED.store(true, Ordering::Relaxed);
        std::thread::sleep(GRACE);
        tell("shuttertruth: interrupted");
        std::process::exit(INTERRUPTED_CODE.into());
    });
}

/// Writes a line to standard error. What nobody can read is no reason to end otherwise.
pub fn tell(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Whether Ctrl-C was pressed.
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Runs `work` with a watch that stops it at Ctrl-C and shows how far it is: as a bar named `label` on a terminal, as a plain
/// line at long intervals elsewhere, not at all when `quiet`. Bars may be shown while others are.
pub fn with_bar<T>(label: &str, quiet: bool, work: impl FnOnce(tracer::Watch) -> T) -> T {
    let on_terminal = std::io::stderr().is_terminal();
    let label = &*printable(label);
    let bar = match quiet || !on_terminal {
        true => ProgressBar::hidden(),
        false => BARS.add(ProgressBar::no_length()),
    };
    let style = ProgressStyle::with_template("{msg:36} {bar:20} {percent:>3} % {left}")
        .expect("the template is a constant")
        .with_key(
            "left",
            |state: &ProgressState, text: &mut dyn fmt::Write| {
                // Nothing done says nothing about the rest.
                if state.pos() > 0 {
                    let _ = write!(text, "{} left", clock(state.eta()));
                }
            },
        );
    bar.set_style(style);
    bar.set_message(label.to_owned());
    let lines = (!quiet && !on_terminal).then(|| Mutex::new(Lines::new(label, Instant::now())));
    let result = work(&|progress: Progress| {
        bar.set_length(progress.total);
        bar.set_position(progress.done);
        if let Some(lines) = &lines
            && let Ok(mut lines) = lines.lock()
            && let Some(line) = lines.line(progress, Instant::now())
        {
            tell(&line);
        }
        if interrupted() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    bar.finish_and_clear();
    BARS.remove(&bar);
    result
}

/// `1:30`: minutes and seconds.
fn clock(time: Duration) -> String {
    let seconds = time.as_secs_f64().round() as u64;
    format!("{}:{:02}", seconds / 60, seconds % 60)
}

/// Progress as lines of a log.
struct Lines {
    label: String,
    began: Instant,
    last: Instant,
}

impl Lines {
    fn new(label: &str, now: Instant) -> Self {
        Self {
            label: label.to_owned(),
            began: now,
            last: now,
        }
    }

    /// `fan trailing, replicate 3: 40 %, 1:30 left`; none where the last line is not long ago.
    fn line(&mut self, progress: Progress, now: Instant) -> Option<String> {
        if now.duration_since(self.last) < BETWEEN_LINES || progress.total == 0 {
            return None;
        }
        self.last = now;
        let part = progress.done as f64 / progress.total as f64;
        let left = match part > 0.0 {
            true => {
                let elapsed = now.duration_since(self.began).as_secs_f64();
                let left = Duration::from_secs_f64(elapsed * (1.0 - part) / part);
                format!(", {} left", clock(left))
            }
            false => String::new(),
        };
        Some(format!("{}: {:.0} %{left}", self.label, 100.0 * part))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_come_at_long_intervals_and_tell_the_remaining_time() {
        let began = Instant::now();
        let mut lines = Lines::new("fan", began);
        let mut at = |seconds: u64, done| {
            let progress = Progress { done, total: 200 };
            lines.line(progress, began + Duration::from_secs(seconds))
        };
        assert_eq!(at(29, 10), None);
        assert_eq!(at(30, 0).unwrap(), "fan: 0 %");
        assert_eq!(at(59, 40), None);
        // A quarter in 100 s: three more are left.
        assert_eq!(at(100, 50).unwrap(), "fan: 25 %, 5:00 left");
        assert_eq!(at(101, 60), None);
    }
}
