//! The scene made ready for rays: one tree over all that stands still, and one per mesh that moves.

use glam::DVec3;

#[cfg(target_arch = "x86_64")]
use crate::accel::lanes::Avx2;
use crate::accel::lanes::{Lanes, Portable};
use crate::accel::mesh_tree::Geometry;
use crate::accel::world_leaves::joining;
use crate::accel::world_tree::WorldTree;
use crate::geometry::aabb::Bounds;
use crate::geometry::ray::Ray;
use crate::light::sky::Sky;
use crate::material::glossy_material::Gloss;
use crate::material::surface::{Opacity, Surface};
use crate::motion::poses::Poses;
use crate::motion::slices::slices;
use crate::scene::Scene;
use crate::settings::{LARGEST_REACH, TraceError};

/// A scene between two times, ready for rays.
///
/// Objects that stand still lie in one tree, leaf by leaf. The shutter is cut into slices, each with its own small tree over
/// the topmost nodes of that one and the boxes that moving objects sweep. A ray is moved into an object's space by the exact
/// pose at its time; nothing about the motion is linearised.
pub struct Stage<'a> {
    pub(crate) scene: &'a Scene,
    /// Per mesh of the scene; none where no object shows it.
    meshes: Vec<Option<Geometry<'a>>>,
    pub(crate) world: WorldTree,
    pub(crate) opacities: Vec<Opacity>,
    /// Per material of the scene.
    glosses: Vec<Option<Gloss>>,
    sky: Sky<'a>,
    /// Room for the children that wait while a ray is in another.
    pub(crate) most_waiting: usize,
    poses: Poses<'a>,
    traversal: Traversal,
}

/// Which instructions find the hits; all find the same.
enum Traversal {
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    Portable,
}

/// Where a ray meets a surface first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance in units of the ray's direction.
    pub t: f64,
    /// Index into the scene's objects.
    pub object: usize,
    /// Index into the mesh's triangles.
    pub triangle: u32,
    /// Weights of the triangle's second and third vertex.
    pub weights: [f64; 2],
    /// Frames relative to the instant: where a deforming mesh is met depends on it.
    pub time: f64,
}

impl<'a> Stage<'a> {
    /// Makes the scene ready for rays whose times lie in `[from, to]` (frames); ends the program where [`Stage::checked`] refuses.
    pub fn new(scene: &'a Scene, from: f64, to: f64) -> Self {
        Self::checked(scene, from, to).expect("no object reaches too far")
    }

    /// Makes the scene ready for rays whose times lie in `[from, to]` (frames). Refuses objects that reach farther than
    /// [`LARGEST_REACH`].
    pub fn checked(scene: &'a Scene, from: f64, to: f64) -> Result<Self, TraceError> {
        assert!(from <= to, "a stage's interval runs forwards in time");
        let slices = slices(scene, from, to);
        check_reach(scene, &slices)?;
        let shown: Vec<usize> = scene.objects.iter().map(|object| object.mesh).collect();
        let mut meshes: Vec<Option<Geometry>> = scene
            .meshes
            .iter()
            .enumerate()
            .map(|(index, mesh)| shown.contains(&index).then(|| Geometry::of(mesh, from, to)))
            .collect();
        let mut poses = Poses::new(scene, from, to);
        let swept = slices.iter().flatten().map(|bounds| bounds.reach());
        let joining = joining(scene, &meshes, &mut poses, swept.fold(0.0, f64::max));
        let world = WorldTree::over(&joining, &slices, [from, to]);
        for (mesh, geometry) in meshes.iter_mut().enumerate() {
            let walked = (joining.iter().zip(&shown))
                .any(|(leaves, shown)| *shown == mesh && leaves.is_none());
            if let (Some(Geometry::Rigid(tree)), false) = (geometry, walked) {
                tree.drop_tree();
            }
        }
        let in_meshes = meshes.iter().flatten().map(Geometry::most_waiting).max();
        Ok(Self {
            scene,
            most_waiting: world.most_waiting() + in_meshes.unwrap_or(0),
            meshes,
            world,
            opacities: Opacity::of_objects(scene),
            sky: Sky::of(&scene.background),
            glosses: scene.materials.iter().map(Gloss::of).collect(),
            poses,
            traversal: Traversal::best(),
        })
    }

    /// Whether nothing in the world changes its place or shape.
    pub(crate) fn stands_still(&self) -> bool {
        let mut objects = self.scene.objects.iter().enumerate();
        objects.all(|(index, object)| {
            self.poses.stands_still(index) && !self.scene.meshes[object.mesh].deforms()
        })
    }

    /// Whether all surfaces look the same from everywhere.
    pub(crate) fn is_diffuse(&self) -> bool {
        self.glosses.iter().all(Option::is_none)
    }

    /// The gloss of a material; none where it is diffuse.
    pub(crate) fn gloss(&self, material: usize) -> Option<&Gloss> {
        self.glosses[material].as_ref()
    }

    /// The background as a light.
    pub(crate) fn sky(&self) -> &Sky<'a> {
        &self.sky
    }

    /// A store of poses for one path at a time.
    pub fn poses(&self) -> Poses<'a> {
        self.poses.clone()
    }

    /// The nearest surface at `t > 0`; among equally near ones that of the lowest object, then triangle.
    pub fn closest(&self, poses: &mut Poses, ray: &Ray) -> Option<Hit> {
        match self.traversal {
            #[cfg(target_arch = "x86_64")]
            Traversal::Avx2(lanes) => lanes.run(
                #[inline(always)]
                || self.closest_by(lanes, poses, ray),
            ),
            Traversal::Portable => self.closest_by(Portable, poses, ray),
        }
    }

    /// Whether anything lies at `0 < t < limit`.
    pub fn blocked(&self, poses: &mut Poses, ray: &Ray, limit: f64) -> bool {
        match self.traversal {
            #[cfg(target_arch = "x86_64")]
            Traversal::Avx2(lanes) => lanes.run(
                #[inline(always)]
                || self.blocked_by(lanes, poses, ray, limit),
            ),
            Traversal::Portable => self.blocked_by(Portable, poses, ray, limit),
        }
    }

    /// The same stage, walked without the processor's wide instructions: for comparison.
    pub fn portable(mut self) -> Self {
        self.traversal = Traversal::Portable;
        self
    }

    /// Which instructions find the hits: `avx2` or `portable`.
    pub fn traversal(&self) -> &'static str {
        match self.traversal {
            #[cfg(target_arch = "x86_64")]
            Traversal::Avx2(_) => "avx2",
            Traversal::Portable => "portable",
        }
    }

    /// Bytes that trees and triangles take.
    pub fn bytes(&self) -> usize {
        let meshes: usize = self.meshes.iter().flatten().map(Geometry::bytes).sum();
        meshes + self.world.bytes()
    }

    /// The unit normal of the facet that a ray met, on the ray's side.
    pub fn facet(&self, poses: &mut Poses, ray: &Ray, hit: &Hit) -> DVec3 {
        Surface::at(self.scene, poses.pose(hit.object), ray, hit).facet
    }

    /// What [`Stage::closest`] finds, from every triangle in turn: its reference in tests.
    pub fn closest_of_all(&self, poses: &mut Poses, ray: &Ray) -> Option<Hit> {
        let time = poses.time();
        let mut best = None;
        for object in 0..self.scene.objects.len() {
            let local = ray.transformed(&poses.pose(object).to_object);
            self.mesh(object)
                .exhaustive(&local, time, |triangle, crossing| {
                    self.keep_nearer(&mut best, time, object, triangle, crossing);
                });
        }
        best
    }

    #[inline(always)]
    pub(crate) fn mesh(&self, object: usize) -> &Geometry<'a> {
        self.meshes[self.scene.objects[object].mesh]
            .as_ref()
            .expect("every shown mesh has a tree")
    }
}

/// Refuses objects whose swept boxes, or whose meshes in their own space, reach too far.
fn check_reach(scene: &Scene, slices: &[Vec<Bounds>]) -> Result<(), TraceError> {
    let own: Vec<f64> = (scene.meshes.iter())
        .map(|mesh| {
            let shapes = mesh.shapes.iter().flat_map(|shape| &shape.positions);
            let positions = mesh.positions.iter().chain(shapes);
            positions.fold(0.0, |reach: f64, position| {
                reach.max(f64::from(position.abs().max_element()))
            })
        })
        .collect();
    for (index, object) in scene.objects.iter().enumerate() {
        let swept = slices.iter().map(|swept| swept[index]);
        let corners = swept.flat_map(|swept| [swept.min, swept.max]);
        let mut reaches = corners.map(|corner| match corner.is_finite() {
            true => corner.abs().max_element(),
            false => f64::INFINITY,
        });
        let too_far = |reach: &f64| *reach > LARGEST_REACH;
        if let Some(reach) = reaches
            .find(too_far)
            .or(Some(own[object.mesh]).filter(too_far))
        {
            return Err(TraceError::Reach {
                scene: scene.name.clone(),
                object: object.name.clone(),
                reach,
            });
        }
    }
    Ok(())
}

impl Traversal {
    /// The fastest that the processor has.
    fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        if let Some(lanes) = Avx2::detect() {
            return Traversal::Avx2(lanes);
        }
        Traversal::Portable
    }
}
