//! Waiting for the GPU, with a time limit.

use std::sync::{MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::device::Gpu;
use super::place::Place;
use crate::FilterError;
use crate::filter::DEFAULT_TIME_LIMIT;

/// Time between two checks of the clock and of interrupts.
const SLICE: Duration = Duration::from_millis(100);

/// A turn on the GPU. Threads that share it take turns: the time of one's work is not counted as
/// another's, and wgpu panics if work is submitted while another thread waits.
pub(super) struct Turn<'g> {
    gpu: &'g Gpu,
    /// The pass that was given up, if one was: the adapter may still be at work on it.
    given_up: MutexGuard<'g, Option<String>>,
}

impl Gpu {
    /// Waits until no other thread has a turn. Fails if a pass was given up.
    pub(super) fn take_turn(&self, place: Place) -> Result<Turn<'_>, FilterError> {
        let given_up = self.given_up.lock().unwrap_or_else(PoisonError::into_inner);
        match &*given_up {
            None => Ok(Turn {
                gpu: self,
                given_up,
            }),
            Some(pass) => Err(place.refuse(format!("not run, since {pass} was given up"))),
        }
    }
}

impl Turn<'_> {
    /// Gives work to the GPU.
    pub fn submit(&mut self, commands: wgpu::CommandBuffer) {
        self.gpu.queue().submit([commands]);
    }

    /// Waits for the GPU and reads a whole buffer.
    pub fn read_buffer<T: bytemuck::Pod>(
        &mut self,
        buffer: &wgpu::Buffer,
        place: Place,
    ) -> Result<Vec<T>, FilterError> {
        let (sender, receiver) = std::sync::mpsc::channel();
        self.gpu.catch_errors(place, || {
            buffer.map_async(wgpu::MapMode::Read, .., move |result| {
                _ = sender.send(result);
            });
        })?;
        self.wait(place, DEFAULT_TIME_LIMIT)?;
        match receiver.try_recv() {
            Ok(Ok(())) => {}
            Ok(Err(error)) => return Err(place.refuse(error)),
            Err(_) => return Err(place.refuse("the GPU stopped answering")),
        }
        let bytes = buffer
            .get_mapped_range(..)
            .map_err(|error| place.refuse(error))?;
        Ok(bytemuck::pod_collect_to_vec(&bytes[..]))
    }

    /// Waits until the GPU has done everything that it was given. Gives up after `time_limit`
    /// seconds, and when the user interrupts.
    pub fn wait(&mut self, place: Place, time_limit: f64) -> Result<(), FilterError> {
        let start = Instant::now();
        loop {
            let left = Duration::from_secs_f64(time_limit).saturating_sub(start.elapsed());
            let slice = wgpu::PollType::Wait {
                submission_index: None,
                timeout: Some(SLICE.min(left)),
            };
            match self.gpu.device().poll(slice) {
                Ok(_) => return self.gpu.check_loss(place),
                Err(wgpu::PollError::Timeout) => {}
                Err(error) => {
                    self.gpu.check_loss(place)?;
                    return Err(place.refuse(error));
                }
            }
            let error = match (self.gpu.interrupted)() {
                true => FilterError::Interrupted,
                false if !left.is_zero() => continue,
                false => FilterError::TooSlow {
                    filter: place.filter.to_owned(),
                    pass: place.pass.to_owned(),
                    time_limit,
                },
            };
            self.give_up(place);
            return Err(error);
        }
    }

    /// Keeps the device open until the process ends: closing it would wait for the work that was
    /// given up.
    pub fn give_up(&mut self, place: Place) {
        std::mem::forget((self.gpu.device(), self.gpu.queue()));
        *self.given_up = Some(format!("pass {} of {}", place.pass, place.filter));
    }
}
