//! Tables of results, in 80 columns.

mod comparison;
mod listing;

pub use terminal::table::*;

pub use self::comparison::*;
pub use self::listing::*;
