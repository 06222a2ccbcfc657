//! The objects of a scene.toml with their meshes and materials.

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};

use toml::Spanned;

use super::document::Document;
use super::error::{SceneError, is_name};
use super::files::Files;
use super::obj::ObjFile;
use super::parents::parent;
use super::pose::object_motion;
use super::reach::Reach;
use super::schema::{CameraTable, ObjectTable};
use super::surfaces::{MeshKey, Surface};
use super::texture::Textures;
use crate::limits::{MOST_EMISSIVE_TRIANGLES, MOST_PARENTS};
use crate::{Camera, Material, Mesh, Motion, Object, Parent};

/// Names that mean something else where objects are named.
const RESERVED: [&str; 2] = ["background", "camera"];

/// Objects and all that they share.
pub(super) struct Stage<'a> {
    pub(super) document: &'a Document,
    pub(super) folder: &'a Path,
    /// Times that a render may ask for, in frames.
    pub(super) interval: [f64; 2],
    pub(super) files: Files,
    pub(super) textures: Textures,
    pub(super) materials: Vec<Material>,
    pub(super) meshes: Vec<Mesh>,
    pub(super) objects: Vec<Object>,
    pub(super) obj_files: BTreeMap<PathBuf, ObjFile>,
    pub(super) surfaces: BTreeMap<MeshKey, Surface>,
    pub(super) materials_by_name: HashMap<String, Vec<usize>>,
    /// Per object, with all its parents.
    carried: Vec<Carried>,
    pub(super) triangles: usize,
    emissive_triangles: usize,
}

/// What carries an object.
#[derive(Clone, Copy)]
struct Carried {
    reach: Reach,
    /// Objects above it.
    parents: usize,
}

impl<'a> Stage<'a> {
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
            materials: Vec::new(),
            meshes: Vec::new(),
            objects: Vec::new(),
            obj_files: BTreeMap::new(),
            surfaces: BTreeMap::new(),
            materials_by_name: HashMap::new(),
            carried: Vec::new(),
            triangles: 0,
            emissive_triangles: 0,
        }
    }

    /// Adds every object, in the order of the file.
    pub(super) fn add_objects(
        &mut self,
        place: &Spanned<CameraTable>,
        camera: &Camera,
        tables: &BTreeMap<Spanned<String>, ObjectTable>,
    ) -> Result<(), SceneError> {
        let camera = Reach::of(&camera.motion, self.interval);
        if let Some(reason) = camera.amiss("the camera", 0.0) {
            return Err(self.document.error(place.span(), reason));
        }
        let mut in_file_order: Vec<_> = tables.iter().collect();
        in_file_order.sort_by_key(|(name, _)| name.span().start);
        let places: HashMap<&str, usize> = (in_file_order.iter().enumerate())
            .map(|(index, (name, _))| (name.get_ref().as_str(), index))
            .collect();
        for (name, table) in &in_file_order {
            self.check_name(name)?;
            let above = self.objects.len();
            let parent = parent(
                self.document,
                above,
                name.get_ref(),
                table,
                &in_file_order,
                &places,
            )?;
            let motion = object_motion(self.document, name.get_ref(), table)?;
            let carried = self.carried(name, &motion, parent, camera)?;
            let (surface, materials) = self.surface(name, table)?;
            self.check_object(name, &carried, &surface, &materials)?;
            self.carried.push(carried);
            self.objects.push(Object {
                name: name.get_ref().clone(),
                mesh: surface.mesh,
                materials,
                motion,
                parent,
            });
        }
        Ok(())
    }

    fn carried(
        &self,
        name: &Spanned<String>,
        motion: &Motion,
        parent: Parent,
        camera: Reach,
    ) -> Result<Carried, SceneError> {
        let (outer, parents) = match parent {
            Parent::World => (Reach::WORLD, 0),
            Parent::Camera => (camera, 0),
            Parent::Object(index) => (self.carried[index].reach, self.carried[index].parents + 1),
        };
        if parents > MOST_PARENTS {
            let reason = format!(
                "object \"{}\" has {parents} parents above it; allowed: {MOST_PARENTS}; attach it to one nearer to \
                 the world",
                name.get_ref()
            );
            return Err(self.document.error(name.span(), reason));
        }
        Ok(Carried {
            reach: Reach::of(motion, self.interval).within(outer),
            parents,
        })
    }

    /// What can be told once the mesh is known.
    fn check_object(
        &mut self,
        name: &Spanned<String>,
        carried: &Carried,
        surface: &Surface,
        materials: &[usize],
    ) -> Result<(), SceneError> {
        let what = format!("object \"{}\"", name.get_ref());
        if let Some(reason) = carried.reach.amiss(&what, surface.radius) {
            return Err(self.document.error(name.span(), reason));
        }
        for (material, triangles) in materials.iter().zip(&surface.triangles) {
            if self.materials[*material].emission.max_element() > 0.0 {
                self.emissive_triangles += triangles;
            }
        }
        if self.emissive_triangles > MOST_EMISSIVE_TRIANGLES {
            let reason = format!(
                "with {what} the scene has {} triangles that emit; allowed: {MOST_EMISSIVE_TRIANGLES}; simplify the \
                 meshes of its lights",
                self.emissive_triangles
            );
            return Err(self.document.error(name.span(), reason));
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
}
