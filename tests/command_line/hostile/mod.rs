//! Hostile input: one test for each rule of `docs/limits.md` and `docs/trust.md`.

mod limits;
#[cfg(unix)]
mod trust;
