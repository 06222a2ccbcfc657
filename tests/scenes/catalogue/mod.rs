//! Proofs that each scene of the catalogue exposes its cause: a filter that fails is clearly worse there than in the
//! variant without the cause.
//!
//! Renders are small, so speeds in pixels are a quarter of those in the scenes' files.

mod camera;
mod deforming;
mod lens;
mod limits;
mod overlap;
mod rendered_scene;
mod rotation;
mod thin;
mod translucent;

/// Asserts that a score is at least a multiple of the score without the cause, and prints both.
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
