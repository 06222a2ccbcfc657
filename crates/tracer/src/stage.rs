//! A scene prepared for rays.

use bvh::{Lanes, Portable, Ray};
use glam::{DVec3, Vec3};
use scene::{Material, Scene};

use crate::accel::scene_tree::SceneTree;
use crate::error::TraceError;
use crate::hit::Hit;
use crate::light::sky::Sky;
use crate::material::glossy_material::GlossyMaterial;
use crate::material::passage::Passage;
use crate::material::surface::{Sight, Surface};
use crate::motion::poses::Poses;
#[cfg(target_arch = "x86_64")]
use bvh::Avx2;

/// A scene between two times, prepared for rays.
///
/// A ray is transformed into an object's space by the exact pose at its time; motion is not
/// linearised.
pub struct Stage<'a> {
    pub(crate) scene: &'a Scene,
    tree: SceneTree<'a>,
    /// Glossy part of each material of the scene; none if it is diffuse.
    pub(crate) glossy_materials: Vec<Option<GlossyMaterial>>,
    /// Background as a light.
    pub(crate) sky: Sky<'a>,
    poses: Poses<'a>,
    traversal: Traversal,
    /// True if any surface is translucent.
    pub(crate) has_translucency: bool,
}

/// The instructions that traverse the trees. All find the same hits.
enum Traversal {
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    Portable,
}

/// Runs a query of the tree of a stage by its instructions.
macro_rules! traverse {
    ($stage:ident.$query:ident($($argument:ident),*)) => {
        match $stage.traversal {
            #[cfg(target_arch = "x86_64")]
            Traversal::Avx2(lanes) => lanes.run(
                #[inline(always)]
                || $stage.tree.$query(lanes, $($argument),*),
            ),
            Traversal::Portable => $stage.tree.$query(Portable, $($argument),*),
        }
    };
}

impl<'a> Stage<'a> {
    /// Prepares the scene for rays at times in `[from, to]` (frames). Panics if [`Stage::try_new`]
    /// refuses.
    pub fn new(scene: &'a Scene, from: f64, to: f64) -> Self {
        Self::try_new(scene, from, to).expect("no object is too far away")
    }

    /// Prepares the scene for rays at times in `[from, to]` (frames). Refuses objects with
    /// coordinates above [`LARGEST_COORDINATE`](crate::limits::LARGEST_COORDINATE).
    pub fn try_new(scene: &'a Scene, from: f64, to: f64) -> Result<Self, TraceError> {
        assert!(from <= to, "a stage's interval runs forwards in time");
        let mut poses = Poses::new(scene, from, to);
        Ok(Self {
            scene,
            tree: SceneTree::build(scene, &mut poses, from, to)?,
            sky: Sky::new(&scene.background),
            glossy_materials: scene.materials.iter().map(GlossyMaterial::new).collect(),
            poses,
            traversal: Traversal::best(),
            has_translucency: (scene.materials.iter())
                .any(|material| material.translucency.is_some()),
        })
    }

    /// Returns true if nothing in the world changes its place or shape.
    pub(crate) fn stands_still(&self) -> bool {
        (0..self.scene.objects.len()).all(|object| self.object_stands_still(object))
    }

    /// Returns true if all surfaces look the same from everywhere.
    pub(crate) fn is_diffuse(&self) -> bool {
        let is_glass = |material: &Material| {
            material
                .translucency
                .is_some_and(|translucency| translucency.glass.is_some())
        };
        self.glossy_materials.iter().all(Option::is_none)
            && !self.scene.materials.iter().any(is_glass)
    }

    /// A store of poses, for one path at a time.
    pub fn poses(&self) -> Poses<'a> {
        self.poses.clone()
    }

    /// Finds the nearest surface at `t > 0`, opaque or translucent; among equally near ones, that
    /// of the lowest object, then triangle.
    pub fn closest(&self, poses: &mut Poses, ray: &Ray) -> Option<Hit> {
        self.closest_in_sight(poses, ray, Sight::Everything)
    }

    /// Finds the nearest surface of those that a ray of this sight sees.
    pub(crate) fn closest_in_sight(
        &self,
        poses: &mut Poses,
        ray: &Ray,
        sight: Sight,
    ) -> Option<Hit> {
        traverse!(self.closest(poses, ray, sight))
    }

    /// Finds the nearest surface behind a hit of the same ray.
    pub(crate) fn closest_behind(&self, poses: &mut Poses, ray: &Ray, last: &Hit) -> Option<Hit> {
        traverse!(self.closest_behind(poses, ray, last))
    }

    /// Finds a surface at the place of a hit of the same ray, of those that `is_other` names by
    /// object and triangle.
    pub(crate) fn coincident(
        &self,
        poses: &mut Poses,
        ray: &Ray,
        hit: &Hit,
        is_other: &(dyn Fn(usize, u32) -> bool + Sync),
    ) -> Option<Hit> {
        traverse!(self.coincident(poses, ray, hit, is_other))
    }

    /// The share of the light that passes along a ray at `0 < t < limit`: the product of all
    /// surfaces' shares. It does not depend on the order of the traversal, since surfaces are met
    /// from near to far.
    pub(crate) fn transmittance(&self, poses: &mut Poses, ray: &Ray, limit: f64) -> Vec3 {
        if self.is_blocked(poses, ray, limit) {
            return Vec3::ZERO;
        }
        let mut share = Vec3::ONE;
        if !self.has_translucency {
            return share;
        }
        let mut next = self.closest(poses, ray);
        while let Some(hit) = next.filter(|hit| hit.t < limit) {
            let Some(passage) = Passage::at(self.scene, poses, ray, &hit) else {
                return Vec3::ZERO;
            };
            share *= passage.transmittance();
            if share == Vec3::ZERO {
                return share;
            }
            next = self.closest_behind(poses, ray, &hit);
        }
        share
    }

    /// Returns true if anything opaque is at `0 < t < limit`.
    pub fn is_blocked(&self, poses: &mut Poses, ray: &Ray, limit: f64) -> bool {
        traverse!(self.is_blocked(poses, ray, limit))
    }

    /// Returns true if anything opaque is at `0 < t < limit`, for a ray that nothing still blocks.
    pub(crate) fn is_blocked_by_mover(&self, poses: &mut Poses, ray: &Ray, limit: f64) -> bool {
        if !self.tree.has_few_movers() {
            return self.is_blocked(poses, ray, limit);
        }
        traverse!(self.is_blocked_by_mover(poses, ray, limit))
    }

    /// Returns true if an object keeps its place and its shape.
    pub(crate) fn object_stands_still(&self, object: usize) -> bool {
        let mesh = &self.scene.meshes[self.scene.objects[object].mesh];
        self.poses.stands_still(object) && !mesh.deforms()
    }

    /// The same stage, traversed as on a processor without AVX2: for comparison.
    pub fn portable(mut self) -> Self {
        self.traversal = Traversal::Portable;
        self
    }

    /// The instructions that traverse the trees: `avx2` or `portable`.
    pub fn traversal(&self) -> &'static str {
        match self.traversal {
            #[cfg(target_arch = "x86_64")]
            Traversal::Avx2(_) => "avx2",
            Traversal::Portable => "portable",
        }
    }

    /// The unit normal of the facet that a ray met, on the ray's side.
    pub fn facet(&self, poses: &mut Poses, ray: &Ray, hit: &Hit) -> DVec3 {
        Surface::at(self.scene, poses.pose(hit.object), ray, hit).facet
    }

    /// Finds the hit of [`Stage::closest`] by testing every triangle: the reference for tests.
    pub fn closest_of_all(&self, poses: &mut Poses, ray: &Ray) -> Option<Hit> {
        self.tree.closest_of_all(poses, ray)
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hit::LIFT;
    use crate::motion::lens::LensPoint;
    use crate::motion::view::View;
    use crate::test_scene::load_test_scene;

    #[test]
    fn a_mover_blocks_a_ray_if_the_ray_meets_it_first() {
        for name in ["walker", "railing", "fan"] {
            let scene = load_test_scene(name);
            let stage = Stage::new(&scene, -0.5, 0.5);
            let mut poses = stage.poses();
            let mut met = 0;
            for time in [-0.5, -0.2, 0.0, 0.5] {
                poses.at(time);
                let view = View::new(&scene.camera, time, 48, 27);
                for pixel in 0..48 * 27 {
                    let place = [pixel % 48, pixel / 48].map(|at| f64::from(at) + 0.5);
                    let ray = view.ray_through(place, LensPoint::CENTRE);
                    let hit = stage.closest(&mut poses, &ray);
                    let limit = hit.map_or(f64::INFINITY, |hit| hit.t * (1.0 + LIFT));
                    let moves = hit.is_some_and(|hit| !stage.object_stands_still(hit.object));
                    met += u32::from(moves);
                    let is_blocked = stage.is_blocked_by_mover(&mut poses, &ray, limit);
                    assert_eq!(is_blocked, moves, "{name} at {time}, {place:?}");
                }
            }
            assert!(met > 100, "{name}: {met}");
        }
    }
}
