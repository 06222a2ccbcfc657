//! Scores: reasons for not applying, pooling, names and refusals.

mod names;
mod pooling;
mod silence;

use tests::synthetic::{Object, Scene, Shape};

use crate::{bar, scene};

/// Makes a disc of 8 px that slides 12 px to the right, and a still bar, in front of it or not.
fn small_scene(bar_at: [f64; 2]) -> Scene {
    let bar = Object::sliding(bar([2.0, 20.0], 0.0), bar_at, [0.0, 0.0]);
    let disc = Object::sliding(Shape::Disc(8.0), [46.2, 30.3], [12.0, 0.0]);
    scene([80, 60], vec![bar, disc])
}

/// Position of a bar next to the disc's path.
const BESIDE: [f64; 2] = [10.0, 30.0];

/// Position of a bar in the disc's path.
const BEFORE: [f64; 2] = [40.0, 30.0];
