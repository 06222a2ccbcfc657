//! Timing of work on the GPU.

use std::time::Instant;

use super::device::{Clock, Gpu};
use super::place::Place;
use crate::FilterError;
use crate::filter::DEFAULT_TIME_LIMIT;

impl Gpu {
    /// Does `count` pieces of work one after the other; returns the seconds that each took.
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
        let buffer = |usage| self.create_buffer("timestamps", size, usage);
        let mut turn = self.take_turn(place)?;
        let readable = self.catch_errors(place, || {
            let queries = self.device().create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: stamps,
            });
            let resolved = buffer(wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC);
            let readable = buffer(wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ);
            let mut encoder = self.device().create_command_encoder(&Default::default());
            for index in 0..count {
                encoder.write_timestamp(&queries, index as u32);
                encode(index, &mut encoder);
            }
            encoder.write_timestamp(&queries, count as u32);
            encoder.resolve_query_set(&queries, 0..stamps, &resolved, 0);
            encoder.copy_buffer_to_buffer(&resolved, 0, &readable, 0, size);
            turn.submit(encoder.finish());
            readable
        })?;
        let ticks: Vec<u64> = turn.read_buffer(&readable, place)?;
        let tick = f64::from(self.queue().get_timestamp_period()) * 1e-9;
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
        let commands = self.catch_errors(place, || {
            let mut encoder = self.device().create_command_encoder(&Default::default());
            encode(&mut encoder);
            encoder.finish()
        })?;
        let mut turn = self.take_turn(place)?;
        turn.wait(place, DEFAULT_TIME_LIMIT)?;
        let start = Instant::now();
        self.catch_errors(place, || turn.submit(commands))?;
        turn.wait(place, DEFAULT_TIME_LIMIT)?;
        Ok(start.elapsed().as_secs_f64())
    }
}
