//! The watch that a caller keeps over long work: what it shows of it, and whether it ends it.

use std::ops::ControlFlow;

use tracer::{Progress, Watch};

/// A step of long work that is under way; it is over when this is dropped.
pub trait Step: Sync {
    /// Takes note of how far the step is. Comes from any thread.
    fn advance(&self, progress: Progress);
}

/// How a caller watches long work.
#[derive(Clone, Copy)]
pub struct Monitor {
    /// Begins to show a step by this label; steps may lie within others.
    pub begin: fn(&str) -> Box<dyn Step>,
    /// Asks whether the work is to end.
    pub interrupted: fn() -> bool,
}

impl Monitor {
    /// Shows nothing and interrupts nothing.
    pub const SILENT: Self = Self {
        begin: |_| Box::new(Unseen),
        interrupted: || false,
    };

    /// The same without anything shown.
    pub fn unseen(self) -> Self {
        Self {
            begin: Self::SILENT.begin,
            ..self
        }
    }

    /// Does a step of long work, which is shown by its label and told to stop where the caller interrupts it.
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

/// A step that nobody sees.
struct Unseen;

impl Step for Unseen {
    fn advance(&self, _: Progress) {}
}
