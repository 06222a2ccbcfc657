//! Translucent surfaces against known answers.

mod buffers;
mod panes;
mod shadows;

use glam::{DVec3, Vec3};
use tests::shapes::{add, glowing, placed, rectangle};
use tracer::{Material, Scene, Translucency};

/// Makes an unlit film of an opacity, which lets `filter` of the rest pass.
pub fn film(radiance: Vec3, opacity: f32, filter: Vec3) -> Material {
    Material {
        emission: radiance,
        opacity,
        translucency: Some(Translucency {
            filter,
            ..Translucency::CLEAR
        }),
        ..glowing(0.0)
    }
}

/// Makes clean glass of this index, which absorbs `1 - filter` of the light inside it.
pub fn glass(index: f32, filter: Vec3) -> Material {
    Material {
        opacity: 0.0,
        translucency: Some(Translucency {
            filter,
            glass: Some(index),
            ..Translucency::CLEAR
        }),
        ..glowing(0.0)
    }
}

/// Hangs a still pane across the view, larger than the picture.
fn hang(scene: &mut Scene, material: Material, z: f64) -> usize {
    let at = placed(DVec3::new(0.0, 0.0, z));
    add(scene, rectangle(1000.0, 1000.0), material, at)
}

/// Fails unless all three components agree.
fn assert_near(found: [f32; 3], expected: Vec3, tolerance: f32, what: &str) {
    let error = (Vec3::from(found) - expected).abs().max_element();
    assert!(error <= tolerance, "{what}: {found:?}, not {expected}");
}
