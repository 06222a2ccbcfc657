//! Boxes.

use glam::{DMat3, DVec3};

use crate::mesh::Mesh;

/// Adds a box around `centre`; each face has `parts` x `parts` quads and shows the whole texture.
pub(crate) fn add_cuboid(
    mesh: &mut Mesh,
    material: &'static str,
    centre: DVec3,
    size: DVec3,
    parts: usize,
) {
    let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
    // Right, up, outward of each face.
    for [right, up, out] in [
        [x, y, z],
        [-x, y, -z],
        [-z, y, x],
        [z, y, -x],
        [x, -z, y],
        [x, z, -y],
    ] {
        let axes = DMat3::from_cols(right, up, out);
        mesh.add_surface(
            [parts, parts],
            |_, _| material,
            |u, v| centre + axes * DVec3::new(u - 0.5, v - 0.5, 0.5) * size,
        );
    }
}
