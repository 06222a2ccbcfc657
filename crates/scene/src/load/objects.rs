//! The objects of a scene.toml.

use std::collections::BTreeMap;

use toml::Spanned;

use super::document::Document;
use super::error::{SceneError, check_name};
use super::meshes::{LoadedMesh, MeshLoader};
use super::object_motion::read_object_motion;
use super::parents::OrderedObjects;
use super::schema::{CameraTable, ObjectTable};
use super::transform_range::TransformRange;
use crate::limits::{MAX_EMISSIVE_TRIANGLES, MAX_PARENTS};
use crate::{Camera, Motion, Object, Parent};

/// Names that mean something else where objects are named.
const RESERVED: [&str; 2] = ["background", "camera"];

/// Loader of objects, with everything that they share.
pub(super) struct ObjectLoader<'a> {
    document: &'a Document,
    /// Times that a render may ask for, in frames.
    interval: [f64; 2],
    pub(super) meshes: MeshLoader<'a>,
    pub(super) objects: Vec<Object>,
    /// Placement of each object.
    placements: Vec<Placement>,
    emissive_triangles: usize,
}

/// Place of an object below its parents.
#[derive(Clone, Copy)]
struct Placement {
    /// Range of the object's motion and its parents'.
    range: TransformRange,
    /// Number of parents, and parents of parents.
    ancestors: usize,
}

impl<'a> ObjectLoader<'a> {
    pub(super) fn new(document: &'a Document, meshes: MeshLoader<'a>, interval: [f64; 2]) -> Self {
        Self {
            document,
            interval,
            meshes,
            objects: Vec::new(),
            placements: Vec::new(),
            emissive_triangles: 0,
        }
    }

    /// Adds every object, in the order of the file.
    pub(super) fn add_objects(
        &mut self,
        camera_table: &Spanned<CameraTable>,
        camera: &Camera,
        tables: &BTreeMap<Spanned<String>, ObjectTable>,
    ) -> Result<(), SceneError> {
        let camera_range = TransformRange::new(&camera.motion, self.interval);
        camera_range
            .check("the camera", 0.0)
            .map_err(|reason| self.document.error(camera_table.span(), reason))?;
        let ordered = OrderedObjects::new(tables);
        for (index, (name, table)) in ordered.tables.iter().enumerate() {
            self.check_object_name(name)?;
            let locate = |slip| self.document.locate(slip);
            let parent = ordered.read_parent(index).map_err(locate)?;
            let motion = read_object_motion(name.get_ref(), table).map_err(locate)?;
            let placement = self.place_object(name, &motion, parent, camera_range)?;
            let (mesh, materials) = self.meshes.load_object(name, table)?;
            self.check_object(name, &placement, &mesh, &materials)?;
            self.placements.push(placement);
            self.objects.push(Object {
                name: name.get_ref().clone(),
                mesh: mesh.index,
                materials,
                motion,
                parent,
            });
        }
        Ok(())
    }

    /// Places an object below its parent.
    fn place_object(
        &self,
        name: &Spanned<String>,
        motion: &Motion,
        parent: Parent,
        camera_range: TransformRange,
    ) -> Result<Placement, SceneError> {
        let (outer, ancestors) = match parent {
            Parent::World => (TransformRange::STILL, 0),
            Parent::Camera => (camera_range, 0),
            Parent::Object(index) => {
                let parent = self.placements[index];
                (parent.range, parent.ancestors + 1)
            }
        };
        if ancestors > MAX_PARENTS {
            let reason = format!(
                "object \"{}\" has {ancestors} parents above it; allowed: {MAX_PARENTS}; attach it to one nearer to \
                 the world",
                name.get_ref()
            );
            return Err(self.document.error(name.span(), reason));
        }
        Ok(Placement {
            range: TransformRange::new(motion, self.interval).within(outer),
            ancestors,
        })
    }

    /// Checks the limits that depend on the mesh of an object.
    fn check_object(
        &mut self,
        name: &Spanned<String>,
        placement: &Placement,
        mesh: &LoadedMesh,
        materials: &[usize],
    ) -> Result<(), SceneError> {
        let what = format!("object \"{}\"", name.get_ref());
        placement
            .range
            .check(&what, mesh.radius)
            .map_err(|reason| self.document.error(name.span(), reason))?;
        for (material, triangles) in materials.iter().zip(&mesh.triangles) {
            if self.meshes.materials.list[*material].emission.max_element() > 0.0 {
                self.emissive_triangles += triangles;
            }
        }
        if self.emissive_triangles > MAX_EMISSIVE_TRIANGLES {
            let reason = format!(
                "with {what} the scene has {} triangles that emit; allowed: {MAX_EMISSIVE_TRIANGLES}; simplify the \
                 meshes of its lights",
                self.emissive_triangles
            );
            return Err(self.document.error(name.span(), reason));
        }
        Ok(())
    }

    fn check_object_name(&self, name: &Spanned<String>) -> Result<(), SceneError> {
        let text = name.get_ref().as_str();
        let checked = check_name(text).and_then(|()| {
            if RESERVED.contains(&text) {
                Err(format!("name \"{text}\" is reserved; choose another name"))
            } else {
                Ok(())
            }
        });
        checked.map_err(|reason| self.document.error(name.span(), format!("object {reason}")))
    }
}
