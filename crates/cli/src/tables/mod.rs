//! Tables of results, in 80 columns.

mod comparison;
mod listing;
mod tuning;

pub use terminal::table::*;

pub use self::comparison::*;
pub use self::listing::*;
pub use self::tuning::*;
