//! Progress with the remaining time on standard error.

use std::fmt;
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{LazyLock, Mutex, OnceLock};
use std::time::{Duration, Instant};

use indicatif::{MultiProgress, ProgressBar, ProgressState, ProgressStyle};
use store::printable;
use suite::{Monitor, Step};
use terminal_size::{Width, terminal_size_of};
use tracer::Progress;

use super::interrupts::was_interrupted;
use super::print::print_error;
use super::verbosity::is_quiet;

/// Time between two lines of a log, where no terminal shows a bar.
const BETWEEN_LINES: Duration = Duration::from_secs(30);

/// All bars on the screen: one per step under way.
static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

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

/// Positions of a full bar.
const FULL: f64 = 1e6;
/// Weight of the time that was expected, against the time that work has taken so far, for the time left.
const EXPECTATION: f64 = 0.1;

/// The bar of all steps, while it is shown.
static WHOLE_BAR: Mutex<Option<WholeBar>> = Mutex::new(None);

/// A bar that moves with the steps within it, by their expected times.
struct WholeBar {
    bar: ProgressBar,
    steps: Steps,
    done: usize,
    /// Steps within that have ended since.
    ended: usize,
}

impl WholeBar {
    /// Moves the bar to the steps that are done and a part of the one under way. It never moves back.
    fn advance(&self, part: f64) {
        let position = (FULL * self.steps.part(self.done + self.ended, part)) as u64;
        self.bar.set_position(position.max(self.bar.position()));
    }
}

/// Steps of long work, with their expected times.
#[derive(Clone)]
struct Steps {
    /// Expected seconds until the beginning of each step, and until the end of the last one.
    begins: Vec<f64>,
}

impl Steps {
    fn new(seconds: &[f64]) -> Self {
        let mut begins = vec![0.0];
        for seconds in seconds {
            begins.push(begins[begins.len() - 1] + seconds);
        }
        Self { begins }
    }

    /// Returns the expected time of all steps, in seconds.
    fn whole(&self) -> f64 {
        self.begins[self.begins.len() - 1]
    }

    /// Returns the part of the expected time that is over after some steps and a part of the next.
    fn part(&self, done: usize, part: f64) -> f64 {
        let last = self.begins.len() - 1;
        let [begin, end] = [done, done + 1].map(|step| self.begins[step.min(last)]);
        let over = begin + (end - begin) * part.clamp(0.0, 1.0);
        match self.whole() {
            0.0 => 1.0,
            whole => over / whole,
        }
    }

    /// Estimates the time left: at first from the expected time alone, later from the time that the work has taken.
    fn left(&self, elapsed: Duration, part: f64) -> Duration {
        let weighed = elapsed.as_secs_f64() + EXPECTATION * self.whole();
        Duration::from_secs_f64((1.0 - part).max(0.0) * weighed / (part + EXPECTATION))
    }
}

/// Does something to the bar of all steps, if it is shown.
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
    is_whole: AtomicBool,
}

impl Bar {
    fn new(label: &str) -> Self {
        let bar = BARS.add(ProgressBar::no_length());
        bar.set_style(bar_style(|state| {
            // Nothing done says nothing about the rest.
            (state.pos() > 0).then(|| state.eta())
        }));
        bar.set_message(printable(label).into_owned());
        Self {
            bar,
            is_whole: AtomicBool::new(false),
        }
    }

    fn is_whole(&self) -> bool {
        self.is_whole.load(Ordering::Relaxed)
    }
}

/// Makes the look of a bar, which ends with the time left.
fn bar_style(
    left: impl Fn(&ProgressState) -> Option<Duration> + Clone + Send + Sync + 'static,
) -> ProgressStyle {
    let (label, bar) = match terminal_size_of(std::io::stderr()) {
        Some((Width(columns), _)) if columns < 80 => (28, 10),
        _ => (36, 20),
    };
    ProgressStyle::with_template(&format!(
        "{{msg:{label}!}} {{bar:{bar}}} {{percent:>3}} % {{left}}"
    ))
    .expect("the template is valid")
    .with_key(
        "left",
        move |state: &ProgressState, text: &mut dyn fmt::Write| {
            if let Some(left) = left(state) {
                let _ = write!(text, "{} left", clock_text(left));
            }
        },
    )
}

impl Step for Bar {
    fn expect(&self, seconds: &[f64]) {
        if seconds.is_empty() {
            return;
        }
        let steps = Steps::new(seconds);
        let of_left = steps.clone();
        let bar = self.bar.clone();
        bar.set_length(FULL as u64);
        bar.set_style(bar_style(move |state| {
            Some(of_left.left(state.elapsed(), f64::from(state.fraction())))
        }));
        // The time left falls while a step says nothing.
        bar.enable_steady_tick(Duration::from_secs(1));
        if let Ok(mut whole) = WHOLE_BAR.lock() {
            self.is_whole.store(true, Ordering::Relaxed);
            *whole = Some(WholeBar {
                bar,
                steps,
                done: 0,
                ended: 0,
            });
        }
    }

    fn advance(&self, progress: Progress) {
        let Progress { done, total } = progress;
        if self.is_whole() {
            with_whole_bar(|whole| {
                (whole.done, whole.ended) = (done as usize, 0);
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
        match self.is_whole() {
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
    times: Mutex<LineTimes>,
    /// Steps within, where their times are expected.
    steps: OnceLock<Steps>,
}

/// Times of a log.
struct LineTimes {
    /// End of what says nothing about the rest, such as a pilot.
    began: Instant,
    /// The last line.
    last: Instant,
}

impl Step for Lines {
    fn expect(&self, seconds: &[f64]) {
        if !seconds.is_empty() {
            let _ = self.steps.set(Steps::new(seconds));
        }
    }

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
            times: Mutex::new(LineTimes {
                began: now,
                last: now,
            }),
            steps: OnceLock::new(),
        }
    }

    /// Makes a line, `fan trailing, replicate 3: 40 %, 1:30 left`; none where the last line is recent.
    fn line(&self, progress: Progress, now: Instant) -> Option<String> {
        let mut times = self.times.lock().ok()?;
        if progress.done == 0 && self.steps.get().is_none() {
            times.began = now;
        }
        if now.duration_since(times.last) < BETWEEN_LINES || progress.total == 0 {
            return None;
        }
        times.last = now;
        let elapsed = now.duration_since(times.began);
        let (part, left) = match self.steps.get() {
            Some(steps) => {
                let part = steps.part(progress.done as usize, 0.0);
                (part, Some(steps.left(elapsed, part)))
            }
            None => {
                let part = progress.done as f64 / progress.total as f64;
                let left = (part > 0.0).then(|| elapsed.mul_f64((1.0 - part) / part));
                (part, left)
            }
        };
        let left = left.map_or(String::new(), |left| format!(", {} left", clock_text(left)));
        Some(format!("{}: {:.0} %{left}", self.label, 100.0 * part))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_of_all_steps_moves_with_their_expected_times_and_never_back() {
        let mut whole = WholeBar {
            bar: ProgressBar::hidden(),
            steps: Steps::new(&[1.0, 6.0, 2.0, 1.0]),
            done: 0,
            ended: 0,
        };
        whole.bar.set_length(FULL as u64);
        for (done, ended, part, expected) in [
            (0, 0, 0.5, 0.05),
            (0, 1, 0.5, 0.4),
            (1, 0, 0.0, 0.4),
            (2, 0, 0.5, 0.8),
            (2, 1, 1.0, 1.0),
            (4, 0, 0.0, 1.0),
        ] {
            (whole.done, whole.ended) = (done, ended);
            whole.advance(part);
            let position = whole.bar.position() as f64 / FULL;
            assert!((position - expected).abs() < 1e-5, "{position} {expected}");
        }
    }

    #[test]
    fn the_time_left_is_at_first_what_was_expected_and_later_what_was_seen() {
        let steps = Steps::new(&[60.0, 40.0]);
        let left = |elapsed, part| {
            let left = steps.left(Duration::from_secs(elapsed), part);
            left.as_secs_f64()
        };
        assert_eq!(left(0, 0.0), 100.0);
        // Work that takes twice the expected time.
        assert!(left(10, 0.05) > 100.0);
        assert!((left(180, 0.9) - 20.0).abs() < 2.0, "{}", left(180, 0.9));
        assert_eq!(left(200, 1.0), 0.0);
        assert_eq!(Steps::new(&[0.0]).part(0, 0.0), 1.0);
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
        // A quarter in the 70 s since nothing was done: three more are left.
        assert_eq!(at(100, 50).unwrap(), "fan: 25 %, 3:30 left");
        assert_eq!(at(101, 60), None);
    }
}
