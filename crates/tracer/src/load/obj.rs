//! Meshes from OBJ files.

use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

use glam::{Vec2, Vec3};

use super::error::SceneError;
use super::files::Files;
use super::mtl::{Libraries, default_material};
use super::obj_check::check_obj;
use super::texture::Textures;
use crate::limits::LARGEST_MESH_FILE;
use crate::{Material, Mesh};

/// OBJ file with its materials.
#[derive(Clone)]
pub(super) struct ObjFile {
    pub(super) path: PathBuf,
    pub(super) text: String,
    /// Runs of faces with one group and one material.
    pub(super) parts: Vec<tobj::Model>,
    materials: Vec<Material>,
}

/// Material of a mesh.
#[derive(Clone)]
pub(super) struct Slot {
    /// Material as the MTL file has it.
    pub(super) material: Material,
    /// True if all its faces have texture coordinates.
    pub(super) textured: bool,
}

/// Slots of a mesh, found by name: a mesh may have thousands, and two of one name are rare.
#[derive(Default)]
struct Slots {
    slots: Vec<Slot>,
    by_name: HashMap<String, Vec<usize>>,
}

impl Slots {
    /// Adds a slot for a part's material, unless an equal one is there, and returns its index.
    fn add(&mut self, material: Material, textured: bool) -> u32 {
        let named = self.by_name.entry(material.name.clone()).or_default();
        let mut known = named.iter().copied();
        let index = known.find(|index| self.slots[*index].material == material);
        let index = index.unwrap_or_else(|| {
            named.push(self.slots.len());
            self.slots.push(Slot { material, textured });
            self.slots.len() - 1
        });
        self.slots[index].textured &= textured;
        u32::try_from(index).expect("a mesh has fewer than 2^32 materials")
    }
}

impl ObjFile {
    /// Reads an OBJ file. The outer error says why it cannot be read; the caller knows the line that names the file.
    pub(super) fn read(
        files: &mut Files,
        textures: &mut Textures,
        path: &Path,
    ) -> Result<Result<Self, SceneError>, String> {
        let text = files.read_text(path, LARGEST_MESH_FILE)?;
        Ok(Self::parse(files, textures, path, text))
    }

    fn parse(
        files: &mut Files,
        textures: &mut Textures,
        path: &Path,
        text: String,
    ) -> Result<Self, SceneError> {
        let mut libraries = Libraries::default();
        let checked = check_obj(files, path, &text, &mut libraries)?;
        let options = tobj::LoadOptions {
            single_index: true,
            triangulate: true,
            ..Default::default()
        };
        let library = |name: &Path| tobj::load_mtl_buf(&mut libraries.texts[name].as_bytes());
        let read = tobj::load_obj_buf(&mut checked.as_bytes(), &options, library);
        let (parts, read) = read
            .and_then(|(parts, materials)| Ok((parts, materials?)))
            .map_err(|error| {
                SceneError::in_file(path, format!("not a readable OBJ file: {error}"))
            })?;
        let materials = read
            .iter()
            .map(|material| libraries.build_material(files, textures, material))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            path: path.to_owned(),
            text,
            parts: parts
                .into_iter()
                .filter(|part| !part.mesh.indices.is_empty())
                .collect(),
            materials,
        })
    }

    /// Lists the names of groups and objects that have faces, each once, in the order of the file.
    pub(super) fn groups(&self) -> Vec<&str> {
        let mut seen = HashSet::new();
        let names = self.parts.iter().map(|part| part.name.as_str());
        names.filter(|name| seen.insert(*name)).collect()
    }

    /// Builds a mesh of the whole file or one group, with the materials of its slots.
    pub(super) fn build_mesh(&self, group: Option<&str>) -> Result<(Mesh, Vec<Slot>), SceneError> {
        let (mesh, slots) = self.build_unchecked(group);
        self.check_area(&mesh)?;
        Ok((mesh, slots))
    }

    /// Builds one of several shapes, which may have no area.
    pub(super) fn build_shape(&self, group: Option<&str>) -> Mesh {
        self.build_unchecked(group).0
    }

    /// Parts of the whole file or of one group.
    pub(super) fn parts_of<'a>(
        &'a self,
        group: Option<&'a str>,
    ) -> impl Iterator<Item = &'a tobj::Mesh> {
        self.parts
            .iter()
            .filter(move |part| group.is_none_or(|group| part.name == group))
            .map(|part| &part.mesh)
    }

    /// Material of a part.
    pub(super) fn material(&self, part: &tobj::Mesh) -> Material {
        match part.material_id {
            Some(index) => self.materials[index].clone(),
            None => default_material(),
        }
    }

    fn build_unchecked(&self, group: Option<&str>) -> (Mesh, Vec<Slot>) {
        let parts: Vec<_> = self.parts_of(group).collect();
        let with_normals = parts.iter().any(|part| !part.normals.is_empty());
        let with_texcoords = parts.iter().any(|part| !part.texcoords.is_empty());
        let mut mesh = Mesh {
            path: self.path.clone(),
            positions: Vec::new(),
            normals: Vec::new(),
            texcoords: Vec::new(),
            triangles: Vec::new(),
            slots: Vec::new(),
            shapes: Vec::new(),
        };
        let mut slots = Slots::default();
        for part in parts {
            let slot = slots.add(self.material(part), !part.texcoords.is_empty());
            push_part(&mut mesh, part, slot, with_normals, with_texcoords);
        }
        (mesh, slots.slots)
    }

    fn check_area(&self, mesh: &Mesh) -> Result<(), SceneError> {
        if mesh.triangles.is_empty() {
            let reason = "holds no faces; a mesh needs at least one f statement with 3 corners";
            return Err(SceneError::in_file(&self.path, reason));
        }
        let has_area = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|index| mesh.positions[index as usize].as_dvec3());
            (b - a).cross(c - a).length_squared() > 0.0
        };
        if !mesh.triangles.iter().any(has_area) {
            return Err(SceneError::without_area(&self.path, mesh.triangles.len()));
        }
        Ok(())
    }
}

/// Adds the faces of one part. Beside parts with normals, faces without get flat ones; beside parts with texture
/// coordinates, faces without get (0, 0), which no texture reads.
fn push_part(
    mesh: &mut Mesh,
    part: &tobj::Mesh,
    slot: u32,
    with_normals: bool,
    with_texcoords: bool,
) {
    let flat = with_normals && part.normals.is_empty();
    // Flat faces share no vertices.
    let vertices: Vec<u32> = if flat {
        part.indices.clone()
    } else {
        (0..part.positions.len() as u32 / 3).collect()
    };
    let first = mesh.positions.len() as u32;
    let triple = |values: &[f32], index: u32| Vec3::from_slice(&values[3 * index as usize..]);
    for &index in &vertices {
        mesh.positions.push(triple(&part.positions, index));
        if with_texcoords {
            let texcoord = match part.texcoords.is_empty() {
                true => Vec2::ZERO,
                false => Vec2::from_slice(&part.texcoords[2 * index as usize..]),
            };
            mesh.texcoords.push(texcoord);
        }
        if with_normals && !flat {
            let normal = triple(&part.normals, index).as_dvec3().normalize();
            mesh.normals.push(normal.as_vec3());
        }
    }
    for (face, corners) in part.indices.chunks_exact(3).enumerate() {
        let corners = match flat {
            true => [0, 1, 2].map(|corner| 3 * face as u32 + corner),
            false => [corners[0], corners[1], corners[2]],
        };
        let triangle = corners.map(|corner| first + corner);
        if flat {
            let [a, b, c] = triangle.map(|index| mesh.positions[index as usize].as_dvec3());
            // A face without area has no direction, and no ray hits it.
            let normal = (b - a).cross(c - a).normalize_or(glam::DVec3::Y);
            mesh.normals.extend([normal.as_vec3(); 3]);
        }
        mesh.triangles.push(triangle);
        mesh.slots.push(slot);
    }
}
