//! Surfaces of revolution.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};

use crate::mesh::Mesh;

/// Turns the outline `(radius, height)` about the Z axis, `around` quads a turn, each of the material that its number
/// has. The outside lies to the right of the outline as it is walked, with +Z ahead and the radius to the right; each
/// piece is a surface of its own, so that its corners stay sharp.
pub(crate) fn revolve(
    mesh: &mut Mesh,
    material: impl Fn(usize) -> &'static str,
    around: usize,
    outline: &[(f64, f64)],
) {
    for piece in outline.windows(2) {
        let [from, to] = [piece[0], piece[1]];
        mesh.surface(
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

/// Turns the outline `(radius, height)` about the vertical through `foot`.
pub(crate) fn turned(
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

/// A ring about the Z axis at `height`, of `parts` quads around the axis and around the tube: the tube has radius `tube`,
/// its middle runs at `radius`.
pub(crate) fn ring(
    mesh: &mut Mesh,
    material: &'static str,
    [radius, tube]: [f64; 2],
    height: f64,
    parts: [usize; 2],
) {
    mesh.surface(
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
