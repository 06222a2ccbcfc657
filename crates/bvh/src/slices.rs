//! Equal slices of an interval of time.

const MAX_SLICES: usize = 16;

/// An interval of time, cut into equally long slices.
#[derive(Clone, Copy)]
pub struct Slices {
    from: f64,
    to: f64,
    count: usize,
}

impl Slices {
    /// Cuts `[from, to]` into at least `needed` slices, rounded up to a power of two, and into 16
    /// at most.
    pub fn new([from, to]: [f64; 2], needed: f64) -> Self {
        let count = needed.clamp(1.0, MAX_SLICES as f64).ceil() as usize;
        Self {
            from,
            to,
            count: count.next_power_of_two(),
        }
    }

    /// The ends of each slice.
    pub fn spans(self) -> impl Iterator<Item = [f64; 2]> {
        let border = move |slice: usize| {
            self.from + (self.to - self.from) * slice as f64 / self.count as f64
        };
        (0..self.count).map(move |slice| [slice, slice + 1].map(border))
    }

    /// The slice that contains a time.
    #[inline(always)]
    pub fn find(self, time: f64) -> usize {
        if self.count == 1 {
            return 0;
        }
        let fraction = (time - self.from) / (self.to - self.from);
        ((fraction * self.count as f64) as usize).min(self.count - 1)
    }

    /// Returns true if a time is in the interval.
    #[inline(always)]
    pub fn contains(self, time: f64) -> bool {
        self.from <= time && time <= self.to
    }
}
