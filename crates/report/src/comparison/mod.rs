//! Comparison of two runs as a page.

mod page;
mod pictures;
mod runs;

pub use page::compare_page;
