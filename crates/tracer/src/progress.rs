//! The progress of a render, and its cancellation.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use crate::error::TraceError;

/// The work done and the whole work, in samples of pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Samples traced.
    pub done: u64,
    /// Samples to trace.
    pub total: u64,
}

impl Progress {
    /// Reports how many pieces of work are done; an error if the watcher asks to stop.
    pub fn report(watch: Watch, done: usize, total: usize) -> Result<(), TraceError> {
        let [done, total] = [done, total].map(|count| count as u64);
        if watch(Self { done, total }).is_break() {
            Err(TraceError::Cancelled)
        } else {
            Ok(())
        }
    }
}

/// A function that any thread calls after every piece of work; `Break` cancels the render.
pub type Watch<'a> = &'a (dyn Fn(Progress) -> ControlFlow<()> + Sync);

/// Counts the work of several threads.
pub(crate) struct Meter<'a> {
    watch: Watch<'a>,
    done: AtomicU64,
    total: u64,
    cancelled: AtomicBool,
}

impl<'a> Meter<'a> {
    pub fn new(watch: Watch<'a>, total: u64) -> Self {
        Self {
            watch,
            done: AtomicU64::new(0),
            total,
            cancelled: AtomicBool::new(false),
        }
    }

    /// Reports that this many more samples are done.
    pub fn advance(&self, samples: u64) {
        let done = self.done.fetch_add(samples, Ordering::Relaxed) + samples;
        let progress = Progress {
            done,
            total: self.total,
        };
        if (self.watch)(progress).is_break() {
            self.cancelled.store(true, Ordering::Relaxed);
        }
    }

    /// Fails once the watcher has asked to stop.
    pub fn check(&self) -> Result<(), TraceError> {
        if self.cancelled.load(Ordering::Relaxed) {
            Err(TraceError::Cancelled)
        } else {
            Ok(())
        }
    }
}
