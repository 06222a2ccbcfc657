//! The meshes and materials of objects; equal ones are shared.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::rc::Rc;

use toml::Spanned;

use super::document::Document;
use super::error::{SceneError, join_names};
use super::files::Files;
use super::key_shapes::{Slot, build_mesh};
use super::material::change_material;
use super::material_list::MaterialList;
use super::mesh_sources::{MeshKey, MeshSource, mesh_key, read_mesh_sources};
use super::obj::ObjFile;
use super::schema::ObjectTable;
use super::texture::Textures;
use super::translucency::Alpha;
use crate::limits::{LARGEST_MESH_FILE, MAX_TRIANGLES};
use crate::{Material, Mesh};

/// Loader of meshes, materials and textures, each once.
pub(super) struct MeshLoader<'a> {
    document: &'a Document,
    folder: &'a Path,
    /// Times that a render may ask for, in frames.
    interval: [f64; 2],
    pub(super) files: Files,
    pub(super) textures: Textures,
    pub(super) materials: MaterialList,
    pub(super) meshes: Vec<Mesh>,
    /// Sentences about what was not read, or is drawn otherwise than its file may mean.
    pub(super) notes: BTreeSet<String>,
    obj_files: BTreeMap<PathBuf, ObjFile>,
    loaded: BTreeMap<MeshKey, Rc<LoadedMesh>>,
    /// Materials of objects that change none, by mesh and by what opacities mean.
    unchanged_materials: BTreeMap<(usize, Alpha), Vec<usize>>,
    triangles: usize,
}

/// Mesh of the scene with the materials of its files.
pub(super) struct LoadedMesh {
    /// Index into the scene's meshes.
    pub(super) index: usize,
    slots: Vec<Slot>,
    /// Number of triangles, by slot.
    pub(super) triangles: Vec<usize>,
    /// Distance of the farthest vertex from the origin, in metres.
    pub(super) radius: f64,
}

impl<'a> MeshLoader<'a> {
    pub(super) fn new(
        document: &'a Document,
        folder: &'a Path,
        files: Files,
        interval: [f64; 2],
    ) -> Self {
        Self {
            document,
            folder,
            interval,
            files,
            textures: Textures::default(),
            materials: MaterialList::default(),
            meshes: Vec::new(),
            notes: BTreeSet::new(),
            obj_files: BTreeMap::new(),
            loaded: BTreeMap::new(),
            unchanged_materials: BTreeMap::new(),
            triangles: 0,
        }
    }

    /// Loads the mesh of an object, and returns it with the indices of its materials.
    pub(super) fn load_object(
        &mut self,
        name: &Spanned<String>,
        table: &ObjectTable,
    ) -> Result<(Rc<LoadedMesh>, Vec<usize>), SceneError> {
        let sources = read_mesh_sources(self.folder, name, table)
            .map_err(|slip| self.document.locate(slip))?;
        for source in &sources {
            self.read_obj(source)?;
            self.check_group(table, &source.path)?;
        }
        let group = table.group.as_ref().map(|group| group.get_ref().as_str());
        let key = mesh_key(&sources, group);
        let mesh = match self.loaded.get(&key) {
            Some(mesh) => mesh.clone(),
            None => {
                let mesh = Rc::new(self.add_mesh(&sources, group)?);
                self.loaded.entry(key).or_insert(mesh).clone()
            }
        };
        let alpha = Alpha::read(table).map_err(|slip| self.document.locate(slip))?;
        let materials = self.load_materials(&mesh, &sources[0], table, alpha)?;
        Ok((mesh, materials))
    }

    /// Adds the materials of an object's mesh, with the changes that its table makes.
    fn load_materials(
        &mut self,
        mesh: &LoadedMesh,
        source: &MeshSource,
        table: &ObjectTable,
        alpha: Alpha,
    ) -> Result<Vec<usize>, SceneError> {
        let key = (mesh.index, alpha);
        let is_unchanged = table.material.is_empty();
        if is_unchanged && let Some(materials) = self.unchanged_materials.get(&key) {
            return Ok(materials.clone());
        }
        let path = source.path.display();
        let mut slots = mesh.slots.clone();
        for (name, changes) in &table.material {
            let mut candidates = slots.iter_mut();
            let Some(slot) = candidates.find(|slot| slot.material.name == *name.get_ref()) else {
                let known = slots.iter().map(|slot| slot.material.name.as_str());
                let reason = format!(
                    "material \"{}\" is not in {path}; materials: {}",
                    name.get_ref(),
                    join_names(known)
                );
                return Err(self.document.error(name.span(), reason));
            };
            change_material(
                self.document,
                &mut self.files,
                &mut self.textures,
                self.folder,
                (changes, alpha.is_blended),
                &mut slot.material,
            )?;
        }
        for slot in &mut slots {
            self.notes.extend(alpha.note(&slot.material, &source.path));
            alpha.apply(&mut slot.material).map_err(|reason| {
                let reason = format!("material \"{}\" of {path} {reason}", slot.material.name);
                self.document.error(source.place.clone(), reason)
            })?;
        }
        for slot in &slots {
            if !slot.textured && has_texture(&slot.material) {
                let reason = format!(
                    "material \"{}\" has a texture, but some faces of {path} that use it have no texture coordinates \
                     (vt); add them, or take the texture away",
                    slot.material.name
                );
                return Err(self.document.error(source.place.clone(), reason));
            }
        }
        let materials: Vec<usize> = slots
            .into_iter()
            .map(|slot| self.materials.add(slot.material))
            .collect();
        if is_unchanged {
            self.unchanged_materials.insert(key, materials.clone());
        }
        Ok(materials)
    }

    /// Adds the mesh of an object to the scene.
    fn add_mesh(
        &mut self,
        sources: &[MeshSource],
        group: Option<&str>,
    ) -> Result<LoadedMesh, SceneError> {
        let first = &self.obj_files[&sources[0].path];
        let parts = first.parts_of(group);
        self.triangles += parts.map(|(_, part)| part.count_triangles()).sum::<usize>();
        if self.triangles > MAX_TRIANGLES {
            let reason = format!(
                "with {} the scene has {} triangles; allowed: {MAX_TRIANGLES}; simplify its meshes",
                sources[0].path.display(),
                self.triangles
            );
            return Err(self.document.error(sources[0].place.clone(), reason));
        }
        let files: Vec<_> = (sources.iter())
            .map(|source| (source.time, &self.obj_files[&source.path]))
            .collect();
        let (mesh, slots) = build_mesh(&files, group)?;
        let mut triangles = vec![0; slots.len()];
        for slot in &mesh.slots {
            triangles[*slot as usize] += 1;
        }
        let loaded = LoadedMesh {
            index: self.meshes.len(),
            slots,
            triangles,
            radius: farthest_vertex(&mesh, self.interval),
        };
        self.meshes.push(mesh);
        Ok(loaded)
    }

    fn read_obj(&mut self, source: &MeshSource) -> Result<(), SceneError> {
        let path = &source.path;
        if !self.obj_files.contains_key(path) {
            let text = self.files.read_text(path, LARGEST_MESH_FILE);
            let text = text.map_err(|error| {
                let reason = format!("mesh {} cannot be read: {error}", path.display());
                self.document.error(source.place.clone(), reason)
            })?;
            let obj = ObjFile::read(&mut self.files, &mut self.textures, path, &text)?;
            self.notes.extend(obj.notes.iter().cloned());
            self.obj_files.insert(path.clone(), obj);
        }
        Ok(())
    }

    fn check_group(&self, table: &ObjectTable, path: &Path) -> Result<(), SceneError> {
        let obj = &self.obj_files[path];
        if let Some(group) = &table.group
            && obj.parts_of(Some(group.get_ref())).next().is_none()
        {
            let reason = format!(
                "group \"{}\" is not in {}; groups: {}",
                group.get_ref(),
                path.display(),
                join_names(obj.groups())
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

/// Finds the distance of the farthest vertex from the origin over an interval of time.
fn farthest_vertex(mesh: &Mesh, [from, to]: [f64; 2]) -> f64 {
    let mut times = vec![from];
    if mesh.deforms() {
        // Vertices move in straight lines from shape to shape.
        times.extend(mesh.shape_times().filter(|time| from < *time && *time < to));
        times.push(to);
    }
    let radii = times.into_iter().map(|time| mesh.at(time).radius());
    radii.fold(0.0, f64::max)
}
