//! Meshes as primitives: one per material, and one more if some of its faces are flat.

use std::collections::BTreeMap;

use glam::Vec3;
use scene::{Mesh, Shape};
use serde_json::{Value, json};

use crate::export::document::{Document, VERTICES};

/// Adds a mesh with a material per slot. Shapes become morph targets: their differences from the
/// first.
pub fn push_mesh(document: &mut Document, name: &str, mesh: &Mesh, materials: &[usize]) -> usize {
    let mut groups: BTreeMap<(u32, bool), Vec<[u32; 3]>> = BTreeMap::new();
    for (triangle, slot) in mesh.triangles.iter().zip(&mesh.slots) {
        let is_smooth = triangle.iter().all(|corner| has_normal(mesh, *corner));
        let group = groups.entry((*slot, is_smooth)).or_default();
        group.push(*triangle);
    }
    let mut primitives = Vec::new();
    for ((slot, is_smooth), triangles) in groups {
        let material = materials[slot as usize];
        let primitive = push_primitive(document, mesh, &triangles, is_smooth, material);
        primitives.push(primitive);
    }
    let targets = mesh.shapes.len().saturating_sub(1);
    let weights = (targets > 0).then(|| vec![0.0; targets]);
    let mesh = json!({ "name": name, "primitives": primitives, "weights": weights });
    document.push("meshes", mesh)
}

/// Returns whether a vertex has a normal in every shape. Without one the tracer uses the facet's,
/// as glTF does.
fn has_normal(mesh: &Mesh, vertex: u32) -> bool {
    let is_given = |normals: &[Vec3]| {
        (normals.get(vertex as usize)).is_some_and(|normal| *normal != Vec3::ZERO)
    };
    is_given(&mesh.normals) && mesh.shapes.iter().all(|shape| is_given(&shape.normals))
}

fn push_primitive(
    document: &mut Document,
    mesh: &Mesh,
    triangles: &[[u32; 3]],
    is_smooth: bool,
    material: usize,
) -> Value {
    // Vertices in the order in which the triangles use them, without other primitives' vertices.
    let mut vertices: Vec<u32> = Vec::new();
    let mut places: BTreeMap<u32, u32> = BTreeMap::new();
    let indices: Vec<u32> = (triangles.iter().flatten())
        .map(|vertex| {
            *places.entry(*vertex).or_insert_with(|| {
                vertices.push(*vertex);
                vertices.len() as u32 - 1
            })
        })
        .collect();
    let pick = |values: &[Vec3]| -> Vec<[f32; 3]> {
        let picked = vertices.iter().map(|vertex| values[*vertex as usize]);
        picked.map(|value| value.to_array()).collect()
    };
    let positions = document.push_limited(&pick(&mesh.positions), VERTICES);
    let normals = is_smooth.then(|| document.push_floats(&pick(&mesh.normals), VERTICES));
    let is_textured = !mesh.texcoords.is_empty() && is_textured(document, material);
    let texcoords = is_textured.then(|| {
        // Down from the top there, up from the bottom here.
        let texcoords: Vec<[f32; 2]> = (vertices.iter())
            .map(|vertex| mesh.texcoords[*vertex as usize])
            .map(|texcoord| [texcoord.x, 1.0 - texcoord.y])
            .collect();
        document.push_floats(&texcoords, VERTICES)
    });
    let targets: Vec<Value> = (mesh.shapes.iter().skip(1))
        .map(|shape| push_target(document, mesh, shape, is_smooth, &pick))
        .collect();
    json!({
        "attributes": { "POSITION": positions, "NORMAL": normals, "TEXCOORD_0": texcoords },
        "indices": document.push_indices(&indices),
        "material": material,
        "targets": (!targets.is_empty()).then_some(targets),
    })
}

fn is_textured(document: &Document, material: usize) -> bool {
    let material = &document.list("materials")[material];
    let color = &material["pbrMetallicRoughness"]["baseColorTexture"];
    color.is_object() || material["emissiveTexture"].is_object()
}

fn push_target(
    document: &mut Document,
    mesh: &Mesh,
    shape: &Shape,
    is_smooth: bool,
    pick: &impl Fn(&[Vec3]) -> Vec<[f32; 3]>,
) -> Value {
    let difference = |vectors: &[Vec3], first: &[Vec3]| {
        let pairs = vectors.iter().zip(first);
        pick(
            &pairs
                .map(|(vector, first)| vector - first)
                .collect::<Vec<_>>(),
        )
    };
    let normals = is_smooth.then(|| {
        let normals = difference(&shape.normals, &mesh.normals);
        document.push_floats(&normals, VERTICES)
    });
    let positions = difference(&shape.positions, &mesh.positions);
    json!({ "POSITION": document.push_limited(&positions, VERTICES), "NORMAL": normals })
}
