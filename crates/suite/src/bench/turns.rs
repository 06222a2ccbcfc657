//! Rounds in which filters are timed in turn.

use std::cell::Cell;

use filters::{FilterError, LoadedBlur, PassTime};
use tracer::{Progress, TraceError, Watch};

use crate::Error;

/// Times of every dispatch of one run of a filter.
pub type Times = Vec<PassTime>;

/// Rounds of a bench, and the progress over the runs of filters.
pub struct Turns<'a> {
    pub rounds: u32,
    pub watch: Watch<'a>,
    /// Runs that are done, of all tables.
    pub done: Cell<u64>,
    pub total: u64,
}

impl Turns<'_> {
    /// Runs each blur once, then `beside`, in every round; returns the runs of each blur. A round before the first is not counted.
    pub fn take<T>(
        &self,
        blurs: &[LoadedBlur],
        beside: impl Fn() -> Result<T, FilterError>,
    ) -> Result<(Vec<Vec<Times>>, Vec<T>), Error> {
        let mut runs = vec![Vec::new(); blurs.len()];
        let mut besides = Vec::new();
        for round in 0..=self.rounds {
            let counts = round > 0;
            for (blur, runs) in blurs.iter().zip(&mut runs) {
                let times = blur.time()?;
                runs.extend(counts.then_some(times));
                self.advance(1)?;
            }
            besides.extend(Some(beside()?).filter(|_| counts));
        }
        Ok((runs, besides))
    }

    /// Shows that some runs are done, or left out.
    pub fn advance(&self, runs: u64) -> Result<(), Error> {
        self.done.set(self.done.get() + runs);
        let progress = Progress {
            done: self.done.get(),
            total: self.total,
        };
        match (self.watch)(progress).is_break() {
            true => Err(TraceError::Cancelled.into()),
            false => Ok(()),
        }
    }
}
