//! OBJ files: tobj reads them. What it read is checked here.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use glam::{Vec2, Vec3};
use tobj::LoadOptions;

use super::error::SceneError;
use super::face_lines::list_faces;
use super::files::Files;
use super::libraries::Libraries;
use super::mtl::default_material;
use super::obj_fault::find_fault;
use super::obj_text::ObjText;
use super::outline::Crossing;
use super::statements::clean_text;
use super::texture::Textures;
use super::triangulation::{Cut, triangulate};
use crate::Material;
use crate::limits::{LARGEST_NUMBER, MAX_CORNERS, MAX_TRIANGLES};

/// One index for all attributes of a corner. Faces are cut later: tobj would fill concave ones.
const OPTIONS: LoadOptions = LoadOptions {
    single_index: true,
    triangulate: false,
    ignore_points: false,
    ignore_lines: false,
};

/// OBJ file with its materials.
pub(super) struct ObjFile {
    pub(super) path: PathBuf,
    /// Text of the file, for the lines of its faces.
    pub(super) text: String,
    /// Runs of faces with one group and one material.
    pub(super) parts: Vec<Part>,
    materials: Vec<Material>,
    /// Sentences about what was not read.
    pub(super) notes: Vec<String>,
}

/// Faces of one group and one material. Their corners have the same kinds of indices.
#[derive(Clone)]
pub(super) struct Part {
    pub(super) group: String,
    /// Index into the materials of the file; none for the default.
    material: Option<usize>,
    pub(super) positions: Vec<Vec3>,
    /// Texture coordinates, one per position or none.
    pub(super) texcoords: Vec<Vec2>,
    /// Unit normals, one per position or none; zero where the file gives one without length.
    pub(super) normals: Vec<Vec3>,
    /// Vertices of all corners, face by face.
    pub(super) corners: Vec<u32>,
    /// Number of corners of each face.
    arities: Vec<u32>,
}

impl Part {
    /// Takes what tobj read; returns none if faces, indices or numbers are not allowed.
    fn new(model: tobj::Model) -> Option<Self> {
        let tobj::Model { mesh, name } = model;
        let arities = match mesh.face_arities {
            // tobj lists none if all are triangles.
            arities if arities.is_empty() => vec![3; mesh.indices.len() / 3],
            arities => arities,
        };
        let is_allowed = |number: &f32| f64::from(number.abs()) <= LARGEST_NUMBER;
        let mut numbers = mesh
            .positions
            .iter()
            .chain(&mesh.texcoords)
            .chain(&mesh.normals);
        let mut counts = arities.iter().map(|count| *count as usize);
        if !numbers.all(is_allowed) || !counts.all(|count| (3..=MAX_CORNERS).contains(&count)) {
            return None;
        }
        let part = Self {
            group: name,
            material: mesh.material_id,
            positions: mesh
                .positions
                .chunks_exact(3)
                .map(Vec3::from_slice)
                .collect(),
            texcoords: mesh
                .texcoords
                .chunks_exact(2)
                .map(Vec2::from_slice)
                .collect(),
            normals: mesh.normals.chunks_exact(3).map(unit_normal).collect(),
            corners: mesh.indices,
            arities,
        };
        // tobj leaves out what a corner does not have.
        let lengths = [part.texcoords.len(), part.normals.len()];
        let is_complete = |length| length == 0 || length == part.positions.len();
        lengths.into_iter().all(is_complete).then_some(part)
    }

    /// Normal of a vertex; zero if there is none.
    pub(super) fn normal(&self, vertex: u32) -> Vec3 {
        let normal = self.normals.get(vertex as usize);
        normal.copied().unwrap_or(Vec3::ZERO)
    }

    pub(super) fn count_triangles(&self) -> usize {
        self.corners.len() - 2 * self.arities.len()
    }

    /// Cuts all faces into triangles, as indices into the corners. The error is the number of a
    /// face that cannot be cut.
    fn cut_faces(&self) -> Result<Cut, usize> {
        let mut all = Cut::default();
        let mut start = 0;
        for (face, arity) in self.arities.iter().enumerate() {
            let vertices = &self.corners[start as usize..][..*arity as usize];
            let positions = vertices
                .iter()
                .map(|vertex| self.positions[*vertex as usize]);
            let cut = triangulate(&positions.collect::<Vec<_>>()).ok_or(face)?;
            let crossings = (self.corners.len() + all.crossings.len()) as u32;
            let number = |corner: u32| match corner.checked_sub(*arity) {
                None => start + corner,
                Some(crossing) => crossings + crossing,
            };
            let triangles = cut.triangles.iter();
            all.triangles
                .extend(triangles.map(|corners| corners.map(number)));
            all.crossings
                .extend(cut.crossings.iter().map(|crossing| Crossing {
                    ends: crossing.ends.map(number),
                    ..*crossing
                }));
            start += arity;
        }
        Ok(all)
    }

    /// Adds the corners where faces cross themselves.
    pub(super) fn add_crossings(&mut self, crossings: &[Crossing]) {
        for crossing in crossings {
            let [from, to] = crossing
                .ends
                .map(|corner| self.corners[corner as usize] as usize);
            let along = crossing.along as f32;
            self.corners.push(self.positions.len() as u32);
            self.positions
                .push(self.positions[from].lerp(self.positions[to], along));
            if !self.texcoords.is_empty() {
                self.texcoords
                    .push(self.texcoords[from].lerp(self.texcoords[to], along));
            }
            if !self.normals.is_empty() {
                let normal = self.normals[from].lerp(self.normals[to], along);
                self.normals.push(normal.normalize_or_zero());
            }
        }
    }
}

fn unit_normal(numbers: &[f32]) -> Vec3 {
    let normal = Vec3::from_slice(numbers).as_dvec3();
    normal.normalize_or_zero().as_vec3()
}

impl ObjFile {
    /// Reads the text of an OBJ file, and the files of materials and textures that it names.
    pub(super) fn read(
        files: &mut Files,
        textures: &mut Textures,
        path: &Path,
        text: &str,
    ) -> Result<Self, SceneError> {
        let text = clean_text(text);
        let fault = || find_fault(path, &text);
        let prepared = ObjText::prepare(&text).ok_or_else(fault)?;
        let libraries = Libraries::read(files, path, &prepared.libraries)?;
        libraries.check_materials(path, prepared.materials.values())?;
        let loaded = tobj::load_obj_buf(&mut prepared.reader(), &OPTIONS, |_| libraries.loaded());
        let (models, _) = loaded.map_err(|_| fault())?;
        let models = models.into_iter().filter(|model| !is_empty(&model.mesh));
        let parts: Option<Vec<Part>> = models.map(Part::new).collect();
        let mut parts = parts.ok_or_else(fault)?;
        if parts.iter().map(Part::count_triangles).sum::<usize>() > MAX_TRIANGLES {
            return Err(fault());
        }
        for part in &mut parts {
            if let Some(material) = part.material {
                libraries.mapping(material)?.apply(&mut part.texcoords);
            }
        }
        Ok(Self {
            path: path.to_owned(),
            materials: libraries.build_materials(files, textures)?,
            notes: libraries.notes,
            parts,
            text: text.into_owned(),
        })
    }

    /// Material of a part.
    pub(super) fn material(&self, part: &Part) -> Material {
        let index = part.material;
        index.map_or_else(default_material, |index| self.materials[index].clone())
    }

    /// Lists the names of groups and objects that have faces, each once, in the order of the file.
    pub(super) fn groups(&self) -> Vec<&str> {
        let mut seen = HashSet::new();
        let names = self.parts.iter().map(|part| part.group.as_str());
        names.filter(|name| seen.insert(*name)).collect()
    }

    /// Parts of the whole file or of one group, with their indices.
    pub(super) fn parts_of(&self, group: Option<&str>) -> impl Iterator<Item = (usize, &Part)> {
        let parts = self.parts.iter().enumerate();
        parts.filter(move |(_, part)| group.is_none_or(|group| part.group == group))
    }

    /// Cuts the faces of a part into triangles, as indices into its corners.
    pub(super) fn cut_faces(&self, part: usize) -> Result<Cut, SceneError> {
        self.parts[part].cut_faces().map_err(|face| {
            let faces = self.parts[..part].iter().map(|part| part.arities.len());
            SceneError {
                path: self.path.clone(),
                line: (list_faces(&self.text).nth(face + faces.sum::<usize>())).map(|face| face.line),
                reason: "the face crosses itself, so that its surface is not defined; cut it into triangles".into(),
            }
        })
    }
}

fn is_empty(mesh: &tobj::Mesh) -> bool {
    mesh.indices.is_empty() && mesh.face_arities.is_empty()
}
