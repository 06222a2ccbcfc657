//! Scores: their reasons to stay silent, pooling, names and refusals.

mod names;
mod pooling;
mod refusals;
mod silence;

use tests::synthetic::{Object, Scene, Shape};

/// Makes a disc of 8 px that slides 12 px to the right, and a bar that stands still, in front of it or not.
fn small_scene(bar_at: [f64; 2]) -> Scene {
    let bar = Shape::Bar {
        half: [2.0, 20.0],
        tilt: 0.0,
    };
    Scene {
        width: 80,
        height: 60,
        objects: vec![
            Object::sliding(bar, bar_at, [0.0, 0.0]),
            Object::sliding(Shape::Disc(8.0), [46.2, 30.3], [12.0, 0.0]),
        ],
    }
}

/// Place of a bar beside the disc's way.
const BESIDE: [f64; 2] = [10.0, 30.0];

/// Place of a bar in the disc's way.
const BEFORE: [f64; 2] = [40.0, 30.0];
