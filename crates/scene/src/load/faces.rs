//! Removal of faces that no ray needs, with a note to the user.
//!
//! - A face whose corners lie on a line has no area; no ray hits it.
//! - If two faces have the same corners, attributes and material, every ray hits the first. The
//!   second would only count its light twice.
//!
//! Faces with the same corners that differ otherwise stay. A ray is tested against each of them, so
//! their number is limited.
//!
//! Faces without area get a note only if they are more than half: at the pole of a sphere, each
//! square becomes one triangle and one such face.

use std::collections::HashMap;
use std::path::Path;

use glam::Vec3;

use super::error::SceneError;
use crate::model::{Mesh, Object};

/// Most faces of a mesh with the same three corners.
const MAX_COINCIDENT: usize = 256;

/// Numbers of faces removed from a mesh.
#[derive(Default)]
struct Removed {
    without_area: usize,
    copies: usize,
}

/// Removes faces without area and copies of faces, and returns a note for each mesh with more of
/// them than usual. Refuses meshes with too many faces in one place.
pub(super) fn remove_redundant_faces(
    meshes: &mut [Mesh],
    objects: &[Object],
) -> Result<Vec<String>, SceneError> {
    let mut notes = Vec::new();
    for (index, mesh) in meshes.iter_mut().enumerate() {
        let object = objects.iter().find(|object| object.mesh == index);
        let name = object.map_or("", |object| object.name.as_str());
        let faces = mesh.triangles.len();
        let removed = remove_from_mesh(mesh, name)?;
        let kinds = [
            (removed.without_area, faces / 2, "have no area"),
            (removed.copies, 0, "are copies of others"),
        ];
        for (count, usual, what) in kinds {
            if count <= usual {
                continue;
            }
            let path = mesh.path.display();
            notes.push(format!(
                "{path}: {count} of {faces} triangles of object {name} {what}; they are left out"
            ));
        }
    }
    Ok(notes)
}

fn remove_from_mesh(mesh: &mut Mesh, object: &str) -> Result<Removed, SceneError> {
    let mut removed = Removed::default();
    // Faces that stay, by corners.
    let mut places: HashMap<[[u32; 3]; 3], Vec<u32>> = HashMap::with_capacity(mesh.triangles.len());
    let mut remaining = Vec::with_capacity(mesh.triangles.len());
    for face in 0..mesh.triangles.len() as u32 {
        let corners = mesh.triangles[face as usize].map(|vertex| place_key(mesh, vertex));
        if has_no_area(mesh, face, corners) {
            removed.without_area += 1;
            continue;
        }
        let mut sorted = corners;
        sorted.sort_unstable();
        let others = places.entry(sorted).or_default();
        if others.iter().any(|other| is_copy(mesh, face, *other)) {
            removed.copies += 1;
            continue;
        }
        others.push(face);
        if others.len() > MAX_COINCIDENT {
            return Err(too_many(&mesh.path, object, corners_of(mesh, face)));
        }
        remaining.push(face);
    }
    if remaining.is_empty() {
        return Err(SceneError::without_area(&mesh.path, mesh.triangles.len()));
    }
    if remaining.len() < mesh.triangles.len() {
        let faces = || remaining.iter().map(|face| *face as usize);
        mesh.triangles = faces().map(|face| mesh.triangles[face]).collect();
        mesh.slots = faces().map(|face| mesh.slots[face]).collect();
    }
    Ok(removed)
}

fn too_many(path: &Path, object: &str, [a, b, c]: [Vec3; 3]) -> SceneError {
    let reason = format!(
        "more than {MAX_COINCIDENT} triangles of object {object} have the corners {a}, {b} and {c}; allowed: {MAX_COINCIDENT}, since a \
         ray is tested against each; delete all but one"
    );
    SceneError::in_file(path, reason)
}

/// Key of a corner's place: its position, or its vertex if the mesh deforms.
fn place_key(mesh: &Mesh, vertex: u32) -> [u32; 3] {
    if mesh.deforms() {
        [vertex; 3]
    } else {
        // Adding 0 turns -0 into 0.
        (mesh.positions[vertex as usize] + Vec3::ZERO)
            .to_array()
            .map(f32::to_bits)
    }
}

fn corners_of(mesh: &Mesh, face: u32) -> [Vec3; 3] {
    mesh.triangles[face as usize].map(|vertex| mesh.positions[vertex as usize])
}

/// Returns whether the corners lie on a line at all times. Exact: removing a face that is merely
/// thin would leave a gap.
fn has_no_area(mesh: &Mesh, face: u32, [a, b, c]: [[u32; 3]; 3]) -> bool {
    if a == b || b == c || c == a {
        return true;
    }
    let [a, b, c] = corners_of(mesh, face);
    !mesh.deforms()
        && [(0, 1), (1, 2), (2, 0)].into_iter().all(|(across, up)| {
            let [a, b, c] = [a, b, c].map(|corner| robust::Coord {
                x: f64::from(corner[across]),
                y: f64::from(corner[up]),
            });
            robust::orient2d(a, b, c) == 0.0
        })
}

/// Returns whether two faces in one place have the same corners in the same order, and the same
/// normals, texture coordinates and material.
fn is_copy(mesh: &Mesh, face: u32, other: u32) -> bool {
    let [faces, others] = [face, other].map(|face| mesh.triangles[face as usize]);
    let same_corners = faces.iter().zip(&others).all(|(vertex, other)| {
        let [v, o] = [*vertex as usize, *other as usize];
        v == o
            || !mesh.deforms()
                && mesh.positions[v] == mesh.positions[o]
                && mesh.normals.get(v) == mesh.normals.get(o)
                && mesh.texcoords.get(v) == mesh.texcoords.get(o)
    });
    same_corners && mesh.slots[face as usize] == mesh.slots[other as usize]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn build_mesh(positions: &[[f32; 3]], triangles: Vec<[u32; 3]>) -> Mesh {
        Mesh {
            positions: positions.iter().copied().map(Vec3::from).collect(),
            slots: vec![0; triangles.len()],
            triangles,
            ..Mesh::default()
        }
    }

    const CORNERS: [[f32; 3]; 5] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-0.0, 0.0, 0.0],
        [3.0, 0.0, 0.0],
    ];

    #[test]
    fn faces_without_area_and_copies_go_and_all_others_stay_in_their_order() {
        let triangles = vec![
            [0, 1, 1], // a corner twice
            [0, 1, 2],
            [0, 1, 4], // on a line
            [3, 1, 2], // the second again, by other vertices
            [2, 1, 0], // the second from behind
            [1, 2, 0], // its corners in another order
        ];
        let mut mesh = build_mesh(&CORNERS, triangles);
        let removed = remove_from_mesh(&mut mesh, "thing").expect("few are in one place");
        assert_eq!((removed.without_area, removed.copies), (2, 1));
        assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 0], [1, 2, 0]]);
        assert_eq!(mesh.slots.len(), 3);
    }

    #[test]
    fn another_material_or_texture_coordinate_makes_another_face() {
        let mut textured = build_mesh(&CORNERS, vec![[0, 1, 2], [3, 1, 2]]);
        textured.texcoords = (0..5).map(|u| glam::Vec2::splat(u as f32)).collect();
        remove_from_mesh(&mut textured, "thing").expect("few are in one place");
        assert_eq!(textured.triangles.len(), 2);
        let mut painted = build_mesh(&CORNERS, vec![[0, 1, 2]; 2]);
        painted.slots[1] = 1;
        remove_from_mesh(&mut painted, "thing").expect("few are in one place");
        assert_eq!(painted.triangles.len(), 2);
    }

    #[test]
    fn a_thin_face_stays() {
        let thin = [[0.0, 0.0, 0.0], [1.0, 1e-45, 0.0], [2.0, 0.0, 0.0]];
        let mut thin = build_mesh(&thin, vec![[0, 1, 2]]);
        remove_from_mesh(&mut thin, "thing").expect("few are in one place");
        assert_eq!(thin.triangles.len(), 1);
    }

    #[test]
    fn too_many_different_faces_in_one_place_are_refused() {
        let mut crowd = build_mesh(&CORNERS, vec![[0, 1, 2]; MAX_COINCIDENT + 1]);
        crowd.slots = (0..crowd.slots.len() as u32).collect();
        let Err(error) = remove_from_mesh(&mut crowd, "thing") else {
            panic!("{} faces in one place", MAX_COINCIDENT + 1);
        };
        assert!(error.reason.contains("256"), "{error}");
    }
}
