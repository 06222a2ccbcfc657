//! Progress bars with the remaining time, and Ctrl-C.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use tracer::Progress;

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Makes Ctrl-C end the render that is under way instead of the process, so that no file is left half written.
pub fn catch_interrupts() {
    // A handler that cannot be set leaves Ctrl-C as it is: files are renamed into place only when whole.
    let _ = ctrlc::set_handler(|| INTERRUPTED.store(true, Ordering::Relaxed));
}

/// Whether Ctrl-C was pressed.
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::Relaxed)
}

/// Runs `work` with a watch that draws a bar named `label` on a terminal (never when `quiet`) and stops at Ctrl-C.
pub fn with_bar<T>(label: &str, quiet: bool, work: impl FnOnce(tracer::Watch) -> T) -> T {
    let bar = ProgressBar::with_draw_target(None, target(quiet));
    let style = ProgressStyle::with_template("{msg:36} {bar:20} {percent:>3} % {eta:>4} left")
        .expect("the template is a constant");
    bar.set_style(style);
    bar.set_message(label.to_owned());
    let result = work(&|progress: Progress| {
        bar.set_length(progress.total);
        bar.set_position(progress.done);
        if interrupted() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    bar.finish_and_clear();
    result
}

fn target(quiet: bool) -> ProgressDrawTarget {
    if quiet {
        ProgressDrawTarget::hidden()
    } else {
        ProgressDrawTarget::stderr()
    }
}
