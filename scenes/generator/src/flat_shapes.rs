//! Bodies that emit the same everywhere, before a wall that does so too.

use glam::{DVec2, DVec3};

use crate::cuboid::cuboid;
use crate::mesh::Mesh;
use crate::prism::{prism, star};
use crate::revolution::ring;
use crate::sphere::sphere;
use crate::{Files, model};

const MATERIALS: &str = "newmtl even\nKd 0 0 0\nKe 0.5 0.5 0.5\n";

pub(crate) fn files() -> Files {
    let mut torus = Mesh::default();
    ring(&mut torus, "even", [0.6, 0.2], 0.0, [40, 14]);
    let mut cube = Mesh::default();
    cuboid(&mut cube, "even", DVec3::ZERO, DVec3::splat(0.8), 1);
    let mut pointed = Mesh::default();
    prism(&mut pointed, "even", &star(7, 0.3, 0.8), [-0.1, 0.1]);
    let mut wall = Mesh::default();
    let corners = [(-6.0, -4.0), (6.0, -4.0), (6.0, 0.3), (-6.0, 0.3)].map(DVec2::from);
    prism(&mut wall, "even", &corners, [-0.1, 0.0]);
    [
        model("ball", &sphere("even", [32, 16]), MATERIALS),
        model("torus", &torus, MATERIALS),
        model("cube", &cube, MATERIALS),
        model("star", &pointed, MATERIALS),
        model("wall", &wall, MATERIALS),
    ]
    .concat()
}
