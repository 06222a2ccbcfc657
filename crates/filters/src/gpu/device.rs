//! An opened GPU.

use serde::{Deserialize, Serialize};

use crate::Format;

/// Description of an adapter, as a run records it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AdapterDescription {
    /// The device's name.
    pub name: String,
    /// The driver and its version.
    pub driver: String,
    /// Graphics interface: `vulkan`, `metal`, `dx12`.
    pub backend: String,
    /// Kind of device: `discrete`, `integrated`, `virtual`, `software` or `other`.
    pub kind: String,
}

/// Clock that durations are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// The GPU's own clock, read between two pieces of work.
    Timestamps,
    /// The computer's clock, read before each piece is submitted and once the GPU is idle. It includes submission and waiting,
    /// so short work seems longer.
    WallClock,
}

/// Loop iterations that an adapter grants one invocation, all its loops together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoopLimit {
    /// Iterations after which every loop ends.
    pub iterations: u32,
    /// Most invocations that run in lockstep and share the limit: if they branch apart, their iterations add up.
    pub lanes: u32,
}

impl LoopLimit {
    /// Returns the iterations of one invocation above which the picture may be wrong: its lockstep neighbours may take as many.
    pub fn safe(self) -> u32 {
        self.iterations / self.lanes.max(1)
    }
}

/// An opened GPU.
#[derive(Debug)]
pub struct Gpu {
    /// Description of the adapter.
    pub adapter: AdapterDescription,
    /// Clock for durations: timestamps if the adapter has them.
    pub clock: Clock,
    /// Loop iterations that it grants an invocation; `None` if it ends no loop early.
    pub loop_limit: Option<LoopLimit>,
    /// Formats in which its shaders can store textures.
    pub(super) stored_formats: Vec<Format>,
    /// Function polled while the GPU works; work stops when it returns true. The default never does.
    pub interrupted: fn() -> bool,
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
}

impl Gpu {
    /// Creates a buffer.
    pub(super) fn create_buffer(
        &self,
        label: &str,
        size: u64,
        usage: wgpu::BufferUsages,
    ) -> wgpu::Buffer {
        self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage,
            mapped_at_creation: false,
        })
    }
}
