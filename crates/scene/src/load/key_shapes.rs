//! Meshes from OBJ files: from one, or from key shapes, which have the same faces.

use std::borrow::Cow;
use std::collections::HashMap;

use glam::{DVec3, Vec2, Vec3};

use super::error::SceneError;
use super::face_lines::list_faces;
use super::material_list::MaterialList;
use super::obj::{ObjFile, Part};
use super::triangulation::Cut;
use crate::{Material, Mesh, Shape};

/// Material of a mesh.
#[derive(Clone)]
pub(super) struct Slot {
    /// Material as in the MTL file.
    pub(super) material: Material,
    /// True if all its faces have texture coordinates.
    pub(super) textured: bool,
}

/// Builds the mesh of a whole file or one group, with the materials of its slots. Several files are
/// the shapes of a deforming mesh at these times; materials and texture coordinates come from the
/// first.
///
/// If some parts have normals, faces without get flat ones; if some have texture coordinates, faces
/// without get (0, 0), which no texture reads.
pub(super) fn build_mesh(
    files: &[(f64, &ObjFile)],
    group: Option<&str>,
) -> Result<(Mesh, Vec<Slot>), SceneError> {
    let (_, first) = files[0];
    for (_, file) in &files[1..] {
        check_faces(first, file)?;
        check_parts(first, file)?;
    }
    let mut building = Building {
        mesh: Mesh {
            path: first.path.clone(),
            ..Mesh::default()
        },
        shapes: (files.iter())
            .map(|(time, _)| Shape {
                time: *time,
                positions: Vec::new(),
                normals: Vec::new(),
            })
            .collect(),
        flat_triangles: Vec::new(),
        with_normals: first
            .parts_of(group)
            .any(|(_, part)| !part.normals.is_empty()),
        with_texcoords: first
            .parts_of(group)
            .any(|(_, part)| !part.texcoords.is_empty()),
    };
    let mut materials = MaterialList::default();
    let mut textured: Vec<bool> = Vec::new();
    for (index, part) in first.parts_of(group) {
        let slot = materials.add(first.material(part));
        textured.resize(materials.list.len(), true);
        textured[slot] &= !part.texcoords.is_empty();
        building.add_part(files, index, slot as u32)?;
    }
    let mesh = building.finish();
    check_area(&mesh)?;
    let slots = materials.list.into_iter().zip(textured);
    let slots = slots.map(|(material, textured)| Slot { material, textured });
    Ok((mesh, slots.collect()))
}

/// Mesh under construction.
struct Building {
    mesh: Mesh,
    /// Shape of each file.
    shapes: Vec<Shape>,
    /// Triangles that get flat normals.
    flat_triangles: Vec<[u32; 3]>,
    with_normals: bool,
    with_texcoords: bool,
}

impl Building {
    /// Adds the faces of a part, by its index in every file. The first file decides how they are
    /// cut.
    fn add_part(
        &mut self,
        files: &[(f64, &ObjFile)],
        index: usize,
        slot: u32,
    ) -> Result<(), SceneError> {
        let (_, first) = files[0];
        let Cut {
            triangles,
            crossings,
        } = first.cut_faces(index)?;
        let parts = files
            .iter()
            .map(|(_, file)| Cow::Borrowed(&file.parts[index]));
        let mut parts: Vec<Cow<Part>> = parts.collect();
        if !crossings.is_empty() {
            parts
                .iter_mut()
                .for_each(|part| part.to_mut().add_crossings(&crossings));
        }
        let is_flat = |triangle: &[u32; 3]| {
            let lacks_normal = |part: &Cow<Part>| {
                let mut vertices = triangle.iter().map(|corner| part.corners[*corner as usize]);
                vertices.any(|vertex| part.normal(vertex) == Vec3::ZERO)
            };
            self.with_normals && parts.iter().any(lacks_normal)
        };
        let is_flat: Vec<bool> = triangles.iter().map(is_flat).collect();
        let corners = triangles.as_flattened();
        let numbers = number_vertices(&parts, corners, &is_flat);
        let start = self.shapes[0].positions.len() as u32;
        for place in first_places(&numbers) {
            let corner = corners[place] as usize;
            for (shape, part) in self.shapes.iter_mut().zip(&parts) {
                let vertex = part.corners[corner];
                shape.positions.push(part.positions[vertex as usize]);
                if self.with_normals {
                    let normal = part.normal(vertex);
                    shape.normals.push(if is_flat[place / 3] {
                        Vec3::ZERO
                    } else {
                        normal
                    });
                }
            }
            if self.with_texcoords {
                let texcoord = parts[0].texcoords.get(parts[0].corners[corner] as usize);
                self.mesh
                    .texcoords
                    .push(texcoord.copied().unwrap_or(Vec2::ZERO));
            }
        }
        for (numbers, is_flat) in numbers.chunks_exact(3).zip(is_flat) {
            let triangle = [0, 1, 2].map(|corner| start + numbers[corner]);
            self.flat_triangles.extend(is_flat.then_some(triangle));
            self.mesh.triangles.push(triangle);
            self.mesh.slots.push(slot);
        }
        Ok(())
    }

    fn finish(self) -> Mesh {
        let mut mesh = self.mesh;
        mesh.positions.clone_from(&self.shapes[0].positions);
        mesh.normals.clone_from(&self.shapes[0].normals);
        for triangle in self.flat_triangles {
            // A face without area has no direction, and no ray hits it.
            let normal = find_area_normal(&mesh, triangle).normalize_or(DVec3::Y);
            for vertex in triangle {
                mesh.normals[vertex as usize] = normal.as_vec3();
            }
        }
        if self.shapes.len() > 1 {
            mesh.shapes = self.shapes;
        }
        mesh
    }
}

/// Numbers the corners of triangles, in the order in which they are first met. Corners that are one
/// vertex in every file have one number: equal normals share an index, so that files of the same
/// faces may differ in theirs. Flat triangles share no vertices.
fn number_vertices(parts: &[Cow<Part>], corners: &[u32], is_flat: &[bool]) -> Vec<u32> {
    let mut numbers = vec![0; corners.len()];
    for part in parts {
        let mut known = HashMap::new();
        for (place, (number, corner)) in numbers.iter_mut().zip(corners).enumerate() {
            let vertex = part.corners[*corner as usize];
            let alone = is_flat[place / 3].then_some(place);
            let next = known.len() as u32;
            *number = *known.entry((*number, vertex, alone)).or_insert(next);
        }
    }
    numbers
}

/// Lists where each number is first met.
fn first_places(numbers: &[u32]) -> impl Iterator<Item = usize> {
    let mut next = 0;
    (numbers.iter().enumerate()).filter_map(move |(place, number)| {
        let is_first = *number == next;
        next += u32::from(is_first);
        is_first.then_some(place)
    })
}

/// Finds a normal of a triangle; its length is twice the area.
fn find_area_normal(mesh: &Mesh, triangle: [u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize].as_dvec3());
    (b - a).cross(c - a)
}

fn check_area(mesh: &Mesh) -> Result<(), SceneError> {
    if mesh.triangles.is_empty() {
        let reason = "holds no faces; a mesh needs at least one f statement with 3 corners";
        return Err(SceneError::in_file(&mesh.path, reason));
    }
    let has_area = |triangle: &[u32; 3]| find_area_normal(mesh, *triangle).length_squared() > 0.0;
    if !mesh.triangles.iter().any(has_area) {
        return Err(SceneError::without_area(&mesh.path, mesh.triangles.len()));
    }
    Ok(())
}

/// Refuses faces with other vertices than the first shape's.
fn check_faces(first: &ObjFile, file: &ObjFile) -> Result<(), SceneError> {
    let name = first.path.display();
    let [expected, counted] = [first, file].map(|file| list_faces(&file.text).count());
    if counted != expected {
        let reason = format!(
            "has {counted} faces, {name} has {expected}; key shapes must have the same faces in the same order"
        );
        return Err(SceneError::in_file(&file.path, reason));
    }
    let mut pairs = list_faces(&first.text).zip(list_faces(&file.text));
    match pairs.find(|(expected, face)| expected.vertices != face.vertices) {
        None => Ok(()),
        Some((expected, face)) => {
            let reason = format!(
                "the face has the vertices {:?}, in {name}:{} it has {:?}; key shapes must have the same faces in \
                 the same order",
                face.vertices, expected.line, expected.vertices
            );
            Err(SceneError::at_line(&file.path, face.line, reason))
        }
    }
}

/// Refuses groups, materials and kinds of faces that differ from the first shape's.
fn check_parts(first: &ObjFile, file: &ObjFile) -> Result<(), SceneError> {
    let describe = |file: &ObjFile, part: &Part| {
        let normals = if part.normals.is_empty() {
            "without"
        } else {
            "with"
        };
        format!(
            "{} triangles of group \"{}\" {normals} normals in material \"{}\"",
            part.count_triangles(),
            part.group,
            file.material(part).name
        )
    };
    let [expected, parts] = [first, file].map(|file| {
        file.parts
            .iter()
            .map(|part| describe(file, part))
            .collect::<Vec<_>>()
    });
    let name = first.path.display();
    if expected != parts {
        let differing = expected.iter().zip(&parts).position(|(e, f)| e != f);
        let part = differing.unwrap_or(expected.len().min(parts.len()));
        let nothing = "nothing".to_owned();
        let reason = format!(
            "has {} where {name} has {}; key shapes must have the same groups, materials and kinds of faces",
            parts.get(part).unwrap_or(&nothing),
            expected.get(part).unwrap_or(&nothing)
        );
        return Err(SceneError::in_file(&file.path, reason));
    }
    for (expected, part) in first.parts.iter().zip(&file.parts) {
        let [expected, material] = [first.material(expected), file.material(part)];
        if expected != material {
            let reason = format!(
                "material \"{}\" is not the same as in {name}; key shapes must have the same materials",
                material.name
            );
            return Err(SceneError::in_file(&file.path, reason));
        }
    }
    Ok(())
}
