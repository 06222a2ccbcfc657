//! Prisms, flat faces and star outlines.

use glam::{DVec2, DVec3};

use crate::mesh::{Mesh, Vertex};

/// Adds a prism from z = `back` to z = `front` within an outline, counter-clockwise seen from the
/// front. Straight lines from the middle of the corners to the edge must not leave the outline.
pub(crate) fn add_prism(
    mesh: &mut Mesh,
    material: &'static str,
    outline: &[DVec2],
    [back, front]: [f64; 2],
) {
    let middle = outline.iter().sum::<DVec2>() / outline.len() as f64;
    for (index, from) in outline.iter().enumerate() {
        let to = outline[(index + 1) % outline.len()];
        add_face(
            mesh,
            material,
            &[middle, *from, to].map(|p| p.extend(front)),
        );
        add_face(mesh, material, &[middle, to, *from].map(|p| p.extend(back)));
        let side = [(*from, back), (to, back), (to, front), (*from, front)];
        add_face(mesh, material, &side.map(|(p, z)| p.extend(z)));
    }
}

/// Adds a flat face, counter-clockwise seen from outside; its corners get those of the texture.
pub(crate) fn add_face(mesh: &mut Mesh, material: &'static str, corners: &[DVec3]) {
    let normal = (corners[1] - corners[0])
        .cross(corners[2] - corners[0])
        .normalize();
    let texcoords = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let vertices: Vec<Vertex> = (corners.iter().zip(texcoords))
        .map(|(position, texcoord)| Vertex {
            position: *position,
            normal,
            texcoord: texcoord.into(),
        })
        .collect();
    mesh.add_polygon(material, &vertices);
}

/// Corners of a star with `points` points.
pub(crate) fn star_outline(points: usize, inner: f64, outer: f64) -> Vec<DVec2> {
    let step = std::f64::consts::PI / points as f64;
    (0..2 * points)
        .map(|corner| {
            let radius = if corner.is_multiple_of(2) {
                outer
            } else {
                inner
            };
            radius * DVec2::from_angle(std::f64::consts::FRAC_PI_2 + step * corner as f64)
        })
        .collect()
}
