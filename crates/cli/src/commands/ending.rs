//! End of a command that did its work.

use suite::Error;

/// The end of a command that did its work.
pub enum Ending {
    /// Nothing more is to say.
    Done,
    /// A check failed or is undecided, and has printed that.
    Failed(Error),
}
