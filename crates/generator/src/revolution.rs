//! Surfaces of revolution.

use std::f64::consts::TAU;

use glam::DVec3;

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

/// A ring about the Z axis at `height`: the tube has radius `tube`, its middle runs at `radius`.
pub(crate) fn ring(mesh: &mut Mesh, material: &'static str, radius: f64, tube: f64, height: f64) {
    mesh.surface(
        [96, 10],
        |_, _| material,
        |u, v| {
            let (sine, cosine) = (u * TAU).sin_cos();
            let (rise, out) = (v * TAU).sin_cos();
            let from_axis = radius + tube * out;
            DVec3::new(from_axis * cosine, from_axis * sine, height + tube * rise)
        },
    );
}
