//! A street lamp on a post that stands on y = 0.

use glam::DVec3;

use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::revolve_upright;
use crate::tube::add_rod;

const MATERIALS: &str = "\
newmtl iron
Kd 0.07 0.11 0.1
newmtl globe
Kd 0.92 0.9 0.82
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    let post = [
        (0.14, 0.0),
        (0.14, 0.12),
        (0.08, 0.2),
        (0.06, 0.9),
        (0.08, 0.95),
        (0.05, 1.0),
        (0.035, 2.6),
        (0.09, 2.7),
        (0.0, 2.72),
    ];
    revolve_upright(&mut mesh, "iron", 16, &post, DVec3::ZERO);
    for side in [-1.0, 1.0] {
        add_rod(
            &mut mesh,
            "iron",
            [
                DVec3::new(0.0, 2.45, 0.0),
                DVec3::new(0.3 * side, 2.55, 0.0),
            ],
            0.018,
        );
    }
    for (x, y) in [(-0.32, 2.7), (0.0, 2.88), (0.32, 2.7)] {
        add_ellipsoid(
            &mut mesh,
            "globe",
            DVec3::new(x, y, 0.0),
            DVec3::splat(0.15),
            [20, 12],
        );
    }
    model_files("lamp_post", &mesh, MATERIALS)
}
