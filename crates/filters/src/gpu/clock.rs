//! Clocks for work on the GPU.

use serde::{Deserialize, Serialize};

/// Clock that durations are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// The GPU's own clock, read between two pieces of work.
    Timestamps,
    /// The computer's clock, read before each piece is submitted and once the GPU is idle. It includes the way there and back,
    /// so short work seems longer.
    WallClock,
}
