//! The objects of a scene.toml with their meshes and materials.

use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::Spanned;

use super::document::Document;
use super::error::{SceneError, is_name, list};
use super::files::Files;
use super::material::override_material;
use super::obj::ObjFile;
use super::pose::object_motion;
use super::schema::ObjectTable;
use super::shapes::deforming_mesh;
use super::texture::Textures;
use crate::{Material, Mesh, Object, Parent};

/// Names that mean something else where objects are named.
const RESERVED: [&str; 2] = ["background", "camera"];

/// Objects and all that they share.
pub(super) struct Stage<'a> {
    document: &'a Document,
    folder: &'a Path,
    pub(super) files: Files,
    pub(super) textures: Textures,
    pub(super) materials: Vec<Material>,
    pub(super) meshes: Vec<Mesh>,
    pub(super) objects: Vec<Object>,
    obj_files: BTreeMap<PathBuf, ObjFile>,
    mesh_keys: Vec<MeshKey>,
}

/// An OBJ file that an object names.
struct Source {
    path: PathBuf,
    /// Frames; of a mesh that has one shape it means nothing.
    time: f64,
    /// Where it is named.
    place: Range<usize>,
}

/// What a mesh is made of: equal keys, equal meshes.
#[derive(PartialEq)]
struct MeshKey {
    /// With the times of their shapes.
    files: Vec<(PathBuf, f64)>,
    group: Option<String>,
}

impl<'a> Stage<'a> {
    pub(super) fn new(document: &'a Document, folder: &'a Path, files: Files) -> Self {
        Self {
            document,
            folder,
            files,
            textures: Textures::default(),
            materials: Vec::new(),
            meshes: Vec::new(),
            objects: Vec::new(),
            obj_files: BTreeMap::new(),
            mesh_keys: Vec::new(),
        }
    }

    /// Adds every object, in the order of the file.
    pub(super) fn add_objects(
        &mut self,
        tables: &BTreeMap<Spanned<String>, ObjectTable>,
    ) -> Result<(), SceneError> {
        let mut in_file_order: Vec<_> = tables.iter().collect();
        in_file_order.sort_by_key(|(name, _)| name.span().start);
        let names: Vec<&str> = in_file_order
            .iter()
            .map(|(name, _)| name.get_ref().as_str())
            .collect();
        for (name, table) in &in_file_order {
            self.check_name(name)?;
            let parent = self.parent(name.get_ref(), table, &names, tables)?;
            let motion = object_motion(self.document, name.get_ref(), table)?;
            let (mesh, materials) = self.surface(name, table)?;
            self.objects.push(Object {
                name: name.get_ref().clone(),
                mesh,
                materials,
                motion,
                parent,
            });
        }
        Ok(())
    }

    fn check_name(&self, name: &Spanned<String>) -> Result<(), SceneError> {
        let word = name.get_ref();
        if !is_name(word) {
            let reason = format!("object name \"{word}\": allowed are letters, digits, _ and -");
            return Err(self.document.error(name.span(), reason));
        }
        if RESERVED.contains(&word.as_str()) {
            let reason = format!("object name \"{word}\" is taken; choose another name");
            return Err(self.document.error(name.span(), reason));
        }
        Ok(())
    }

    fn parent(
        &self,
        name: &str,
        table: &ObjectTable,
        names: &[&str],
        tables: &BTreeMap<Spanned<String>, ObjectTable>,
    ) -> Result<Parent, SceneError> {
        let Some(parent) = &table.parent else {
            return Ok(Parent::World);
        };
        if parent.get_ref() == "camera" {
            return Ok(Parent::Camera);
        }
        let fail = |reason| Err(self.document.error(parent.span(), reason));
        if !names.contains(&parent.get_ref().as_str()) {
            return fail(format!(
                "object \"{name}\" has the parent \"{}\", which the scene lacks; allowed: camera, {}",
                parent.get_ref(),
                list(names.iter().copied().filter(|other| *other != name))
            ));
        }
        let mut chain = vec![name];
        let mut next = Some(parent);
        while let Some(ancestor) = next {
            let ancestor = ancestor.get_ref().as_str();
            let seen = chain.contains(&ancestor);
            chain.push(ancestor);
            if seen {
                return fail(format!(
                    "objects are each other's parents: {}; one of them must have another parent or none",
                    chain.join(" -> ")
                ));
            }
            next = tables.get(ancestor).and_then(|table| table.parent.as_ref());
        }
        let earlier = self
            .objects
            .iter()
            .position(|o| o.name == *parent.get_ref());
        match earlier {
            Some(index) => Ok(Parent::Object(index)),
            None => fail(format!(
                "object \"{name}\" stands before its parent \"{}\"; move the parent above it",
                parent.get_ref()
            )),
        }
    }

    /// Mesh and materials of an object, shared with others where they are the same.
    fn surface(
        &mut self,
        name: &Spanned<String>,
        table: &ObjectTable,
    ) -> Result<(usize, Vec<usize>), SceneError> {
        let sources = self.sources(name, table)?;
        for source in &sources {
            self.read_obj(source)?;
            self.check_group(table, &source.path)?;
        }
        let group = table.group.as_ref().map(|group| group.get_ref().as_str());
        let path = &sources[0].path;
        let place = sources[0].place.clone();
        let (mesh, mut slots) = if table.shapes.is_none() {
            self.obj_files[path].mesh(group)?
        } else {
            let shapes: Vec<_> = sources
                .iter()
                .map(|source| (source.time, &self.obj_files[&source.path]))
                .collect();
            deforming_mesh(&shapes, group)?
        };
        for (name, changes) in &table.material {
            let slot = slots
                .iter_mut()
                .find(|s| s.material.name == *name.get_ref());
            let Some(slot) = slot else {
                let known = slots.iter().map(|slot| slot.material.name.as_str());
                let reason = format!(
                    "material \"{}\" is not in {}; materials: {}",
                    name.get_ref(),
                    path.display(),
                    list(known)
                );
                return Err(self.document.error(name.span(), reason));
            };
            override_material(
                self.document,
                &mut self.files,
                &mut self.textures,
                self.folder,
                changes,
                &mut slot.material,
            )?;
        }
        for slot in &slots {
            if !slot.textured && has_texture(&slot.material) {
                let reason = format!(
                    "material \"{}\" has a texture, but faces of {} that use it have no texture coordinates (vt)",
                    slot.material.name,
                    path.display()
                );
                return Err(self.document.error(place, reason));
            }
        }
        let materials = slots
            .into_iter()
            .map(|slot| index_of(&mut self.materials, slot.material))
            .collect();
        let key = MeshKey {
            files: (sources.iter())
                .map(|source| (source.path.clone(), source.time))
                .collect(),
            group: group.map(str::to_owned),
        };
        let known = self.mesh_keys.iter().position(|other| *other == key);
        let mesh = known.unwrap_or_else(|| {
            self.mesh_keys.push(key);
            self.meshes.push(mesh);
            self.meshes.len() - 1
        });
        Ok((mesh, materials))
    }

    /// The OBJ files that an object names: one, or its key shapes at rising times.
    fn sources(
        &self,
        name: &Spanned<String>,
        table: &ObjectTable,
    ) -> Result<Vec<Source>, SceneError> {
        let what = format!("object \"{}\"", name.get_ref());
        let source = |time: f64, mesh: &Spanned<String>| Source {
            path: self.folder.join(mesh.get_ref()),
            time,
            place: mesh.span(),
        };
        let shapes = match (&table.mesh, &table.shapes) {
            (Some(mesh), None) => return Ok(vec![source(0.0, mesh)]),
            (None, Some(shapes)) => shapes,
            (None, None) => {
                let reason = format!("{what} has no mesh; give it a mesh or, to deform, shapes");
                return Err(self.document.error(name.span(), reason));
            }
            (Some(_), Some(shapes)) => {
                let reason = format!("{what} has both a mesh and shapes; give one or the other");
                return Err(self.document.error(shapes.span(), reason));
            }
        };
        if shapes.get_ref().len() < 2 {
            let reason = format!(
                "{what} has {} shapes; allowed: 2 and more at rising times, or a mesh in their place",
                shapes.get_ref().len()
            );
            return Err(self.document.error(shapes.span(), reason));
        }
        for pair in shapes.get_ref().windows(2) {
            let [from, to] = [&pair[0].time, &pair[1].time];
            if to.get_ref() <= from.get_ref() {
                let reason = format!(
                    "{what} has a shape at time {} after one at {}; times must rise",
                    to.get_ref(),
                    from.get_ref()
                );
                return Err(self.document.error(to.span(), reason));
            }
        }
        let shapes = shapes.get_ref().iter();
        Ok(shapes
            .map(|shape| source(*shape.time.get_ref(), &shape.mesh))
            .collect())
    }

    fn read_obj(&mut self, source: &Source) -> Result<(), SceneError> {
        let path = &source.path;
        if !self.obj_files.contains_key(path) {
            let obj = ObjFile::read(&mut self.files, &mut self.textures, path);
            let obj = obj.map_err(|error| {
                let reason = format!("mesh {} cannot be read: {error}", path.display());
                self.document.error(source.place.clone(), reason)
            })??;
            self.obj_files.insert(path.clone(), obj);
        }
        Ok(())
    }

    fn check_group(&self, table: &ObjectTable, path: &Path) -> Result<(), SceneError> {
        let obj = &self.obj_files[path];
        if let Some(group) = &table.group
            && !obj.groups().contains(&group.get_ref().as_str())
        {
            let reason = format!(
                "group \"{}\" is not in {}; groups: {}",
                group.get_ref(),
                path.display(),
                list(obj.groups())
            );
            return Err(self.document.error(group.span(), reason));
        }
        Ok(())
    }
}

fn has_texture(material: &Material) -> bool {
    material.diffuse_texture.is_some()
        || material.emission_texture.is_some()
        || material.opacity_texture.is_some()
}

/// Index of a material in the scene, added if no equal one is there.
fn index_of(materials: &mut Vec<Material>, material: Material) -> usize {
    let known = materials.iter().position(|other| *other == material);
    known.unwrap_or_else(|| {
        materials.push(material);
        materials.len() - 1
    })
}
