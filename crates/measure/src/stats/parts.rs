//! Parts of the replicates of a frame and of its truth, from which scores' intervals are estimated.

use std::ops::Range;

use frame::{MOST_GROUPS, Picture, Replicate, Truth, TruthError};

/// Smallest number of replicates for an interval: two groups.
pub const MIN_REPLICATES: u32 = 4;

/// The replicates of a truth and of its frame, in at most four groups as equal as possible. A
/// replicate of one half stays with one of the other, so that the halves of any part are equally
/// large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Groups {
    count: usize,
}

impl Groups {
    /// Divides this many replicates.
    pub fn of(replicates: u32) -> Self {
        Self {
            count: (replicates / 2).min(MOST_GROUPS) as usize,
        }
    }

    /// Lists the groups that are left out in turn; none if there is only one.
    pub fn list(self) -> Range<usize> {
        match self.count {
            ..=1 => 0..0,
            count => 0..count,
        }
    }

    /// Makes the truth of all replicates but one group's. Replicates share one support, so that
    /// scores keep pooling over the same pixels.
    pub fn truth_without(
        self,
        group: usize,
        replicates: &[Replicate],
    ) -> Result<Truth, TruthError> {
        let rest: Vec<Replicate> = (self.leave_out(group, replicates).zip(0..))
            .map(|(replicate, index)| Replicate {
                index,
                ..replicate.clone()
            })
            .collect();
        Truth::of(&rest)
    }

    /// Averages the replicates of a frame but one group's.
    pub fn picture_without(self, group: usize, replicates: &[Picture]) -> Picture {
        Picture::mean(self.leave_out(group, replicates))
    }

    fn leave_out<T>(self, group: usize, replicates: &[T]) -> impl Iterator<Item = &T> {
        let replicates = replicates.iter().enumerate();
        replicates
            .filter(move |(at, _)| at / 2 % self.count != group)
            .map(|(_, replicate)| replicate)
    }
}
