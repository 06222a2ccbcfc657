//! OBJ files: their vertices, and their faces by group and material.

use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};

use glam::{Vec2, Vec3};

use super::error::SceneError;
use super::face::{Corner, Face};
use super::files::Files;
use super::mtl::{Libraries, default_material};
use super::statements::{Statement, shorten, split_statements};
use super::texture::Textures;
use crate::Material;
use crate::limits::{LARGEST_MATERIAL_FILE, LARGEST_NUMBER, MAX_TRIANGLES, MAX_VERTICES};

/// Group of faces before the first `g` or `o`, and after one without a name.
const UNNAMED: &str = "unnamed_object";

/// OBJ file with its materials.
#[derive(Default)]
pub(super) struct ObjFile {
    pub(super) path: PathBuf,
    pub(super) positions: Vec<Vec3>,
    pub(super) texcoords: Vec<Vec2>,
    /// Unit normals.
    pub(super) normals: Vec<Vec3>,
    /// Runs of faces with one group and one material.
    pub(super) parts: Vec<Part>,
    materials: BTreeMap<String, Material>,
    /// Number of triangles of all faces.
    triangles: usize,
}

/// Faces of one group and one material. Their corners have the same kinds of indices.
pub(super) struct Part {
    pub(super) group: String,
    /// Name in the MTL files; none for the default.
    pub(super) material: Option<String>,
    pub(super) faces: Vec<Face>,
}

impl Part {
    fn new(group: String, material: Option<String>) -> Self {
        Self {
            group,
            material,
            faces: Vec::new(),
        }
    }

    pub(super) fn has_texcoords(&self) -> bool {
        self.faces[0].kinds()[0]
    }

    pub(super) fn has_normals(&self) -> bool {
        self.faces[0].kinds()[1]
    }

    /// Cuts the faces into triangles that have the first corner in common, and lists the corners of these.
    pub(super) fn triangle_corners(&self) -> impl Iterator<Item = Corner> {
        self.faces.iter().flat_map(|Face { corners, .. }| {
            let pairs = corners[1..].windows(2);
            pairs.flat_map(|pair| [corners[0], pair[0], pair[1]])
        })
    }

    pub(super) fn count_triangles(&self) -> usize {
        self.faces.iter().map(|face| face.corners.len() - 2).sum()
    }
}

impl ObjFile {
    /// Reads the text of an OBJ file, and the files of materials and textures that it names.
    pub(super) fn read(
        files: &mut Files,
        textures: &mut Textures,
        path: &Path,
        text: &str,
    ) -> Result<Self, SceneError> {
        let mut file = Self {
            path: path.to_owned(),
            parts: vec![Part::new(UNNAMED.into(), None)],
            ..Self::default()
        };
        let mut libraries = Libraries::default();
        for statement in split_statements(text) {
            let fail = |reason: String| SceneError::at_line(path, statement.line, reason);
            if statement.keyword == "mtllib" {
                statement.check_name().map_err(fail)?;
                let library = path.with_file_name("").join(statement.rest);
                let text = files.read_text(&library, LARGEST_MATERIAL_FILE);
                let text = text.map_err(|error| {
                    let name = library.display();
                    fail(format!("material library {name} cannot be read: {error}"))
                })?;
                libraries.read(&library, &text)?;
            } else {
                file.read_statement(&statement, &libraries).map_err(fail)?;
            }
        }
        file.parts.retain(|part| !part.faces.is_empty());
        file.materials = libraries.build_materials(files, textures)?;
        Ok(file)
    }

    /// Material of a part.
    pub(super) fn material(&self, part: &Part) -> Material {
        let name = part.material.as_ref();
        name.map_or_else(default_material, |name| self.materials[name].clone())
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

    /// Reads a statement of the mesh; skips all others.
    fn read_statement(
        &mut self,
        statement: &Statement,
        libraries: &Libraries,
    ) -> Result<(), String> {
        match statement.keyword {
            "o" | "g" => {
                statement.check_name()?;
                self.next_part().group = match statement.rest {
                    "" => UNNAMED.to_owned(),
                    name => name.to_owned(),
                };
                Ok(())
            }
            "usemtl" => {
                statement.check_name()?;
                check_material(statement, libraries)?;
                let name = Some(statement.rest.to_owned());
                if self.last_part().material != name {
                    self.next_part().material = name;
                }
                Ok(())
            }
            "f" => self.read_face(statement),
            "v" => {
                self.positions.push(read_position(statement)?);
                check_count(self.positions.len(), MAX_VERTICES, "vertices")
            }
            "vt" => {
                let numbers = statement.read_numbers(&[2, 3])?;
                self.texcoords.push(Vec2::from_slice(&numbers));
                check_count(self.texcoords.len(), MAX_VERTICES, "texture coordinates")
            }
            "vn" => {
                let normal = Vec3::from_slice(&statement.read_numbers(&[3])?);
                if normal.length_squared() == 0.0 {
                    return Err("vn has no length; give it a direction".into());
                }
                self.normals.push(normal.as_dvec3().normalize().as_vec3());
                check_count(self.normals.len(), MAX_VERTICES, "normals")
            }
            _ => Ok(()),
        }
    }

    /// The part that faces are added to.
    fn last_part(&mut self) -> &mut Part {
        self.parts.last_mut().expect("a file begins with a part")
    }

    /// Begins a part after the last, unless that has no faces yet.
    fn next_part(&mut self) -> &mut Part {
        let last = self.last_part();
        if !last.faces.is_empty() {
            let next = Part::new(last.group.clone(), last.material.clone());
            self.parts.push(next);
        }
        self.last_part()
    }

    /// Reads a face of the last part.
    fn read_face(&mut self, statement: &Statement) -> Result<(), String> {
        let lengths = [
            self.positions.len(),
            self.texcoords.len(),
            self.normals.len(),
        ];
        let face = Face::read(statement, lengths)?;
        self.triangles += face.corners.len() - 2;
        let faces = &mut self.last_part().faces;
        if faces
            .first()
            .is_some_and(|first| first.kinds() != face.kinds())
        {
            return Err(
                "the face has other kinds of indices than the faces before it; give texture coordinates and normals to all \
                 faces of a group and material, or to none"
                    .into(),
            );
        }
        faces.push(face);
        check_count(self.triangles, MAX_TRIANGLES, "triangles")
    }
}

/// Refuses more elements than are allowed.
fn check_count(count: usize, most: usize, what: &str) -> Result<(), String> {
    if count <= most {
        return Ok(());
    }
    Err(format!(
        "the file has more than {most} {what}, as many as are allowed; simplify the mesh, or split it into several files"
    ))
}

/// Reads a position: three numbers, with a weight or a colour, which is not used.
fn read_position(statement: &Statement) -> Result<Vec3, String> {
    let numbers = statement.read_numbers(&[3, 4, 6])?;
    let position = Vec3::from_slice(&numbers);
    let &[_, _, _, weight] = &numbers[..] else {
        return Ok(position);
    };
    if weight == 0.0 {
        return Err("v has the weight 0, which puts it at infinity; leave the weight out".into());
    }
    let position = position / weight;
    if f64::from(position.abs().max_element()) > LARGEST_NUMBER {
        return Err(format!(
            "v has the weight {weight:e}, which puts it beyond {LARGEST_NUMBER:e}; leave the weight out"
        ));
    }
    Ok(position)
}

fn check_material(statement: &Statement, libraries: &Libraries) -> Result<(), String> {
    if libraries.defines(statement.rest) {
        return Ok(());
    }
    Err(format!(
        "usemtl names material \"{}\", which no mtllib above it defines; materials: {}",
        shorten(statement.rest),
        libraries.list_names()
    ))
}
