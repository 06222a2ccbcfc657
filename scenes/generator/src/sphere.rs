//! Spheres.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::files::{Files, model_files};
use crate::mesh::Mesh;

/// Unit sphere about the origin, with its poles on the Y axis.
pub(crate) fn sphere(material: &'static str, [around, up]: [usize; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.add_surface(
        [around, up],
        |_, _| material,
        |u, v| {
            let (longitude, latitude) = (u * TAU, (v - 0.5) * PI);
            DVec3::new(
                latitude.cos() * longitude.sin(),
                latitude.sin(),
                latitude.cos() * longitude.cos(),
            )
        },
    );
    mesh
}

pub(crate) fn files() -> Files {
    model_files(
        "sphere",
        &sphere("surface", [64, 32]),
        "newmtl surface\nKd 0.9 0.9 0.9\n",
    )
}
