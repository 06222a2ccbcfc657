//! Clocks for work on the GPU.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use super::adapter::Gpu;
use super::transfer::Place;
use crate::FilterError;
use crate::filter::DEFAULT_TIME_LIMIT;

/// How durations are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// The GPU's own clock, read between two pieces of work.
    Timestamps,
    /// The computer's clock around each piece, from handing it over until the GPU is idle. It counts the way there and
    /// back as well, which makes short work seem longer.
    WallClock,
}

impl Gpu {
    /// Seconds that each of `count` pieces of work takes, done one after the other.
    pub(super) fn time(
        &self,
        place: Place,
        count: usize,
        encode: impl Fn(usize, &mut wgpu::CommandEncoder),
    ) -> Result<Vec<f64>, FilterError> {
        match self.clock {
            Clock::Timestamps => self.time_by_timestamps(place, count, encode),
            Clock::WallClock => (0..count)
                .map(|index| self.time_by_wall_clock(place, |encoder| encode(index, encoder)))
                .collect(),
        }
    }

    fn time_by_timestamps(
        &self,
        place: Place,
        count: usize,
        encode: impl Fn(usize, &mut wgpu::CommandEncoder),
    ) -> Result<Vec<f64>, FilterError> {
        // One before each piece, and one after the last.
        let stamps = count as u32 + 1;
        let size = u64::from(stamps) * u64::from(wgpu::QUERY_SIZE);
        let buffer = |usage| {
            self.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("timestamps"),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let readable = self.guarded(place, || {
            let queries = self.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: stamps,
            });
            let resolved = buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
            let readable = buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
            let mut encoder = self.device.create_command_encoder(&Default::default());
            for index in 0..count {
                encoder.write_timestamp(&queries, index as u32);
                encode(index, &mut encoder);
            }
            encoder.write_timestamp(&queries, count as u32);
            encoder.resolve_query_set(&queries, 0..stamps, &resolved, 0);
            encoder.copy_buffer_to_buffer(&resolved, 0, &readable, 0, size);
            self.queue.submit([encoder.finish()]);
            readable
        })?;
        let ticks: Vec<u64> = self.read_buffer(&readable, place)?;
        let tick = f64::from(self.queue.get_timestamp_period()) * 1e-9;
        Ok(ticks
            .windows(2)
            .map(|pair| pair[1].saturating_sub(pair[0]) as f64 * tick)
            .collect())
    }

    fn time_by_wall_clock(
        &self,
        place: Place,
        encode: impl FnOnce(&mut wgpu::CommandEncoder),
    ) -> Result<f64, FilterError> {
        let commands = self.guarded(place, || {
            let mut encoder = self.device.create_command_encoder(&Default::default());
            encode(&mut encoder);
            encoder.finish()
        })?;
        self.wait(place, DEFAULT_TIME_LIMIT)?;
        let start = Instant::now();
        self.guarded(place, || self.queue.submit([commands]))?;
        self.wait(place, DEFAULT_TIME_LIMIT)?;
        Ok(start.elapsed().as_secs_f64())
    }
}
