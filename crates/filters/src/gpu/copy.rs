//! Bandwidth of the adapter's memory, which the traffic of filters is compared with.

use super::adapter::Gpu;
use super::transfer::Place;
use crate::FilterError;

/// Larger than the caches of today's GPUs.
const BUFFER_BYTES: u64 = 128 << 20;

/// Copies from one buffer to another of the same size.
#[derive(Debug)]
pub struct BufferCopy<'g> {
    /// Read and written by one copy, in bytes.
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
    /// Buffers of 128 MiB, or of as much as the adapter allows.
    pub fn new(gpu: &'g Gpu) -> Result<Self, FilterError> {
        let size = BUFFER_BYTES.min(gpu.device.limits().max_buffer_size);
        let buffer = |usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("copy"),
                size,
                usage,
                mapped_at_creation: false,
            })
        };
        let (from, to) = gpu.guarded(PLACE, || {
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

    /// Seconds that one copy takes.
    pub fn time(&self) -> Result<f64, FilterError> {
        let seconds = self.gpu.time(PLACE, 1, |_, encoder| {
            encoder.copy_buffer_to_buffer(&self.from, 0, &self.to, 0, self.bytes / 2);
        })?;
        Ok(seconds[0])
    }
}
