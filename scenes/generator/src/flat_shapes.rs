//! Bodies of uniform emission before a wall of the same emission.

use glam::{DVec2, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::prism::{add_prism, star_outline};
use crate::revolution::add_ring;
use crate::sphere::sphere;

const MATERIALS: &str = "newmtl even\nKd 0 0 0\nKe 0.5 0.5 0.5\n";

pub(crate) fn files() -> Files {
    let mut torus = Mesh::default();
    add_ring(&mut torus, "even", [0.6, 0.2], 0.0, [40, 14]);
    let mut cube = Mesh::default();
    add_cuboid(&mut cube, "even", DVec3::ZERO, DVec3::splat(0.8), 1);
    let mut pointed = Mesh::default();
    add_prism(
        &mut pointed,
        "even",
        &star_outline(7, 0.3, 0.8),
        [-0.1, 0.1],
    );
    let mut wall = Mesh::default();
    let corners = [(-6.0, -4.0), (6.0, -4.0), (6.0, 0.3), (-6.0, 0.3)].map(DVec2::from);
    add_prism(&mut wall, "even", &corners, [-0.1, 0.0]);
    [
        model_files("ball", &sphere("even", [32, 16]), MATERIALS),
        model_files("torus", &torus, MATERIALS),
        model_files("cube", &cube, MATERIALS),
        model_files("star", &pointed, MATERIALS),
        model_files("wall", &wall, MATERIALS),
    ]
    .concat()
}
