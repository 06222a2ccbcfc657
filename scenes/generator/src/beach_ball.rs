//! A beach ball of unit radius about the origin, its poles on the Y axis.

use glam::DVec3;

use crate::ellipsoid::{add_ellipsoid, add_striped_ellipsoid};
use crate::files::{Files, model_files};
use crate::mesh::Mesh;

const STRIPES: [&str; 6] = ["red", "white", "blue", "white", "yellow", "white"];

const MATERIALS: &str = "\
newmtl red
Kd 0.85 0.08 0.06
newmtl white
Kd 0.9 0.9 0.88
newmtl blue
Kd 0.05 0.25 0.75
newmtl yellow
Kd 0.95 0.75 0.05
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    let stripe = |column: usize| STRIPES[column / 6];
    add_striped_ellipsoid(&mut mesh, stripe, DVec3::ZERO, DVec3::ONE, [36, 18]);
    for y in [-0.97, 0.97] {
        let radii = DVec3::new(0.2, 0.04, 0.2);
        add_ellipsoid(&mut mesh, "white", DVec3::new(0.0, y, 0.0), radii, [18, 6]);
    }
    model_files("beach_ball", &mesh, MATERIALS)
}
