//! The meshes and materials of objects, shared where they are the same.

use std::ops::Range;
use std::path::{Path, PathBuf};

use glam::DVec3;
use toml::Spanned;

use super::error::{SceneError, list};
use super::material::override_material;
use super::obj::{ObjFile, Slot};
use super::objects::Stage;
use super::pose::check_gap;
use super::schema::ObjectTable;
use super::shapes::deforming_mesh;
use crate::limits::{MOST_KEYS, MOST_TRIANGLES};
use crate::{Material, Mesh};

/// A mesh that is in the scene, as its files have it.
#[derive(Clone)]
pub(super) struct Surface {
    /// Index into the scene's meshes.
    pub(super) mesh: usize,
    slots: Vec<Slot>,
    /// Per slot.
    pub(super) triangles: Vec<usize>,
    /// The farthest vertex's distance from the origin, in metres.
    pub(super) radius: f64,
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
#[derive(PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct MeshKey {
    /// With the times of their shapes, as bits.
    files: Vec<(PathBuf, u64)>,
    group: Option<String>,
}

impl MeshKey {
    fn of(sources: &[Source], group: Option<&str>) -> Self {
        // 0 and -0 are one time.
        let bits = |source: &Source| (source.path.clone(), (source.time + 0.0).to_bits());
        Self {
            files: sources.iter().map(bits).collect(),
            group: group.map(str::to_owned),
        }
    }
}

impl Stage<'_> {
    /// Mesh and materials of an object, shared with others where they are the same.
    pub(super) fn surface(
        &mut self,
        name: &Spanned<String>,
        table: &ObjectTable,
    ) -> Result<(Surface, Vec<usize>), SceneError> {
        let sources = self.sources(name, table)?;
        for source in &sources {
            self.read_obj(source)?;
            self.check_group(table, &source.path)?;
        }
        let group = table.group.as_ref().map(|group| group.get_ref().as_str());
        let path = &sources[0].path;
        let place = sources[0].place.clone();
        let key = MeshKey::of(&sources, group);
        let surface = match self.surfaces.get(&key) {
            Some(surface) => surface.clone(),
            None => {
                let surface = self.add_mesh(&sources, table, group)?;
                self.surfaces.entry(key).or_insert(surface).clone()
            }
        };
        let mut slots = surface.slots.clone();
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
            .map(|slot| self.index_of(slot.material))
            .collect();
        Ok((surface, materials))
    }

    /// Adds the mesh of an object to the scene.
    fn add_mesh(
        &mut self,
        sources: &[Source],
        table: &ObjectTable,
        group: Option<&str>,
    ) -> Result<Surface, SceneError> {
        let first = &self.obj_files[&sources[0].path];
        let parts = first.parts_of(group);
        self.triangles += parts.map(|part| part.indices.len() / 3).sum::<usize>();
        if self.triangles > MOST_TRIANGLES {
            let reason = format!(
                "with {} the scene has {} triangles; allowed: {MOST_TRIANGLES}; simplify its meshes",
                sources[0].path.display(),
                self.triangles
            );
            return Err(self.document.error(sources[0].place.clone(), reason));
        }
        let (mesh, slots) = if table.shapes.is_none() {
            first.mesh(group)?
        } else {
            let shapes: Vec<_> = sources
                .iter()
                .map(|source| (source.time, &self.obj_files[&source.path]))
                .collect();
            deforming_mesh(&shapes, group)?
        };
        let mut triangles = vec![0; slots.len()];
        for slot in &mesh.slots {
            triangles[*slot as usize] += 1;
        }
        let surface = Surface {
            mesh: self.meshes.len(),
            slots,
            triangles,
            radius: radius(&mesh, self.interval),
        };
        self.meshes.push(mesh);
        Ok(surface)
    }

    /// Index of a material in the scene, added if no equal one is there.
    fn index_of(&mut self, material: Material) -> usize {
        let named = self
            .materials_by_name
            .entry(material.name.clone())
            .or_default();
        let known = named
            .iter()
            .find(|index| self.materials[**index] == material);
        known.copied().unwrap_or_else(|| {
            named.push(self.materials.len());
            self.materials.push(material);
            self.materials.len() - 1
        })
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
        if shapes.get_ref().len() > MOST_KEYS {
            let reason = format!(
                "{what} has {} shapes; allowed: 2 to {MOST_KEYS}; leave out those that lie between others",
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
            let times = [*from.get_ref(), *to.get_ref()];
            check_gap(self.document, &what, "shapes", times, to.span())?;
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
            && obj.parts_of(Some(group.get_ref())).next().is_none()
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

/// The farthest vertex's distance from the origin within an interval of time.
fn radius(mesh: &Mesh, [from, to]: [f64; 2]) -> f64 {
    let mut times = vec![from];
    if mesh.deforms() {
        // Vertices go straight from shape to shape.
        times.extend(mesh.shape_times().filter(|time| from < *time && *time < to));
        times.push(to);
    }
    times
        .into_iter()
        .map(|time| {
            let positions = mesh.at(time).positions();
            positions.map(DVec3::length).fold(0.0, f64::max)
        })
        .fold(0.0, f64::max)
}
