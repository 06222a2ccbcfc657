//! Buffer in which kernels report their loop iterations.

use super::device::{Gpu, LoopLimit};
use super::place::Place;
use crate::FilterError;

/// The largest count of any invocation, per dispatch; 0 if every count is safe.
#[derive(Debug)]
pub(super) struct LoopCounts {
    limit: LoopLimit,
    counts: wgpu::Buffer,
    readable: wgpu::Buffer,
    stride: u64,
}

impl LoopCounts {
    pub fn new(gpu: &Gpu, limit: LoopLimit, dispatches: u32) -> Self {
        let alignment = gpu.device().limits().min_storage_buffer_offset_alignment;
        let stride = u64::from(alignment.max(4));
        let size = stride * u64::from(dispatches);
        let buffer = |usage| gpu.create_buffer("loop iterations", size, usage);
        Self {
            limit,
            counts: buffer(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC),
            readable: buffer(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST),
            stride,
        }
    }

    /// Binds the count of one dispatch.
    pub fn bind_dispatch(&self, dispatch: usize) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.counts,
            offset: dispatch as u64 * self.stride,
            size: wgpu::BufferSize::new(4),
        })
    }

    /// Refuses counts that the adapter may have cut short. `place` returns the place of a dispatch.
    pub fn check<'p>(
        &self,
        gpu: &Gpu,
        place: impl Fn(usize) -> Place<'p>,
    ) -> Result<(), FilterError> {
        let mut turn = gpu.take_turn(place(0))?;
        gpu.catch_errors(place(0), || {
            let mut encoder = gpu.device().create_command_encoder(&Default::default());
            let size = self.counts.size();
            encoder.copy_buffer_to_buffer(&self.counts, 0, &self.readable, 0, size);
            turn.submit(encoder.finish());
        })?;
        let words: Vec<u32> = turn.read_buffer(&self.readable, place(0))?;
        self.readable.unmap();
        let counts = words.chunks(self.stride as usize / 4).map(|row| row[0]);
        let most = counts.enumerate().max_by_key(|(_, count)| *count);
        match most {
            Some((dispatch, count)) if count > 0 => Err(self.refuse(gpu, place(dispatch), count)),
            _ => Ok(()),
        }
    }

    fn refuse(&self, gpu: &Gpu, place: Place, count: u32) -> FilterError {
        let LoopLimit { iterations, lanes } = self.limit;
        let adapter = &gpu.adapter.name;
        let reason = if count >= iterations {
            "its loops were ended early, so the picture is wrong".to_owned()
        } else {
            format!(
                "one invocation takes {count} loop iterations, and {lanes} that run in step share the limit, so the \
                 picture may be wrong"
            )
        };
        place.refuse(format!(
            "{reason}: adapter \"{adapter}\" ends all loops of an invocation after {iterations} iterations in total; \
             allowed here: fewer than {} iterations; divide the work among more invocations or passes, or choose \
             another adapter",
            self.limit.safe()
        ))
    }
}
