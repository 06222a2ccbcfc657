//! Walks through a stage: what is nearest, and whether anything is in between.

use crate::accel::lanes::Lanes;
use crate::accel::rigid_tree::{Aim, MeshTree};
use crate::accel::world_tree::Part;
use crate::geometry::ray::Ray;
use crate::geometry::triangle::Crossing;
use crate::motion::poses::Poses;
use crate::stage::{Hit, Stage};

/// A limit that nothing lies before: it ends a walk.
const NOWHERE: f64 = f64::NEG_INFINITY;

/// A ray made ready for the leaves of the object that it came to last.
#[derive(Default)]
struct Aimed {
    object: Option<usize>,
    aim: Option<Aim>,
}

impl Aimed {
    /// For the leaves of an object; none where the ray misses them all.
    #[inline(always)]
    fn at(&mut self, mesh: &MeshTree, object: usize, poses: &mut Poses, ray: &Ray) -> Option<&Aim> {
        if self.object != Some(object) {
            self.object = Some(object);
            self.aim = mesh.aim(&ray.transformed(&poses.pose(object).to_object));
        }
        self.aim.as_ref()
    }
}

impl Stage<'_> {
    /// [`Stage::closest`] with these instructions.
    #[inline(always)]
    pub(crate) fn closest_by<L: Lanes>(
        &self,
        lanes: L,
        poses: &mut Poses,
        ray: &Ray,
    ) -> Option<Hit> {
        let time = poses.time();
        let mut waiting = poses.take_waiting(self.most_waiting);
        let mut best: Option<Hit> = None;
        let mut aimed = Aimed::default();
        let limit = |best: &Option<Hit>| best.map_or(f64::INFINITY, |hit| hit.t);
        self.world.walk::<L, true>(
            lanes,
            &mut waiting,
            (ray, time),
            f64::INFINITY,
            #[inline(always)]
            |waiting, Part { object, leaf }| {
                let before = limit(&best);
                let visit = |triangle, crossing| {
                    self.keep_nearer(&mut best, time, object, triangle, crossing);
                    limit(&best)
                };
                match leaf {
                    Some(leaf) => {
                        let mesh = self.mesh(object).rigid();
                        if let Some(aim) = aimed.at(mesh, object, poses, ray) {
                            mesh.meet(lanes, leaf, aim, before, visit);
                        }
                    }
                    None if poses.missed(object, ray) => {}
                    None => {
                        let local = ray.transformed(&poses.pose(object).to_object);
                        let mesh = self.mesh(object);
                        mesh.walk::<L, true>(lanes, waiting, &local, time, before, visit);
                    }
                }
                limit(&best)
            },
            #[inline(always)]
            |part| self.fetch(part),
        );
        poses.waiting = waiting;
        best
    }

    /// [`Stage::blocked`] with these instructions.
    #[inline(always)]
    pub(crate) fn blocked_by<L: Lanes>(
        &self,
        lanes: L,
        poses: &mut Poses,
        ray: &Ray,
        limit: f64,
    ) -> bool {
        let time = poses.time();
        let mut waiting = poses.take_waiting(self.most_waiting);
        let mut blocked = false;
        let mut aimed = Aimed::default();
        self.world.walk::<L, false>(
            lanes,
            &mut waiting,
            (ray, time),
            limit,
            #[inline(always)]
            |waiting, Part { object, leaf }| {
                let visit = |triangle, crossing: Crossing| {
                    let opaque = self.opacities[object].opaque(self.scene, triangle, &crossing);
                    blocked |= crossing.t < limit && opaque;
                    if blocked { NOWHERE } else { limit }
                };
                match leaf {
                    Some(leaf) => {
                        let mesh = self.mesh(object).rigid();
                        if let Some(aim) = aimed.at(mesh, object, poses, ray) {
                            mesh.meet(lanes, leaf, aim, limit, visit);
                        }
                    }
                    None if poses.missed(object, ray) => {}
                    None => {
                        let local = ray.transformed(&poses.pose(object).to_object);
                        let mesh = self.mesh(object);
                        mesh.walk::<L, false>(lanes, waiting, &local, time, limit, visit);
                    }
                }
                if blocked { NOWHERE } else { limit }
            },
            #[inline(always)]
            |part| self.fetch(part),
        );
        poses.waiting = waiting;
        blocked
    }

    /// Has the processor fetch from memory what a part of the world's tree consists of.
    #[inline(always)]
    fn fetch(&self, part: Part) {
        if let Some(leaf) = part.leaf {
            self.mesh(part.object).rigid().fetch(leaf);
        }
    }

    /// Takes a crossing for the best hit where it is nearer and the surface has no hole there.
    #[inline(always)]
    pub(crate) fn keep_nearer(
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
}
