//! Monitor of long work, through which a caller shows progress and interrupts.

use std::ops::ControlFlow;

use tracer::{Progress, Watch};

/// A step of long work that is under way. It ends when this is dropped.
pub trait Step: Sync {
    /// Notes how far the step is; called from any thread.
    fn advance(&self, progress: Progress);
}

/// A caller's way to show and to interrupt long work.
#[derive(Clone, Copy)]
pub struct Monitor {
    /// Begins to show a step by this label; steps may lie within others.
    pub begin: fn(&str) -> Box<dyn Step>,
    /// Returns true if the work is to end.
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

    /// Does a step of long work, shows its progress by a label, and tells it to stop where the caller interrupts.
    pub fn watch<T>(&self, label: &str, work: impl FnOnce(Watch) -> T) -> T {
        let step = (self.begin)(label);
        work(&|progress| {
            step.advance(progress);
            match (self.interrupted)() {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            }
        })
    }
}

/// A step that is not shown.
impl Step for () {
    fn advance(&self, _: Progress) {}
}
