//! Surfaces of revolution.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};

use crate::mesh::Mesh;

/// Revolves the outline `(radius, height)` about the Z axis in `around` quads, with a material for
/// each column. Seen with +Z up and the radius to the right, the outside lies to the right of the
/// outline's direction. Corners stay sharp: each piece is a surface of its own.
pub(crate) fn revolve(
    mesh: &mut Mesh,
    material: impl Fn(usize) -> &'static str,
    around: usize,
    outline: &[(f64, f64)],
) {
    for piece in outline.windows(2) {
        let [from, to] = [piece[0], piece[1]];
        mesh.add_surface(
            [around, 1],
            |column, _| material(column),
            |u, v| {
                let (sine, cosine) = (u * TAU).sin_cos();
                let radius = from.0 + v * (to.0 - from.0);
                let height = from.1 + v * (to.1 - from.1);
                DVec3::new(radius * cosine, radius * sine, height)
            },
        );
    }
}

/// Revolves the outline `(radius, height)` about the vertical through `foot`.
pub(crate) fn revolve_upright(
    mesh: &mut Mesh,
    material: &'static str,
    around: usize,
    outline: &[(f64, f64)],
    foot: DVec3,
) {
    let mut about_z = Mesh::default();
    revolve(&mut about_z, |_| material, around, outline);
    let upright = DAffine3::from_rotation_x(-TAU / 4.0);
    mesh.append(&about_z, DAffine3::from_translation(foot) * upright);
}

/// Adds a ring about the Z axis at `height`, of `parts` quads around the axis and around the tube.
/// The tube has the radius `tube`; its middle runs at `radius`.
pub(crate) fn add_ring(
    mesh: &mut Mesh,
    material: &'static str,
    [radius, tube]: [f64; 2],
    height: f64,
    parts: [usize; 2],
) {
    mesh.add_surface(
        parts,
        |_, _| material,
        |u, v| {
            let (sine, cosine) = (u * TAU).sin_cos();
            let (rise, out) = (v * TAU).sin_cos();
            let from_axis = radius + tube * out;
            DVec3::new(from_axis * cosine, from_axis * sine, height + tube * rise)
        },
    );
}
