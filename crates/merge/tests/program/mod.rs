//! `truths merge` as its user sees it.

mod runs;
mod same_bytes;
mod truths;
