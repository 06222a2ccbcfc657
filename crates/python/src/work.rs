//! Long work without Python's lock, which Ctrl-C ends.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use measure::{Error, Monitor};
use pyo3::prelude::*;

use crate::error::to_exception;

/// True while work ends because of a signal. Threads that work at the same time end, too.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// The process that first worked.
static PROCESS: OnceLock<u32> = OnceLock::new();

/// Time between two checks for signals.
const BETWEEN_LOOKS: Duration = Duration::from_millis(50);

/// A monitor that shows nothing, and ends work after a signal.
pub const MONITOR: Monitor = Monitor {
    begin: Monitor::SILENT.begin,
    interrupted: || INTERRUPTED.load(Ordering::Relaxed),
};

/// Does long work on a thread of its own, and handles signals meanwhile. A signal's exception ends
/// the work, and is raised when it has ended.
pub fn work<T: Send>(py: Python, job: impl FnOnce() -> Result<T, Error> + Send) -> PyResult<T> {
    check_process().map_err(to_exception)?;
    let (outcome, signal) = py.detach(|| {
        std::thread::scope(|scope| {
            let (ended, end) = channel::<()>();
            let worker = scope.spawn(move || {
                // Dropped at the end, even by a panic.
                let _ended = ended;
                job()
            });
            let mut signal = None;
            while end.recv_timeout(BETWEEN_LOOKS) == Err(RecvTimeoutError::Timeout) {
                if let Err(exception) = Python::attach(|py| py.check_signals()) {
                    INTERRUPTED.store(true, Ordering::Relaxed);
                    process::stop();
                    signal.get_or_insert(exception);
                }
            }
            (worker.join(), signal)
        })
    });
    if let Some(exception) = signal {
        INTERRUPTED.store(false, Ordering::Relaxed);
        process::resume();
        return Err(exception);
    }
    match outcome {
        Ok(done) => done.map_err(to_exception),
        Err(panic) => std::panic::resume_unwind(panic),
    }
}

/// Refuses a process that was forked from one that has worked: it lacks the threads that work.
fn check_process() -> Result<(), Error> {
    let now = std::process::id();
    if *PROCESS.get_or_init(|| now) == now {
        return Ok(());
    }
    Err(Error::Refused(
        "this process was forked from one that has used shuttertruth, and its threads are not here; start processes with \
         multiprocessing.get_context(\"spawn\"), or use shuttertruth in them alone"
            .to_owned(),
    ))
}
