//! Meshes as triangles, with their morph targets and their weights on joints.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};
use scene::limits::{MAX_TRIANGLES, MAX_VERTICES};

use super::extensions::{DRACO, refuse_removable};
use super::file::File;
use super::schema;

/// Most numbers of morph targets and weights of a file's meshes together: 4 bytes each.
const MAX_NUMBERS: usize = 300_000_000;

/// A mesh's triangles of one material.
#[derive(Debug, Default)]
pub struct Primitive {
    /// Metres, in the mesh's space.
    pub positions: Vec<Vec3>,
    /// One per position, or none: then faces are flat.
    pub normals: Vec<Vec3>,
    /// Sets of texture coordinates, v down; by their number.
    pub texcoords: BTreeMap<usize, Vec<Vec2>>,
    /// Joints and weights of each position: some multiple of four; empty without.
    pub influences: Vec<Vec<(u32, f32)>>,
    pub targets: Vec<Target>,
    pub triangles: Vec<[u32; 3]>,
    pub material: Option<usize>,
    pub has_colors: bool,
}

/// Differences of a morph target; empty where it has none.
#[derive(Debug, Default)]
pub struct Target {
    pub positions: Vec<Vec3>,
    pub normals: Vec<Vec3>,
}

/// Meshes of a file that are shown, by their number.
#[derive(Debug, Default)]
pub struct Meshes {
    pub primitives: BTreeMap<usize, Vec<Primitive>>,
    /// Primitives of points and lines.
    pub unread: usize,
    /// Vertices whose weights do not sum to 1.
    pub reweighted: usize,
    vertices: usize,
    triangles: usize,
    numbers: usize,
}

impl Meshes {
    /// Reads a mesh, unless it is known.
    pub fn read(&mut self, file: &File, index: usize) -> Result<(), String> {
        if self.primitives.contains_key(&index) {
            return Ok(());
        }
        let mesh = File::entry(&file.json.meshes, "meshes", index)?;
        let mut primitives = Vec::new();
        for (at, entry) in mesh.primitives.iter().enumerate() {
            let fail = |reason| format!("meshes[{index}].primitives[{at}]: {reason}");
            if entry.mode.is_some_and(|mode| mode < 4) {
                self.unread += 1;
                continue;
            }
            let primitive = self.read_primitive(file, entry).map_err(fail)?;
            if !primitive.triangles.is_empty() {
                primitives.push(primitive);
            }
        }
        self.primitives.insert(index, primitives);
        Ok(())
    }

    fn read_primitive(
        &mut self,
        file: &File,
        entry: &schema::Primitive,
    ) -> Result<Primitive, String> {
        let Some(positions) = entry.attributes.get("POSITION") else {
            return Ok(Primitive::default());
        };
        if entry.extensions.contains_key(DRACO) {
            let accessor = File::entry(&file.json.accessors, "accessors", *positions)?;
            if accessor.buffer_view.is_none() {
                return Err(refuse_removable(DRACO, &file.path));
            }
        }
        let mut primitive = Primitive {
            positions: vectors(file, *positions, "positions")?,
            material: entry.material,
            has_colors: entry.attributes.contains_key("COLOR_0"),
            ..Primitive::default()
        };
        if let Some(material) = entry.material {
            File::entry(&file.json.materials, "materials", material)?;
        }
        let count = primitive.positions.len();
        self.count(count, 0, 0)?;
        if let Some(normals) = entry.attributes.get("NORMAL") {
            primitive.normals = vectors(file, *normals, "normals")?;
            check_count("normals", primitive.normals.len(), count)?;
        }
        for set in 0..8 {
            if let Some(accessor) = entry.attributes.get(&format!("TEXCOORD_{set}")) {
                let texcoords = file.floats::<2>(*accessor, "texture coordinates")?;
                check_count("texture coordinates", texcoords.len(), count)?;
                let texcoords = texcoords.into_iter().map(Vec2::from).collect();
                primitive.texcoords.insert(set, texcoords);
            }
        }
        primitive.triangles = read_triangles(file, entry, count)?;
        self.count(0, primitive.triangles.len(), 0)?;
        self.read_influences(file, entry, &mut primitive)?;
        for target in &*entry.targets {
            self.count(0, 0, 6 * count)?;
            let read = |name: &str| -> Result<Vec<Vec3>, String> {
                let Some(accessor) = target.get(name) else {
                    return Ok(Vec::new());
                };
                let differences = vectors(file, *accessor, "a morph target")?;
                check_count("differences of a morph target", differences.len(), count)?;
                Ok(differences)
            };
            primitive.targets.push(Target {
                positions: read("POSITION")?,
                normals: read("NORMAL")?,
            });
        }
        Ok(primitive)
    }

    /// Reads joints and weights, four at a time. Weights are divided by their sum, as three.js does.
    fn read_influences(
        &mut self,
        file: &File,
        entry: &schema::Primitive,
        primitive: &mut Primitive,
    ) -> Result<(), String> {
        let count = primitive.positions.len();
        let mut influences = vec![Vec::new(); count];
        for set in 0..4 {
            let attribute = |name: &str| entry.attributes.get(&format!("{name}_{set}"));
            let (Some(joints), Some(weights)) = (attribute("JOINTS"), attribute("WEIGHTS")) else {
                break;
            };
            self.count(0, 0, 8 * count)?;
            let joints = file.floats::<4>(*joints, "joints")?;
            let weights = file.floats::<4>(*weights, "weights of joints")?;
            check_count("joints", joints.len(), count)?;
            check_count("weights of joints", weights.len(), count)?;
            for (influences, (joints, weights)) in
                influences.iter_mut().zip(joints.iter().zip(&weights))
            {
                let pairs = joints.iter().zip(weights);
                let pairs = pairs.map(|(joint, weight)| (*joint as u32, *weight));
                influences.extend(pairs.filter(|(_, weight)| *weight != 0.0));
            }
        }
        if entry.attributes.contains_key("JOINTS_0") && entry.attributes.contains_key("WEIGHTS_0") {
            for (vertex, influences) in influences.iter_mut().enumerate() {
                self.reweighted += usize::from(normalize(influences).ok_or_else(|| {
                    format!(
                        "the weights of vertex {vertex} sum to 0 or less; allowed: 1; export the file again with weights on \
                         every vertex"
                    )
                })?);
            }
            primitive.influences = influences;
        }
        Ok(())
    }

    /// Counts what is read, and refuses more than a scene may have.
    fn count(&mut self, vertices: usize, triangles: usize, numbers: usize) -> Result<(), String> {
        self.vertices += vertices;
        self.triangles += triangles;
        self.numbers += numbers;
        let counts = [
            (self.vertices, MAX_VERTICES, "vertices"),
            (self.triangles, MAX_TRIANGLES, "triangles"),
            (
                self.numbers,
                MAX_NUMBERS,
                "numbers of morph targets and weights",
            ),
        ];
        match counts.iter().find(|(count, most, _)| count > most) {
            None => Ok(()),
            Some((count, most, what)) => Err(format!(
                "it makes {count} {what} of the file; allowed: {most}; export less at once"
            )),
        }
    }
}

/// Divides weights by their sum; returns whether they did not sum to 1, or none if the sum is not
/// positive.
fn normalize(influences: &mut [(u32, f32)]) -> Option<bool> {
    /// More than quantised weights of 8 bits are off.
    const OFF: f32 = 0.02;
    let sum: f32 = influences.iter().map(|(_, weight)| weight).sum();
    if sum <= 0.0 {
        return None;
    }
    influences.iter_mut().for_each(|(_, weight)| *weight /= sum);
    Some((sum - 1.0).abs() > OFF)
}

fn vectors(file: &File, accessor: usize, what: &str) -> Result<Vec<Vec3>, String> {
    let vectors = file.floats::<3>(accessor, what)?;
    Ok(vectors.into_iter().map(Vec3::from).collect())
}

fn check_count(what: &str, count: usize, expected: usize) -> Result<(), String> {
    if count == expected {
        Ok(())
    } else {
        Err(format!(
            "has {count} {what} and {expected} positions; allowed: as many; export the file again"
        ))
    }
}

/// Reads triangles, strips or fans. Triangles that use a vertex twice have no area and are left out.
fn read_triangles(
    file: &File,
    entry: &schema::Primitive,
    count: usize,
) -> Result<Vec<[u32; 3]>, String> {
    let corners: Vec<u32> = match entry.indices {
        Some(indices) => file.indices(indices)?,
        None => (0..count as u32).collect(),
    };
    if let Some(corner) = corners.iter().find(|corner| **corner as usize >= count) {
        return Err(format!(
            "an index is {corner}, and there are {count} vertices; export the file again"
        ));
    }
    let triangles: Vec<[u32; 3]> = match entry.mode.unwrap_or(4) {
        4 => corners
            .chunks_exact(3)
            .map(|c| [c[0], c[1], c[2]])
            .collect(),
        5 => {
            let windows = corners.windows(3).enumerate();
            // Every second triangle of a strip is wound the other way.
            windows
                .map(|(at, c)| {
                    if at % 2 == 0 {
                        [c[0], c[1], c[2]]
                    } else {
                        [c[1], c[0], c[2]]
                    }
                })
                .collect()
        }
        6 => corners
            .windows(2)
            .skip(1)
            .map(|c| [corners[0], c[0], c[1]])
            .collect(),
        mode => return Err(format!("the mode is {mode}; allowed: 0 to 6")),
    };
    let has_corners = |[a, b, c]: &[u32; 3]| a != b && b != c && c != a;
    Ok(triangles.into_iter().filter(has_corners).collect())
}
