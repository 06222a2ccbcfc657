//! Page that asks people which of two clips looks better, or more like the truth.

mod folder;
mod page;

pub use folder::{ASK_PAGE, write_ask_folder};
