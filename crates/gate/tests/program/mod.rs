//! The gate as its user sees it: checks, proposed limits, and baselines.

mod baseline;
mod check;
