//! A roadside railing along the X axis, with a post every metre and two rails.

use glam::DVec3;

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;

/// Height in metres.
const HEIGHT: f64 = 1.0;

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    for index in -7..7 {
        let centre = DVec3::new(f64::from(index) + 0.5, HEIGHT / 2.0, 0.0);
        add_cuboid(
            &mut mesh,
            "steel",
            centre,
            DVec3::new(0.05, HEIGHT, 0.05),
            1,
        );
    }
    for y in [0.55, HEIGHT - 0.03] {
        let size = DVec3::new(14.0, 0.05, 0.03);
        add_cuboid(&mut mesh, "steel", DVec3::new(0.0, y, 0.04), size, 2);
    }
    model_files("railing", &mesh, "newmtl steel\nKd 0.6 0.62 0.64\n")
}
