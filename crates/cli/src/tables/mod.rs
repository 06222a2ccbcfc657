//! Tables of results, in 80 columns.

mod audit;
mod comparison;
mod listing;
mod tuning;

pub use terminal::table::*;

pub use self::audit::*;
pub use self::comparison::*;
pub use self::listing::*;
pub use self::tuning::*;
