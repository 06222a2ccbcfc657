//! Synthetic scenes for wrong blurs.

use std::f64::consts::FRAC_PI_2;

use tests::synthetic::{Object, Scene, Shape};

use crate::bar;

fn scene(objects: Vec<Object>) -> Scene {
    crate::scene([112, 84], objects)
}

/// Makes scenes by name: a translation, a rotation, two crossing paths, thin objects, and a mover between still objects.
pub fn scenes() -> Vec<(&'static str, Scene)> {
    let still = [0.0, 0.0];
    let mut turning = Object::sliding(bar([28.0, 5.0], 0.4), [56.3, 42.2], still);
    turning.turn = 1.2;
    let wires = [34.3, 50.3, 66.3]
        .map(|x| Object::sliding(bar([24.0, 1.2], FRAC_PI_2), [x + 9.0, 42.2], [18.0, 0.0]));
    let disc = Object::sliding(Shape::Disc(12.0), [68.3, 44.2], [28.0, 5.0]);
    let crossing = [
        Object::sliding(Shape::Disc(8.0), [76.3, 30.2], [30.0, 0.0]),
        Object::sliding(bar([9.0, 6.0], 0.3), [48.3, 62.2], [4.0, 24.0]),
    ];
    let overlap = [
        Object::sliding(bar([2.5, 34.0], 0.0), [46.0, 42.0], still),
        Object::sliding(Shape::Disc(12.0), [68.3, 42.2], [28.0, 0.0]),
        Object::sliding(bar([14.0, 14.0], 0.0), [84.0, 42.0], still),
    ];
    vec![
        ("disc", scene(vec![disc])),
        ("turning bar", scene(vec![turning])),
        ("crossing", scene(crossing.to_vec())),
        ("wires", scene(wires.to_vec())),
        ("overlap", scene(overlap.to_vec())),
    ]
}
