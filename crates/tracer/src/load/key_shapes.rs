//! Deforming meshes from OBJ files with the same faces.

use std::collections::HashMap;

use glam::Vec3;

use super::error::SceneError;
use super::obj::{ObjFile, Slot};
use super::statements::split_statements;
use crate::{Mesh, Shape};

/// Face of an OBJ file.
struct Face {
    /// Line number, counted from 1.
    line: usize,
    /// Vertices, counted from 1.
    vertices: Vec<i64>,
}

/// Builds the mesh that has these shapes at these times, with the materials of its slots. Materials and texture coordinates
/// are those of the first shape.
pub(super) fn build_deforming_mesh(
    shapes: &[(f64, &ObjFile)],
    group: Option<&str>,
) -> Result<(Mesh, Vec<Slot>), SceneError> {
    let files: Vec<&ObjFile> = shapes.iter().map(|(_, file)| *file).collect();
    for file in &files[1..] {
        check_faces(files[0], file)?;
        check_parts(files[0], file)?;
    }
    let files = unify_vertices(&files);
    let (mut mesh, slots) = files[0].build_mesh(group)?;
    let flat = find_flat_vertices(&files[0], group, &mesh);
    for ((time, _), file) in shapes.iter().zip(&files) {
        let shape = file.build_shape(group);
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

/// Refuses faces with other vertices than those of the first shape.
fn check_faces(first: &ObjFile, file: &ObjFile) -> Result<(), SceneError> {
    let [expected, found] = [first, file].map(|file| read_faces(&file.text));
    let name = first.path.display();
    if found.len() != expected.len() {
        let reason = format!(
            "has {} faces, {name} has {}; key shapes must have the same faces in the same order",
            found.len(),
            expected.len()
        );
        return Err(SceneError::in_file(&file.path, reason));
    }
    for (expected, found) in expected.iter().zip(&found) {
        if expected.vertices != found.vertices {
            let reason = format!(
                "the face has the vertices {:?}, in {name}:{} it has {:?}; key shapes must have the same faces in \
                 the same order",
                found.vertices, expected.line, expected.vertices
            );
            return Err(SceneError::at_line(&file.path, found.line, reason));
        }
    }
    Ok(())
}

/// Refuses groups, materials and kinds of faces that are not those of the first shape.
fn check_parts(first: &ObjFile, file: &ObjFile) -> Result<(), SceneError> {
    let describe_parts = |file: &ObjFile| -> Vec<String> {
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
    let [expected, found] = [first, file].map(describe_parts);
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
        return Err(SceneError::in_file(&file.path, reason));
    }
    for (expected, found) in first.parts.iter().zip(&file.parts) {
        let [expected, found] = [first.material(&expected.mesh), file.material(&found.mesh)];
        if expected != found {
            let reason = format!(
                "material \"{}\" is not the same as in {name}; key shapes must have the same materials",
                found.name
            );
            return Err(SceneError::in_file(&file.path, reason));
        }
    }
    Ok(())
}

/// Reads the faces of a checked OBJ text.
fn read_faces(text: &str) -> Vec<Face> {
    let mut faces = Vec::new();
    let mut vertices = 0;
    for statement in split_statements(text) {
        match statement.keyword {
            "v" => vertices += 1,
            "f" => {
                let read_index = |corner: &str| {
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
                    vertices: statement.rest.split_whitespace().map(read_index).collect(),
                });
            }
            _ => (),
        }
    }
    faces
}

/// Gives all files the same vertices: corners that are one vertex in every file stay one. tobj makes a vertex of each
/// different triple of indices, and equal normals share an index, so that files of the same faces may differ in theirs.
fn unify_vertices(files: &[&ObjFile]) -> Vec<ObjFile> {
    let mut unified: Vec<ObjFile> = files.iter().map(|file| (*file).clone()).collect();
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
        for (file, unified) in files.iter().zip(&mut unified) {
            let from = &file.parts[part].mesh;
            let pick = |values: &[f32], width: usize| -> Vec<f32> {
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
            unified.parts[part].mesh = tobj::Mesh {
                positions: pick(&from.positions, 3),
                normals: pick(&from.normals, 3),
                texcoords: pick(&from.texcoords, 2),
                indices: indices.clone(),
                material_id: from.material_id,
                ..tobj::Mesh::default()
            };
        }
    }
    unified
}

/// Finds the vertices of flat faces beside faces with normals.
fn find_flat_vertices(file: &ObjFile, group: Option<&str>, mesh: &Mesh) -> Vec<bool> {
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
