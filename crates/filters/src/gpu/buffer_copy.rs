//! Copy of a buffer, which measures the bandwidth of the adapter's memory.

use super::device::Gpu;
use super::place::Place;
use crate::FilterError;

/// Size of a buffer: larger than the caches of today's GPUs.
const BUFFER_BYTES: u64 = 128 << 20;

/// A buffer and another of the same size that it is copied to.
#[derive(Debug)]
pub struct BufferCopy<'g> {
    /// Bytes that one copy reads and writes.
    pub bytes: u64,
    gpu: &'g Gpu,
    from: wgpu::Buffer,
    to: wgpu::Buffer,
}

const PLACE: Place = Place {
    filter: "none",
    pass: "copy of a buffer",
};

impl<'g> BufferCopy<'g> {
    /// Makes buffers of 128 MiB, or of as much as the adapter allows.
    pub fn new(gpu: &'g Gpu) -> Result<Self, FilterError> {
        let size = BUFFER_BYTES.min(gpu.device().limits().max_buffer_size);
        let buffer = |usage| gpu.create_buffer("copy", size, usage);
        let (from, to) = gpu.catch_errors(PLACE, || {
            (
                buffer(wgpu::BufferUsages::COPY_SRC),
                buffer(wgpu::BufferUsages::COPY_DST),
            )
        })?;
        Ok(Self {
            bytes: 2 * size,
            gpu,
            from,
            to,
        })
    }

    /// Times one copy; returns seconds.
    pub fn time(&self) -> Result<f64, FilterError> {
        let seconds = self.gpu.time(PLACE, 1, |_, encoder| {
            encoder.copy_buffer_to_buffer(&self.from, 0, &self.to, 0, self.bytes / 2);
        })?;
        Ok(seconds[0])
    }
}
