//! Monitor of long work: a caller's progress display and interruption.

use std::ops::ControlFlow;

use tracer::{Progress, Watch};

/// A running step of long work. It ends when this is dropped.
pub trait Step: Sync {
    /// Notes how far the step is; called from any thread.
    fn advance(&self, progress: Progress);
}

/// A caller's way to show and interrupt long work.
#[derive(Clone, Copy)]
pub struct Monitor {
    /// Begins to show a step by this label; steps may be nested.
    pub begin: fn(&str) -> Box<dyn Step>,
    /// Returns true if the work must end.
    pub interrupted: fn() -> bool,
}

impl Monitor {
    /// A monitor that shows nothing and interrupts nothing.
    pub const SILENT: Self = Self {
        begin: |_| Box::new(()),
        interrupted: || false,
    };

    /// Returns the same monitor without progress.
    pub fn without_progress(self) -> Self {
        Self {
            begin: Self::SILENT.begin,
            ..self
        }
    }

    /// Does a step of long work, shows its progress under a label, and tells it to stop if the
    /// caller interrupts.
    pub fn watch<T>(&self, label: &str, work: impl FnOnce(Watch) -> T) -> T {
        let step = (self.begin)(label);
        work(&|progress| {
            step.advance(progress);
            if (self.interrupted)() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })
    }
}

/// A step that is not shown.
impl Step for () {
    fn advance(&self, _: Progress) {}
}
