//! The page of a finished run, and the pages and layers beside it.

mod layers;
mod page;
mod tuning;
