//! A meadow just below y = 0 that ends at ridges of hills, one behind the other and paler with
//! distance.

use glam::DVec3;

use crate::files::{Files, model_files};
use crate::mesh::Mesh;

/// Ridges and their distances from the viewer, who looks along -Z, in metres; nearest last.
const RIDGES: [(&str, f64); 4] = [
    ("farthest", 4000.0),
    ("far", 2400.0),
    ("near", 1400.0),
    ("meadow", 700.0),
];

const MATERIALS: &str = "\
newmtl farthest
Kd 0.45 0.55 0.68
newmtl far
Kd 0.33 0.44 0.5
newmtl near
Kd 0.22 0.34 0.26
newmtl meadow
Kd 0.3 0.42 0.16
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    for (index, (material, distance)) in RIDGES.into_iter().enumerate() {
        mesh.add_surface(
            [160, 1],
            |_, _| material,
            |u, v| {
                let x = 4.4 * distance * (u - 0.5);
                let crest = distance * crest(28.0 * u + 3.0 * index as f64, index);
                DVec3::new(x, crest * v - 0.05 * distance * (1.0 - v), -distance)
            },
        );
    }
    let [_, _, _, (material, distance)] = RIDGES;
    mesh.add_surface(
        [1, 1],
        |_, _| material,
        |u, v| {
            DVec3::new(
                2.2 * distance * (2.0 * u - 1.0),
                -0.3,
                20.0 - (distance + 20.0) * v,
            )
        },
    );
    model_files("ridge", &mesh, MATERIALS)
}

/// Height of a ridge, relative to its distance.
fn crest(along: f64, index: usize) -> f64 {
    let height = [0.16, 0.1, 0.055, 0.02][index];
    let rough = [0.25, 0.2, 0.25, 0.3][index];
    let fine =
        0.3 * (5.3 * along).sin() + 0.2 * (11.7 * along + 1.0).sin() + 0.12 * (29.0 * along).sin();
    height * (1.0 + 0.35 * (1.3 * along).sin() + rough * fine)
}
