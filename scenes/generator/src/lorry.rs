//! A lorry that heads for +X, on the ground y = 0, its middle at z = 0.

use glam::{DAffine3, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::revolve;

const MATERIALS: &str = "\
newmtl box
Kd 0.82 0.84 0.86
newmtl stripe
Kd 0.9 0.45 0.05
newmtl rib
Kd 0.6 0.63 0.66
newmtl cab
Kd 0.08 0.25 0.5
newmtl glass
Kd 0.05 0.07 0.09
newmtl trim
Kd 0.05 0.05 0.05
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    let mut add = |material, [x, y, z]: [f64; 3], [length, height, width]: [f64; 3]| {
        let size = DVec3::new(length, height, width);
        add_cuboid(&mut mesh, material, DVec3::new(x, y, z), size, 1);
    };
    add("box", [-1.0, 2.2, 0.0], [5.8, 2.5, 2.45]);
    for rib in 0..8 {
        add(
            "rib",
            [-3.5 + 0.72 * f64::from(rib), 3.46, 0.0],
            [0.1, 0.04, 2.3],
        );
    }
    for side in [-1.0, 1.0] {
        add("stripe", [-1.0, 3.46, 0.95 * side], [5.7, 0.03, 0.3]);
        add("stripe", [-1.0, 2.1, 1.24 * side], [5.7, 0.4, 0.03]);
        add("trim", [3.3, 2.1, 1.35 * side], [0.12, 0.4, 0.25]);
    }
    add("trim", [0.0, 0.75, 0.0], [7.6, 0.3, 1.8]);
    add("cab", [2.95, 1.5, 0.0], [1.7, 1.9, 2.35]);
    add("cab", [2.75, 2.6, 0.0], [1.3, 0.35, 2.2]);
    add("glass", [3.68, 2.0, 0.0], [0.3, 0.75, 2.15]);
    add("glass", [3.1, 2.0, 0.0], [0.7, 0.6, 2.38]);
    add("trim", [3.85, 0.7, 0.0], [0.2, 0.35, 2.3]);
    for axle in [-2.9, -1.7, 2.7] {
        for side in [-1.0, 1.0] {
            let outline = [(0.0, -0.15), (0.48, -0.15), (0.48, 0.15), (0.0, 0.15)];
            let mut tyre = Mesh::default();
            revolve(&mut tyre, |_| "trim", 24, &outline);
            let place = DVec3::new(axle, 0.48, 1.05 * side);
            mesh.append(&tyre, DAffine3::from_translation(place));
        }
    }
    model_files("lorry", &mesh, MATERIALS)
}
