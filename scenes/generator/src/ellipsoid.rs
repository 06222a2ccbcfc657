//! Ellipsoids aligned with the axes.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::mesh::Mesh;

/// Adds an ellipsoid of `parts` quads around and up, with its poles above and below.
pub(crate) fn add_ellipsoid(
    mesh: &mut Mesh,
    material: &'static str,
    centre: DVec3,
    radii: DVec3,
    parts: [usize; 2],
) {
    add_striped_ellipsoid(mesh, |_| material, centre, radii, parts);
}

/// Adds an ellipsoid with a material for each column of quads.
pub(crate) fn add_striped_ellipsoid(
    mesh: &mut Mesh,
    material: impl Fn(usize) -> &'static str,
    centre: DVec3,
    radii: DVec3,
    parts: [usize; 2],
) {
    mesh.add_surface(
        parts,
        |column, _| material(column),
        |u, v| {
            let (longitude, latitude) = (u * TAU, (v - 0.5) * PI);
            let around = DVec3::new(longitude.sin(), 0.0, longitude.cos());
            centre + radii * (latitude.cos() * around + latitude.sin() * DVec3::Y)
        },
    );
}
