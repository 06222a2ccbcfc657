//! Round tubes along a path.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::mesh::Mesh;

/// Adds a tube of `sides` quads around with a ring per point of the path; `radius`, in metres, runs
/// from 0 to 1 along it. Its ends are open: let the radius go to 0 there, or hide them.
pub(crate) fn add_tube(
    mesh: &mut Mesh,
    material: &'static str,
    sides: usize,
    path: &[DVec3],
    radius: impl Fn(f64) -> f64,
) {
    let pieces = path.len() - 1;
    let sides_of_path = find_sides(path);
    mesh.add_surface(
        [sides, pieces],
        |_, _| material,
        |u, v| {
            let piece = ((v * pieces as f64).floor().max(0.0) as usize).min(pieces - 1);
            let part = v * pieces as f64 - piece as f64;
            let tangent = (path[piece + 1] - path[piece]).normalize();
            let right = sides_of_path[piece].lerp(sides_of_path[piece + 1], part);
            let up = tangent.cross(right).normalize();
            let (sine, cosine) = (u * TAU).sin_cos();
            let out = cosine * right + sine * up;
            path[piece].lerp(path[piece + 1], part) + radius(v.clamp(0.0, 1.0)) * out
        },
    );
}

/// Adds a straight tube of one thickness.
pub(crate) fn add_rod(mesh: &mut Mesh, material: &'static str, ends: [DVec3; 2], radius: f64) {
    add_tube(mesh, material, 8, &ends, |_| radius);
}

/// Samples `pieces` + 1 points of a curve over 0 to 1.
pub(crate) fn sample_curve(pieces: usize, at: impl Fn(f64) -> DVec3) -> Vec<DVec3> {
    (0..=pieces)
        .map(|point| at(point as f64 / pieces as f64))
        .collect()
}

/// Finds a unit vector across the path at each point, carried along without twist.
fn find_sides(path: &[DVec3]) -> Vec<DVec3> {
    let tangent = |point: usize| {
        let [before, after] = [point.saturating_sub(1), (point + 1).min(path.len() - 1)];
        (path[after] - path[before]).normalize()
    };
    let mut right = tangent(0).any_orthonormal_vector();
    (0..path.len())
        .map(|point| {
            right = right.reject_from_normalized(tangent(point)).normalize();
            right
        })
        .collect()
}
