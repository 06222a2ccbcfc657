//! Tables of a run, in 80 columns.

mod abreast;
mod cases;
mod comparison;
mod missing;
mod ranking;
mod ranks;
mod scene_means;
mod sequence;
mod smears;

pub use terminal::table::*;

pub use self::abreast::*;
pub use self::cases::*;
pub use self::comparison::*;
pub use self::missing::*;
pub use self::ranking::*;
use self::ranks::Ranks;
pub use self::scene_means::*;
pub use self::sequence::*;
pub use self::smears::*;
