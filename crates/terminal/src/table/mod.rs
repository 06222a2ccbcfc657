//! Tables of text, in 80 columns.

mod columns;
mod layout;

pub use self::columns::*;
pub use self::layout::*;
