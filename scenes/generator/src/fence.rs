//! An iron fence along the X axis: upright bars with points, between two rails.

use glam::DVec3;

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::revolve_upright;

/// Distance from bar to bar, in metres.
const SPACING: f64 = 0.17;

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    for index in -14..=14 {
        let x = SPACING * f64::from(index);
        let size = DVec3::new(0.036, 1.75, 0.036);
        add_cuboid(&mut mesh, "iron", DVec3::new(x, 0.875, 0.0), size, 1);
        let point = [(0.0, 0.0), (0.045, 0.05), (0.0, 0.17)];
        revolve_upright(&mut mesh, "iron", 8, &point, DVec3::new(x, 1.73, 0.0));
    }
    for y in [0.25, 1.5] {
        let size = DVec3::new(29.0 * SPACING, 0.05, 0.02);
        add_cuboid(&mut mesh, "iron", DVec3::new(0.0, y, 0.025), size, 2);
    }
    model_files("fence", &mesh, "newmtl iron\nKd 0.05 0.09 0.08\n")
}
