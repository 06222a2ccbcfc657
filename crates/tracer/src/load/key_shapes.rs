//! Meshes from OBJ files: from one, or from key shapes, which have the same faces.

use std::collections::HashMap;

use glam::{DVec3, Vec2, Vec3};

use super::error::SceneError;
use super::face::{Corner, Face};
use super::material_list::MaterialList;
use super::obj::{ObjFile, Part};
use crate::{Material, Mesh, Shape};

/// Material of a mesh.
#[derive(Clone)]
pub(super) struct Slot {
    /// Material as in the MTL file.
    pub(super) material: Material,
    /// True if all its faces have texture coordinates.
    pub(super) textured: bool,
}

/// Builds the mesh of a whole file or one group, with the materials of its slots. Several files are the shapes of a deforming
/// mesh at these times; materials and texture coordinates come from the first.
///
/// If some parts have normals, faces without get flat ones; if some have texture coordinates, faces without get (0, 0), which
/// no texture reads.
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
        with_normals: first.parts_of(group).any(|(_, part)| part.has_normals()),
        with_texcoords: first.parts_of(group).any(|(_, part)| part.has_texcoords()),
    };
    let mut materials = MaterialList::default();
    let mut textured: Vec<bool> = Vec::new();
    for (index, part) in first.parts_of(group) {
        let slot = materials.add(first.material(part));
        textured.resize(materials.list.len(), true);
        textured[slot] &= part.has_texcoords();
        building.add_part(files, index, slot as u32);
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
    /// Adds the faces of a part, by its index in every file.
    fn add_part(&mut self, files: &[(f64, &ObjFile)], index: usize, slot: u32) {
        let (_, first) = files[0];
        let part = &first.parts[index];
        let is_flat = self.with_normals && !part.has_normals();
        let numbers = match is_flat {
            // Flat faces share no vertices.
            true => (0..3 * part.count_triangles() as u32).collect(),
            false => number_vertices(files.iter().map(|(_, file)| &file.parts[index])),
        };
        let start = self.shapes[0].positions.len() as u32;
        for (shape, (_, file)) in self.shapes.iter_mut().zip(files) {
            for corner in list_vertices(&file.parts[index], &numbers) {
                let position = file.positions[corner.position as usize];
                shape.positions.push(position);
                if self.with_normals {
                    let normal = corner.normal.map(|normal| file.normals[normal as usize]);
                    shape.normals.push(normal.unwrap_or(Vec3::ZERO));
                }
            }
        }
        if self.with_texcoords {
            let texcoords = list_vertices(part, &numbers).map(|corner| {
                let texcoord = corner
                    .texcoord
                    .map(|texcoord| first.texcoords[texcoord as usize]);
                texcoord.unwrap_or(Vec2::ZERO)
            });
            self.mesh.texcoords.extend(texcoords);
        }
        for corners in numbers.chunks_exact(3) {
            let triangle = [0, 1, 2].map(|corner| start + corners[corner]);
            self.flat_triangles.extend(is_flat.then_some(triangle));
            self.mesh.triangles.push(triangle);
            self.mesh.slots.push(slot);
        }
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

/// Numbers the corners of triangles, in the order in which they are first met. Corners that are one vertex in every file have one
/// number: equal normals share an index, so that files of the same faces may differ in theirs.
fn number_vertices<'a>(parts: impl Iterator<Item = &'a Part>) -> Vec<u32> {
    let mut numbers = Vec::new();
    for part in parts {
        numbers.resize(3 * part.count_triangles(), 0);
        let mut known = HashMap::new();
        for (number, corner) in numbers.iter_mut().zip(part.triangle_corners()) {
            let next = known.len() as u32;
            *number = *known.entry((*number, corner)).or_insert(next);
        }
    }
    numbers
}

/// Lists the first corner of every number.
fn list_vertices<'a>(part: &'a Part, numbers: &'a [u32]) -> impl Iterator<Item = Corner> + 'a {
    let mut next = 0;
    let corners = part.triangle_corners().zip(numbers);
    corners.filter_map(move |(corner, number)| {
        let is_first = *number == next;
        next += u32::from(is_first);
        is_first.then_some(corner)
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
    let faces = |file: &'_ ObjFile| {
        file.parts
            .iter()
            .map(|part| part.faces.len())
            .sum::<usize>()
    };
    let name = first.path.display();
    if faces(file) != faces(first) {
        let reason = format!(
            "has {} faces, {name} has {}; key shapes must have the same faces in the same order",
            faces(file),
            faces(first)
        );
        return Err(SceneError::in_file(&file.path, reason));
    }
    let [expected, found] =
        [first, file].map(|file| file.parts.iter().flat_map(|part| &part.faces));
    for (expected, found) in expected.zip(found) {
        if expected.vertices().ne(found.vertices()) {
            let list = |face: &Face| face.vertices().collect::<Vec<u32>>();
            let reason = format!(
                "the face has the vertices {:?}, in {name}:{} it has {:?}; key shapes must have the same faces in \
                 the same order",
                list(found),
                expected.line,
                list(expected)
            );
            return Err(SceneError::at_line(&file.path, found.line, reason));
        }
    }
    Ok(())
}

/// Refuses groups, materials and kinds of faces that differ from the first shape's.
fn check_parts(first: &ObjFile, file: &ObjFile) -> Result<(), SceneError> {
    let describe = |file: &ObjFile, part: &Part| {
        let normals = if part.has_normals() {
            "with"
        } else {
            "without"
        };
        format!(
            "{} triangles of group \"{}\" {normals} normals in material \"{}\"",
            part.count_triangles(),
            part.group,
            file.material(part).name
        )
    };
    let [expected, found] = [first, file].map(|file| {
        file.parts
            .iter()
            .map(|part| describe(file, part))
            .collect::<Vec<_>>()
    });
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
        let [expected, found] = [first.material(expected), file.material(found)];
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
