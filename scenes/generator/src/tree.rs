//! Leafy trees.

use glam::DVec3;

use crate::ellipsoid::add_ellipsoid;
use crate::mesh::Mesh;
use crate::noise::noise;
use crate::revolution::revolve_upright;

/// Materials of [`add_tree`], for the MTL file of its mesh.
pub(crate) const MATERIALS: &str = "\
newmtl bark
Kd 0.2 0.14 0.09
newmtl crown
Kd 0.16 0.3 0.08
newmtl crown_light
Kd 0.26 0.42 0.12
";

/// Adds a tree `height` metres high; trees of other `kind`s have other crowns.
pub(crate) fn add_tree(mesh: &mut Mesh, foot: DVec3, height: f64, kind: u32) {
    let trunk = [
        (0.05 * height, 0.0),
        (0.035 * height, 0.3 * height),
        (0.02 * height, 0.6 * height),
    ];
    revolve_upright(mesh, "bark", 6, &trunk, foot);
    for blob in 0..4 {
        let random = |seed: u32| noise(7 * kind + blob, seed) - 0.5;
        let centre = DVec3::new(0.34 * random(1), 0.66 + 0.3 * random(2), 0.34 * random(3));
        let radius = 0.17 + 0.1 * random(4);
        let material = if blob.is_multiple_of(2) {
            "crown"
        } else {
            "crown_light"
        };
        let radii = height * radius * DVec3::new(1.0, 0.85, 1.0);
        add_ellipsoid(mesh, material, foot + height * centre, radii, [6, 4]);
    }
}
