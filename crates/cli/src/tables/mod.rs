//! Tables of results, in 80 columns.

mod abreast;
mod annotations;
mod cases;
mod check;
mod comparison;
mod junit;
mod listing;
mod missing;
mod ranking;
mod scene_means;
mod sequence;
mod tuning;

pub use terminal::table::*;

pub use self::abreast::*;
pub use self::annotations::*;
pub use self::cases::*;
pub use self::check::*;
pub use self::comparison::*;
pub use self::junit::*;
pub use self::listing::*;
pub use self::missing::*;
pub use self::ranking::*;
pub use self::scene_means::*;
pub use self::sequence::*;
pub use self::tuning::*;
