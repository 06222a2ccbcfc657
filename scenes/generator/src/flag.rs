//! A flag in the wind, in shapes half a frame apart, and its pole, which is the Y axis.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::revolve_upright;

/// Length and height of the cloth, and the height of its upper edge, in metres.
const LENGTH: f64 = 2.4;
const HEIGHT: f64 = 1.5;
const TOP: f64 = 4.2;

/// Quads along and across the cloth.
const PARTS: [usize; 2] = [44, 18];

/// Speed of the wave, in wavelengths per frame.
const WAVES_PER_FRAME: f64 = 0.24;

const MATERIALS: &str = "\
newmtl green
Kd 0.1 0.45 0.2
newmtl white
Kd 0.9 0.9 0.86
newmtl orange
Kd 0.9 0.4 0.05
newmtl pole
Kd 0.7 0.68 0.62
newmtl knob
Kd 0.9 0.7 0.2
";

pub(crate) fn files() -> Files {
    let mut files = Files::new();
    for shape in 0..5 {
        // The shapes go from one frame before the instant to one after it.
        let time = 0.5 * f64::from(shape) - 1.0;
        let mut mesh = Mesh::default();
        mesh.add_surface(PARTS, stripe, |u, v| cloth(u, v, time));
        files.push((
            format!("flag_{shape}.obj"),
            mesh.to_obj("flag.mtl").into_bytes(),
        ));
    }
    files.push(("flag.mtl".into(), MATERIALS.into()));
    let mut pole = Mesh::default();
    let outline = [
        (0.06, 0.0),
        (0.05, 2.0),
        (0.04, TOP + 0.1),
        (0.0, TOP + 0.1),
    ];
    revolve_upright(&mut pole, "pole", 14, &outline, DVec3::ZERO);
    let knob = DVec3::new(0.0, TOP + 0.16, 0.0);
    add_ellipsoid(&mut pole, "knob", knob, DVec3::splat(0.09), [16, 10]);
    files.extend(model_files("pole", &pole, MATERIALS));
    files
}

/// Material of a quad: stripes, and an orange corner at the upper end of the pole.
fn stripe(column: usize, row: usize) -> &'static str {
    if column < 16 && row >= 8 {
        if (column + row) % 4 == 1 && column.is_multiple_of(2) {
            "white"
        } else {
            "orange"
        }
    } else if (row / 2).is_multiple_of(2) {
        "green"
    } else {
        "white"
    }
}

/// Position of a point of the cloth: a wave runs away from the pole and grows; the cloth keeps its
/// length and sags towards its free end.
fn cloth(u: f64, v: f64, time: f64) -> DVec3 {
    let phase = TAU * (1.5 * u - WAVES_PER_FRAME * time) + 0.9 * v;
    let growth = u * (1.4 - 0.4 * u);
    let swing = 0.3 * growth * phase.sin();
    let rise = 0.16 * growth * (0.8 * phase + 0.7).sin();
    let drawn_in = 0.06 * growth * (1.0 + (2.0 * phase).cos());
    DVec3::new(
        0.05 + LENGTH * (0.92 * u - drawn_in),
        TOP - HEIGHT * (1.0 - v) - 0.22 * u * u + rise,
        swing,
    )
}
