//! Text that others wrote, shown as text.

pub mod markdown;
pub mod printable;
