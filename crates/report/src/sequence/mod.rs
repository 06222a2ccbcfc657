//! Page of the sequences of a run: pictures that play in step, and scores over time.

mod page;
mod ranking;
mod scores;

pub use page::{SEQUENCES_PAGE, sequences_page};
