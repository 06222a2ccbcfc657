//! Tables of text, in 80 columns.

mod columns;
mod export;
mod layout;

pub use self::columns::*;
pub use self::export::*;
pub use self::layout::*;
