//! Ranking of causes: structures before numbers, and causes that look the same.

use crate::audit::cause::Cause;
use crate::audit::defect::Explanation;
use crate::audit::depth_audit::LEAST_EXPLAINED;

/// Part of the pixels on which two causes may differ and still look the same.
const LOOKS_SAME: f64 = 0.005;
/// Part of the pixels by which a fitted number must explain more than a structure to outrank it. A
/// number follows the vectors' own errors.
const MARGIN: f64 = 0.03;

/// Part of the pixels that a cause explains.
#[derive(Clone, Debug)]
pub struct Share {
    pub cause: Cause,
    pub part: f64,
}

/// What decides between causes.
#[derive(Clone, Copy, Debug)]
pub struct Ranking {
    /// True if an object that moves is right: then a factor is no unit's.
    pub some_move_right: bool,
}

impl Ranking {
    /// Chooses the cause with the fewest free numbers, among these the first that explains the
    /// most, and lists others that look the same. After a turn, the cause is not another turn.
    pub fn choose(self, mut shares: Vec<Share>, turned: Option<Cause>) -> Option<Explanation> {
        if turned.is_some() {
            shares
                .retain(|share| !share.cause.is_turn() && !matches!(share.cause, Cause::Offset(_)));
        }
        let most = |shares: &mut dyn Iterator<Item = &Share>| {
            shares.map(|share| share.part).fold(0.0, f64::max)
        };
        let needed = LEAST_EXPLAINED.max(most(&mut shares.iter()) - MARGIN);
        let mut enough: Vec<&Share> = shares.iter().filter(|share| share.part >= needed).collect();
        // Stable: the first of each rank stays first.
        enough.sort_by_key(|share| self.rank(&share.cause));
        let rank = self.rank(&enough.first()?.cause);
        let least = most(
            &mut enough
                .iter()
                .copied()
                .filter(|share| self.rank(&share.cause) == rank),
        );
        let least = least - LOOKS_SAME;
        let mut best = (enough.into_iter()).filter(|share| share.part >= least);
        let first = best.next()?;
        let mut families = vec![first.cause.family()];
        let others = best.filter(|share| {
            let family = share.cause.family();
            let is_new = family.is_none() || !families.contains(&family);
            families.push(family);
            is_new && self.is_listed(&share.cause, &first.cause)
        });
        Some(Explanation {
            turned,
            looks_like: others.map(|share| share.cause.clone()).collect(),
            ..Explanation::by(first.cause.clone(), first.part)
        })
    }

    /// Ranks a cause by its free numbers: none, then jitter, then more.
    fn rank(self, cause: &Cause) -> u8 {
        match cause {
            cause if cause.is_of_jitter() => 1,
            Cause::Teleport(_) if self.some_move_right => 2,
            Cause::Teleport(_) => 4,
            // A part of an engine's convention, unless it is right elsewhere.
            cause if cause.is_fitted() => 3,
            _ => 0,
        }
    }

    /// Returns whether a cause is listed as another that looks like the first. A fitted number
    /// explains what a word explains; that is no other cause.
    fn is_listed(self, cause: &Cause, first: &Cause) -> bool {
        let may_be_unit = !self.some_move_right && cause.is_unit_of_two();
        let is_teleport = matches!(first, Cause::Teleport(_));
        match cause {
            Cause::Teleport(_) => matches!(first, Cause::Offset(_)),
            cause if cause.is_fitted() => may_be_unit || is_teleport,
            _ => true,
        }
    }
}
