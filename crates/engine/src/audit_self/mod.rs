//! Audit of consecutive frames without a scene: whether velocity carries each frame to the next.
//!
//! Each pixel of a frame is compared with the place of the frame before that its velocity leads
//! back to. A block of pixels has an error of velocity: the shift that makes both pictures of it
//! alike.

mod block;
mod block_match;
mod brightness;
mod estimate;
mod finding;
mod fit;
mod frame_pair;
mod map;
mod pair_audit;
mod sequence;
mod sequence_audit;
mod simple_cause;
mod table;
mod verdict;

pub use estimate::Estimate;
pub use finding::SelfFinding;
pub use map::write_map;
pub use pair_audit::{PairAudit, RegionAudit};
pub use sequence::Sequence;
pub use sequence_audit::{SequenceAudit, audit_frames};
pub use simple_cause::SimpleCause;
pub use table::sequence_table;
pub use verdict::{Reason, Verdict};
