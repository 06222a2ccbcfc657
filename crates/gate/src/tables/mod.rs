//! A check in words: the terminal's text, annotations of GitHub, and JUnit XML.

mod annotations;
mod check;
mod junit;

pub use terminal::table::*;

pub use self::annotations::*;
pub use self::check::*;
pub use self::junit::*;
