//! Arguments that commands share.

mod candidate;

pub use terminal::arguments::*;

pub use self::candidate::*;
