//! Several OBJ files of the same faces as one mesh that changes its shape.

use std::collections::HashMap;

use glam::Vec3;

use super::error::SceneError;
use super::obj::{ObjFile, Slot};
use super::statements::statements;
use crate::{Mesh, Shape};

/// A face of an OBJ file.
struct Face {
    /// Counted from 1.
    line: usize,
    /// Indices of its vertices, counted from 1.
    vertices: Vec<i64>,
}

/// The mesh that has these shapes at these times, and the materials of its slots: the first shape's, as are the texture
/// coordinates.
pub(super) fn deforming_mesh(
    shapes: &[(f64, &ObjFile)],
    group: Option<&str>,
) -> Result<(Mesh, Vec<Slot>), SceneError> {
    let files: Vec<&ObjFile> = shapes.iter().map(|(_, file)| *file).collect();
    for file in &files[1..] {
        check_faces(files[0], file)?;
        check_parts(files[0], file)?;
    }
    let joined = joined(&files);
    let (mut mesh, slots) = joined[0].mesh(group)?;
    let flat = flat_vertices(&joined[0], group, &mesh);
    for ((time, _), file) in shapes.iter().zip(&joined) {
        let shape = file.shape(group);
        let normals = shape.normals.iter().zip(&flat);
        mesh.shapes.push(Shape {
            time: *time,
            normals: normals
                .map(|(normal, flat)| if *flat { Vec3::ZERO } else { *normal })
                .collect(),
            positions: shape.positions,
        });
    }
    Ok((mesh, slots))
}

/// Refuses faces that join other vertices than those of the first shape.
fn check_faces(first: &ObjFile, file: &ObjFile) -> Result<(), SceneError> {
    let [expected, found] = [first, file].map(|file| faces(&file.text));
    let name = first.path.display();
    if found.len() != expected.len() {
        let reason = format!(
            "has {} faces, {name} has {}; key shapes must have the same faces in the same order",
            found.len(),
            expected.len()
        );
        return Err(SceneError::file(&file.path, reason));
    }
    for (expected, found) in expected.iter().zip(&found) {
        if expected.vertices != found.vertices {
            let reason = format!(
                "the face joins the vertices {:?}, in {name}:{} it joins {:?}; key shapes must have the same faces in \
                 the same order",
                found.vertices, expected.line, expected.vertices
            );
            return Err(SceneError::line(&file.path, found.line, reason));
        }
    }
    Ok(())
}

/// Refuses groups, materials and kinds of faces that are not those of the first shape.
fn check_parts(first: &ObjFile, file: &ObjFile) -> Result<(), SceneError> {
    let described = |file: &ObjFile| -> Vec<String> {
        let describe = |part: &tobj::Model| {
            let material = file.material(&part.mesh);
            let normals = if part.mesh.normals.is_empty() {
                "without"
            } else {
                "with"
            };
            format!(
                "{} triangles of group \"{}\" {normals} normals in material \"{}\"",
                part.mesh.indices.len() / 3,
                part.name,
                material.name
            )
        };
        file.parts.iter().map(describe).collect()
    };
    let [expected, found] = [first, file].map(described);
    let name = first.path.display();
    if expected != found {
        let differing = expected.iter().zip(&found).position(|(e, f)| e != f);
        let part = differing.unwrap_or(expected.len().min(found.len()));
        let nothing = "nothing".to_owned();
        let reason = format!(
            "has {} where {name} has {}; key shapes must have the same groups, materials and kinds of faces",
            found.get(part).unwrap_or(&nothing),
            expected.get(part).unwrap_or(&nothing)
        );
        return Err(SceneError::file(&file.path, reason));
    }
    for (expected, found) in first.parts.iter().zip(&file.parts) {
        let [expected, found] = [first.material(&expected.mesh), file.material(&found.mesh)];
        if expected != found {
            let reason = format!(
                "material \"{}\" is not the same as in {name}; key shapes must have the same materials",
                found.name
            );
            return Err(SceneError::file(&file.path, reason));
        }
    }
    Ok(())
}

/// The faces of an OBJ text that has been checked.
fn faces(text: &str) -> Vec<Face> {
    let mut faces = Vec::new();
    let mut vertices = 0;
    for statement in statements(text) {
        match statement.keyword {
            "v" => vertices += 1,
            "f" => {
                let index = |corner: &str| {
                    let word = corner.split('/').next().unwrap_or_default();
                    let index: i64 = word.parse().expect("indices have been checked");
                    if index < 0 {
                        vertices + 1 + index
                    } else {
                        index
                    }
                };
                faces.push(Face {
                    line: statement.line,
                    vertices: statement.rest.split_whitespace().map(index).collect(),
                });
            }
            _ => (),
        }
    }
    faces
}

/// The same files with one numbering of vertices: corners that are one vertex in every file stay one. Programs that
/// write OBJ number equal normals alike, so that files of the same faces may number their vertices differently.
fn joined(files: &[&ObjFile]) -> Vec<ObjFile> {
    let mut joined: Vec<ObjFile> = files.iter().map(|file| (*file).clone()).collect();
    for part in 0..files[0].parts.len() {
        let mut numbers: HashMap<Vec<u32>, u32> = HashMap::new();
        let mut corners_of_numbers = Vec::new();
        let mut indices = Vec::new();
        for corner in 0..files[0].parts[part].mesh.indices.len() {
            let key: Vec<u32> = files
                .iter()
                .map(|file| file.parts[part].mesh.indices[corner])
                .collect();
            let next = numbers.len() as u32;
            let number = *numbers.entry(key).or_insert_with(|| {
                corners_of_numbers.push(corner);
                next
            });
            indices.push(number);
        }
        for (file, joined) in files.iter().zip(&mut joined) {
            let from = &file.parts[part].mesh;
            let taken = |values: &[f32], width: usize| -> Vec<f32> {
                let vertices = corners_of_numbers
                    .iter()
                    .map(|corner| from.indices[*corner]);
                if values.is_empty() {
                    return Vec::new();
                }
                vertices
                    .flat_map(|vertex| &values[width * vertex as usize..][..width])
                    .copied()
                    .collect()
            };
            joined.parts[part].mesh = tobj::Mesh {
                positions: taken(&from.positions, 3),
                normals: taken(&from.normals, 3),
                texcoords: taken(&from.texcoords, 2),
                indices: indices.clone(),
                material_id: from.material_id,
                ..tobj::Mesh::default()
            };
        }
    }
    joined
}

/// Per vertex of a mesh, whether its face is flat beside others that have normals.
fn flat_vertices(file: &ObjFile, group: Option<&str>, mesh: &Mesh) -> Vec<bool> {
    let mut flat = vec![false; mesh.positions.len()];
    let parts = file.parts_of(group);
    let of_triangles = parts.flat_map(|part| {
        let is_flat = part.normals.is_empty();
        part.indices.chunks_exact(3).map(move |_| is_flat)
    });
    for (triangle, is_flat) in mesh.triangles.iter().zip(of_triangles) {
        for vertex in triangle {
            flat[*vertex as usize] = is_flat;
        }
    }
    flat
}
