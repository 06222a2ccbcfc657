//! The scene made ready for rays: one tree per mesh, and trees over the boxes that the objects sweep.

use glam::DVec3;

use crate::background::Sky;
use crate::geometry::Geometry;
use crate::gloss::Gloss;
#[cfg(target_arch = "x86_64")]
use crate::lanes::Avx2;
use crate::lanes::{Lanes, Portable};
use crate::poses::Poses;
use crate::ray::Ray;
use crate::scene::{Object, Scene};
use crate::slices::{Slice, slices};
use crate::surface::{Opacity, Surface};
use crate::triangle::Crossing;

/// A scene between two times, ready for rays.
///
/// A ray is moved into an object's space by the exact pose at its time; nothing about the motion is linearised. The
/// shutter is cut into slices, each with its own small tree over the boxes swept within it.
pub struct Stage<'a> {
    pub(crate) scene: &'a Scene,
    from: f64,
    to: f64,
    meshes: Vec<Option<Geometry<'a>>>,
    opacities: Vec<Opacity>,
    /// Per material of the scene.
    glosses: Vec<Option<Gloss>>,
    sky: Sky<'a>,
    slices: Vec<Slice>,
    /// Room for the children that wait while a ray is in another.
    most_waiting: usize,
    poses: Poses<'a>,
    traversal: Traversal,
}

/// Which instructions find the hits; all find the same.
enum Traversal {
    #[cfg(target_arch = "x86_64")]
    Avx2(Avx2),
    Portable,
}

/// A limit that nothing lies before: it ends a walk.
const NOWHERE: f64 = f64::NEG_INFINITY;

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
    /// Makes the scene ready for rays whose times lie in `[from, to]` (frames).
    pub fn new(scene: &'a Scene, from: f64, to: f64) -> Self {
        assert!(from <= to, "a stage's interval runs forwards in time");
        let shown: Vec<usize> = scene.objects.iter().map(|object| object.mesh).collect();
        let meshes: Vec<Option<Geometry>> = scene
            .meshes
            .iter()
            .enumerate()
            .map(|(index, mesh)| shown.contains(&index).then(|| Geometry::of(mesh, from, to)))
            .collect();
        let slices = slices(scene, from, to);
        let in_slices = slices.iter().map(|slice| slice.tree.most_waiting).max();
        let in_meshes = meshes.iter().flatten().map(Geometry::most_waiting).max();
        Self {
            scene,
            from,
            to,
            meshes,
            opacities: Opacity::of_objects(scene),
            sky: Sky::of(&scene.background),
            glosses: scene.materials.iter().map(Gloss::of).collect(),
            slices,
            most_waiting: in_slices.unwrap_or(0) + in_meshes.unwrap_or(0),
            poses: Poses::new(scene, from, to),
            traversal: Traversal::best(),
        }
    }

    /// Whether nothing in the world changes its place or shape.
    pub(crate) fn stands_still(&self) -> bool {
        let deforms = |object: &Object| self.scene.meshes[object.mesh].deforms();
        self.poses.stand_still() && !self.scene.objects.iter().any(deforms)
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
        let slices = self.slices.iter();
        let slices = slices.map(|slice| slice.tree.bytes() + slice.leaves.bytes());
        meshes + slices.sum::<usize>()
    }

    #[inline(always)]
    fn closest_by<L: Lanes>(&self, lanes: L, poses: &mut Poses, ray: &Ray) -> Option<Hit> {
        let time = poses.time();
        let slice = self.slice(time);
        let mut waiting = poses.take_waiting(self.most_waiting);
        let mut best: Option<Hit> = None;
        slice.tree.walk::<L, true>(
            lanes,
            &mut waiting,
            ray,
            f64::INFINITY,
            #[inline(always)]
            |waiting, leaf| {
                let limit = |best: &Option<Hit>| best.map_or(f64::INFINITY, |hit| hit.t);
                for &object in slice.leaves.items(leaf) {
                    let object = object as usize;
                    let local = ray.transformed(&poses.pose(object).to_object);
                    self.mesh(object).walk::<L, true>(
                        lanes,
                        waiting,
                        &local,
                        time,
                        limit(&best),
                        |triangle, crossing| {
                            self.keep_nearer(&mut best, time, object, triangle, crossing);
                            limit(&best)
                        },
                    );
                }
                limit(&best)
            },
            |_| {},
        );
        poses.waiting = waiting;
        best
    }

    #[inline(always)]
    fn blocked_by<L: Lanes>(&self, lanes: L, poses: &mut Poses, ray: &Ray, limit: f64) -> bool {
        let time = poses.time();
        let slice = self.slice(time);
        let mut waiting = poses.take_waiting(self.most_waiting);
        let mut blocked = false;
        slice.tree.walk::<L, false>(
            lanes,
            &mut waiting,
            ray,
            limit,
            #[inline(always)]
            |waiting, leaf| {
                for &object in slice.leaves.items(leaf) {
                    let object = object as usize;
                    let local = ray.transformed(&poses.pose(object).to_object);
                    self.mesh(object).walk::<L, false>(
                        lanes,
                        waiting,
                        &local,
                        time,
                        limit,
                        |triangle, crossing| {
                            let opaque =
                                self.opacities[object].opaque(self.scene, triangle, &crossing);
                            blocked |= crossing.t < limit && opaque;
                            if blocked { NOWHERE } else { limit }
                        },
                    );
                    if blocked {
                        return NOWHERE;
                    }
                }
                limit
            },
            |_| {},
        );
        poses.waiting = waiting;
        blocked
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

    #[inline]
    fn keep_nearer(
        &self,
        best: &mut Option<Hit>,
        time: f64,
        object: usize,
        triangle: u32,
        crossing: Crossing,
    ) {
        let nearer = best.is_none_or(|best| {
            (crossing.t, object, triangle) < (best.t, best.object, best.triangle)
        });
        if nearer && self.opacities[object].opaque(self.scene, triangle, &crossing) {
            *best = Some(Hit {
                t: crossing.t,
                object,
                triangle,
                weights: [crossing.u, crossing.v],
                time,
            });
        }
    }

    fn mesh(&self, object: usize) -> &Geometry<'a> {
        self.meshes[self.scene.objects[object].mesh]
            .as_ref()
            .expect("every shown mesh has a tree")
    }

    fn slice(&self, time: f64) -> &Slice {
        assert!(
            self.from <= time && time <= self.to,
            "a ray's time lies in the stage's interval"
        );
        let fraction = (time - self.from) / (self.to - self.from).max(f64::MIN_POSITIVE);
        let slice = (fraction * self.slices.len() as f64) as usize;
        &self.slices[slice.min(self.slices.len() - 1)]
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
