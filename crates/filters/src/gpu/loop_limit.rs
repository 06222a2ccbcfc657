//! Limit of an adapter on loop iterations.

/// Loop iterations that an adapter grants one invocation, all its loops together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LoopLimit {
    /// Iterations after which every loop ends.
    pub iterations: u32,
    /// Invocations that run in step and share the limit, at most: where they branch apart, their iterations add up.
    pub lanes: u32,
}

impl LoopLimit {
    /// Returns the iterations of one invocation from which on the picture may be wrong: its neighbours in step may take as many.
    pub fn safe(self) -> u32 {
        self.iterations / self.lanes.max(1)
    }
}
