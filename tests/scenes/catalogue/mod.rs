//! Every scene of the catalogue exposes what it says: a filter that falls for it is clearly worse there than where the cause
//! is taken away.
//!
//! Shots are small, so that speeds in pixels are a quarter of those in the scenes' files.

mod camera;
mod deforming;
mod limits;
mod overlap;
mod rotation;
mod shot;
mod thin;

/// Asserts that a score is so many times what it is where the cause is taken away, and shows both.
fn assert_worse(what: &str, [there, without]: [f64; 2], times: f64) {
    println!(
        "{what}: {there:.4}, without the cause {without:.4}: {:.2} times",
        there / without
    );
    assert!(
        there > times * without,
        "{what}: {there} is not {times} times {without}"
    );
}
