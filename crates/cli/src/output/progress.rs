//! Progress with the remaining time on standard error, and Ctrl-C.

use std::fmt;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex};
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressState, ProgressStyle};
use tracer::Progress;

use suite::{Monitor, Step, printable};

use super::print::print_error;
use super::verbosity::is_quiet;

/// Time between two lines of a log, where no terminal shows a bar.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// All bars on the screen: one per step under way.
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// Time that work has to end by itself after Ctrl-C.
const GRACE: Duration = Duration::from_millis(1500);

/// Exit code after Ctrl-C.
pub const INTERRUPTED_CODE: u8 = 130;

/// Makes Ctrl-C end the work under way. Work that does not ask ends with the process a moment later. No file is left half
/// written: files are renamed into place when they are whole.
pub fn catch_interrupts() {
    // A handler that cannot be set leaves Ctrl-C as it is.
    let _ = ctrlc::set_handler(|| {
        INTERRUPTED.store(true, Ordering::Relaxed);
        std::thread::sleep(GRACE);
        print_error("interrupted");
        std::process::exit(INTERRUPTED_CODE.into());
    });
}

/// Tells whether Ctrl-C was pressed.
pub fn was_interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Makes the monitor of a command: a bar on a terminal, lines in a log, nothing with --quiet. It ends work after Ctrl-C.
pub fn make_monitor() -> Monitor {
    Monitor {
        begin: match (is_quiet(), std::io::stderr().is_terminal()) {
            (true, _) => Monitor::SILENT.begin,
            (false, true) => |label| Box::new(Bar::new(label)),
            (false, false) => |label| Box::new(Lines::new(label, Instant::now())),
        },
        interrupted: was_interrupted,
        ..Monitor::SILENT
    }
}

/// Makes a monitor that shows nothing, for work that takes no time. It ends work after Ctrl-C.
pub fn make_silent_monitor() -> Monitor {
    make_monitor().without_progress()
}

/// Label of the step whose bar follows the steps within it.
const WHOLE: &str = "scenes in all";
/// Parts of a step of that bar.
const PARTS: u64 = 1000;

/// The bar of all scenes, while it is shown.
static WHOLE_BAR: Mutex<Option<WholeBar>> = Mutex::new(None);

/// A bar that moves with the steps within it, each of which counts as one.
struct WholeBar {
    bar: ProgressBar,
    done: u64,
    /// Steps within that have ended since.
    ended: u64,
}

impl WholeBar {
    /// Moves the bar to the steps that are done and a part of the one under way. It never moves back.
    fn advance(&self, part: f64) {
        let parts = PARTS as f64 * (self.ended as f64 + part.clamp(0.0, 1.0));
        let position = self.done * PARTS + parts as u64;
        self.bar.set_position(position.max(self.bar.position()));
    }
}

/// Does something to the bar of all scenes, if it is shown.
fn with_whole_bar(change: impl FnOnce(&mut WholeBar)) {
    if let Ok(mut whole) = WHOLE_BAR.lock()
        && let Some(whole) = whole.as_mut()
    {
        change(whole);
    }
}

/// Progress as a bar on a terminal, beside others.
struct Bar {
    bar: ProgressBar,
    is_whole: bool,
}

impl Bar {
    fn new(label: &str) -> Self {
        let bar = BARS.add(ProgressBar::no_length());
        let style = ProgressStyle::with_template("{msg:36} {bar:20} {percent:>3} % {left}")
            .expect("the template is a constant")
            .with_key(
                "left",
                |state: &ProgressState, text: &mut dyn fmt::Write| {
                    // Nothing done says nothing about the rest.
                    if state.pos() > 0 {
                        let _ = write!(text, "{} left", clock_text(state.eta()));
                    }
                },
            );
        bar.set_style(style);
        bar.set_message(printable(label).into_owned());
        let is_whole = label.ends_with(WHOLE);
        if is_whole && let Ok(mut whole) = WHOLE_BAR.lock() {
            *whole = Some(WholeBar {
                bar: bar.clone(),
                done: 0,
                ended: 0,
            });
        }
        Self { bar, is_whole }
    }
}

impl Step for Bar {
    fn advance(&self, progress: Progress) {
        let Progress { done, total } = progress;
        if self.is_whole {
            self.bar.set_length(total * PARTS);
            with_whole_bar(|whole| {
                (whole.done, whole.ended) = (done, 0);
                whole.advance(0.0);
            });
        } else {
            self.bar.set_length(total);
            self.bar.set_position(done);
            with_whole_bar(|whole| whole.advance(done as f64 / total.max(1) as f64));
        }
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        match self.is_whole {
            true => {
                if let Ok(mut whole) = WHOLE_BAR.lock() {
                    *whole = None;
                }
            }
            false => with_whole_bar(|whole| whole.ended += 1),
        }
        self.bar.finish_and_clear();
        BARS.remove(&self.bar);
    }
}

/// Formats minutes and seconds: `1:30`.
pub fn clock_text(time: Duration) -> String {
    let seconds = time.as_secs_f64().round() as u64;
    format!("{}:{:02}", seconds / 60, seconds % 60)
}

/// Progress as lines of a log.
struct Lines {
    label: String,
    began: Instant,
    last: Mutex<Instant>,
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
            label: printable(label).into_owned(),
            began: now,
            last: Mutex::new(now),
        }
    }

    /// Makes a line, `fan trailing, replicate 3: 40 %, 1:30 left`; none where the last line is recent.
    fn line(&self, progress: Progress, now: Instant) -> Option<String> {
        let mut last = self.last.lock().ok()?;
        if now.duration_since(*last) < BETWEEN_LINES || progress.total == 0 {
            return None;
        }
        *last = now;
        let part = progress.done as f64 / progress.total as f64;
        let left = match part > 0.0 {
            true => {
                let elapsed = now.duration_since(self.began).as_secs_f64();
                let left = Duration::from_secs_f64(elapsed * (1.0 - part) / part);
                format!(", {} left", clock_text(left))
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
    fn the_bar_of_all_scenes_moves_with_the_steps_within_and_never_back() {
        let mut whole = WholeBar {
            bar: ProgressBar::hidden(),
            done: 3,
            ended: 0,
        };
        whole.bar.set_length(10 * PARTS);
        let mut last = 0;
        for (ended, part) in [(0, 0.0), (0, 0.25), (0, 1.0), (1, 0.5), (2, 0.1)] {
            whole.ended = ended;
            whole.advance(part);
            let position = whole.bar.position();
            assert_eq!(
                position,
                3 * PARTS + (PARTS as f64 * (ended as f64 + part)) as u64
            );
            assert!(position >= last);
            last = position;
        }
        (whole.done, whole.ended) = (4, 0);
        whole.advance(0.0);
        assert_eq!(
            whole.bar.position(),
            last,
            "a step that took longer does not move it back"
        );
    }

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
        // A quarter in 100 s: three more are left.
        assert_eq!(at(100, 50).unwrap(), "fan: 25 %, 5:00 left");
        assert_eq!(at(101, 60), None);
    }
}
