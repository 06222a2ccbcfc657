//! Comparison of two runs as a page.

mod cells;
mod page;
mod pictures;
mod runs;

pub use cells::ChangeCells;
pub use page::compare_page;
