//! Waiting for the GPU, with a time limit.

use std::time::{Duration, Instant};

use super::device::Gpu;
use super::place::Place;
use crate::FilterError;

/// Time between two checks of the clock and of interrupts.
const SLICE: Duration = Duration::from_millis(100);

impl Gpu {
    /// Waits until the GPU has done everything that it was given. Gives up after `time_limit`
    /// seconds, and when the user interrupts.
    pub(super) fn wait(&self, place: Place, time_limit: f64) -> Result<(), FilterError> {
        let start = Instant::now();
        loop {
            let left = Duration::from_secs_f64(time_limit).saturating_sub(start.elapsed());
            let slice = wgpu::PollType::Wait {
                submission_index: None,
                timeout: Some(SLICE.min(left)),
            };
            match self.device().poll(slice) {
                Ok(_) => return self.check_loss(place),
                Err(wgpu::PollError::Timeout) => {}
                Err(error) => {
                    self.check_loss(place)?;
                    return Err(place.refuse(error));
                }
            }
            let error = match (self.interrupted)() {
                true => FilterError::Interrupted,
                false if !left.is_zero() => continue,
                false => FilterError::TooSlow {
                    filter: place.filter.to_owned(),
                    pass: place.pass.to_owned(),
                    time_limit,
                },
            };
            self.abandon();
            return Err(error);
        }
    }

    /// Keeps the device open until the process ends: closing it would wait for the work that was
    /// given up.
    fn abandon(&self) {
        std::mem::forget((self.device(), self.queue()));
    }
}
