//! The geometry of a scene under its trees: the nearest hit of a ray, and occlusion.

use bvh::{Aabb, Crossing, Lanes, LeafRay, Part, Ray, RigidTree, WorldTree};
use scene::Scene;

use crate::accel::coordinates::check_coordinates;
use crate::accel::kept_trees::drop_old_trees;
use crate::accel::mesh_tree::MeshTree;
use crate::accel::world_leaves::collect_world_leaves;
use crate::error::TraceError;
use crate::hit::{Hit, IN_ONE_PLACE, LIFT};
use crate::material::surface::{Sight, find_solid_objects, is_seen};
use crate::motion::poses::Poses;
use crate::motion::slices::sweep_slices;

/// A limit before every crossing: it ends a traversal.
const NOWHERE: f64 = f64::NEG_INFINITY;
/// Movers up to which a test of each is shorter than a traversal of the world tree.
const FEW_MOVERS: usize = 24;

/// The meshes of a scene, and the world tree above them.
///
/// Still objects are in the world tree, leaf by leaf. Per slice of the shutter interval, a small
/// tree has the topmost nodes of that tree and the boxes that moving objects sweep.
pub(crate) struct SceneTree<'a> {
    scene: &'a Scene,
    /// Trees per mesh of the scene; none if no object shows it.
    meshes: Vec<Option<MeshTree<'a>>>,
    world: WorldTree,
    /// Objects that move or deform, each with a box around all its places.
    movers: Vec<(usize, Aabb)>,
    /// Objects that are opaque everywhere.
    solid: Vec<bool>,
    stack_size: usize,
}

/// The ray in the space of the object whose leaf it met last.
#[derive(Default)]
struct LastLeafRay {
    object: Option<usize>,
    ray: Option<LeafRay>,
}

impl LastLeafRay {
    /// The ray for the leaves of an object; none if it misses them all.
    #[inline(always)]
    fn get(
        &mut self,
        mesh: &RigidTree,
        object: usize,
        poses: &mut Poses,
        ray: &Ray,
    ) -> Option<&LeafRay> {
        if self.object != Some(object) {
            self.object = Some(object);
            self.ray = mesh.prepare_ray(&ray.transformed(&poses.pose(object).to_object));
        }
        self.ray.as_ref()
    }
}

impl<'a> SceneTree<'a> {
    /// Builds all trees for rays at times in `[from, to]`, the interval of `poses`. Refuses objects
    /// with coordinates above [`LARGEST_COORDINATE`](crate::limits::LARGEST_COORDINATE).
    pub fn build(
        scene: &'a Scene,
        poses: &mut Poses,
        from: f64,
        to: f64,
    ) -> Result<Self, TraceError> {
        let (slices, swept) = sweep_slices(scene, from, to);
        check_coordinates(scene, &swept)?;
        let shown: Vec<usize> = scene.objects.iter().map(|object| object.mesh).collect();
        let meshes: Vec<Option<MeshTree>> = scene
            .meshes
            .iter()
            .enumerate()
            .map(|(index, mesh)| {
                shown
                    .contains(&index)
                    .then(|| MeshTree::build(mesh, from, to))
            })
            .collect();
        drop_old_trees(meshes.iter().flatten().count());
        let coordinates = swept.iter().flatten().map(|aabb| aabb.largest_coordinate());
        let largest = coordinates.fold(0.0, f64::max);
        let leaves = collect_world_leaves(scene, &meshes, poses, largest);
        let world = WorldTree::build(&leaves, slices, &swept);
        let in_meshes = leaves
            .iter()
            .zip(&shown)
            .map(|(leaves, mesh)| match leaves {
                // Rays go from the world tree to a leaf.
                Some(_) => 0,
                None => meshes[*mesh].as_ref().map_or(0, MeshTree::stack_size),
            });
        Ok(Self {
            scene,
            stack_size: world.tree.stack_size + in_meshes.max().unwrap_or(0),
            meshes,
            world,
            movers: (0..scene.objects.len())
                .filter(|&object| {
                    let mesh = &scene.meshes[scene.objects[object].mesh];
                    !poses.stands_still(object) || mesh.deforms()
                })
                .map(|object| {
                    let boxes = swept.iter().map(|slice| slice[object]);
                    (
                        object,
                        boxes.fold(Aabb::EMPTY, Aabb::union).grown(LIFT * largest),
                    )
                })
                .collect(),
            solid: find_solid_objects(scene),
        })
    }

    /// Finds the nearest surface at `t > 0`; among equally near ones, that of the lowest object,
    /// then triangle.
    #[inline(always)]
    pub fn closest<L: Lanes>(
        &self,
        lanes: L,
        poses: &mut Poses,
        ray: &Ray,
        sight: Sight,
    ) -> Option<Hit> {
        let all = |_: usize, _: u32, _: &Crossing| true;
        self.closest_of(lanes, poses, ray, sight, all)
    }

    /// Finds the nearest surface behind a hit of the same ray, in the order of
    /// [`SceneTree::closest`]. Triangles of one object that meet at the hit are one surface: a ray
    /// through their common edge passes it once.
    #[inline(always)]
    pub fn closest_behind<L: Lanes>(
        &self,
        lanes: L,
        poses: &mut Poses,
        ray: &Ray,
        last: &Hit,
    ) -> Option<Hit> {
        let together = last.t * (1.0 + LIFT);
        let behind = |object: usize, triangle: u32, crossing: &Crossing| {
            (crossing.t, object, triangle) > (last.t, last.object, last.triangle)
                && (object != last.object || crossing.t > together)
        };
        self.closest_of(lanes, poses, ray, Sight::Everything, behind)
    }

    /// Finds a surface at the place of a hit of the same ray, of those that `is_other` names by
    /// object and triangle.
    pub fn coincident<L: Lanes>(
        &self,
        lanes: L,
        poses: &mut Poses,
        ray: &Ray,
        hit: &Hit,
        is_other: &(dyn Fn(usize, u32) -> bool + Sync),
    ) -> Option<Hit> {
        let farthest = hit.t * (1.0 + IN_ONE_PLACE);
        let is_there = |object: usize, triangle: u32, crossing: &Crossing| {
            (hit.t..=farthest).contains(&crossing.t) && is_other(object, triangle)
        };
        self.closest_of(lanes, poses, ray, Sight::Everything, is_there)
    }

    /// Finds the nearest of the surfaces that `is_wanted` names.
    #[inline(always)]
    fn closest_of<L: Lanes>(
        &self,
        lanes: L,
        poses: &mut Poses,
        ray: &Ray,
        sight: Sight,
        is_wanted: impl Fn(usize, u32, &Crossing) -> bool,
    ) -> Option<Hit> {
        let time = poses.time();
        let mut best: Option<Hit> = None;
        self.traverse::<L, true>(
            lanes,
            poses,
            ray,
            f64::INFINITY,
            #[inline(always)]
            |object, triangle, crossing| {
                if is_wanted(object, triangle, &crossing) {
                    self.keep_nearer(&mut best, (sight, time), object, triangle, crossing);
                }
                best.map_or(f64::INFINITY, |hit| hit.t)
            },
        );
        best
    }

    /// Returns true if anything opaque is at `0 < t < limit`.
    #[inline(always)]
    pub fn is_blocked<L: Lanes>(&self, lanes: L, poses: &mut Poses, ray: &Ray, limit: f64) -> bool {
        let mut blocked = false;
        self.traverse::<L, false>(
            lanes,
            poses,
            ray,
            limit,
            #[inline(always)]
            |object, triangle, crossing| {
                blocked |= crossing.t < limit && self.is_opaque(object, triangle, &crossing);
                if blocked { NOWHERE } else { limit }
            },
        );
        blocked
    }

    /// Returns true if anything opaque that moves is at `0 < t < limit`.
    #[inline(always)]
    pub fn is_blocked_by_mover<L: Lanes>(
        &self,
        lanes: L,
        poses: &mut Poses,
        ray: &Ray,
        limit: f64,
    ) -> bool {
        let time = poses.time();
        let inverse = ray.direction.recip();
        let mut stack = poses.take_stack(self.stack_size);
        let mut blocked = false;
        // No closure around this: it would be compiled without the wide instructions.
        for &(object, places) in &self.movers {
            if places.is_missed(ray, inverse) || poses.is_missed(object, ray) {
                continue;
            }
            let local = ray.transformed(&poses.pose(object).to_object);
            self.mesh(object).traverse::<L, false>(
                lanes,
                &mut stack,
                &local,
                time,
                limit,
                #[inline(always)]
                |triangle, crossing| {
                    blocked |= crossing.t < limit && self.is_opaque(object, triangle, &crossing);
                    if blocked { NOWHERE } else { limit }
                },
            );
            if blocked {
                break;
            }
        }
        poses.stack = stack;
        blocked
    }

    /// Returns true if a test of every mover is shorter than a traversal of the world tree.
    pub fn has_few_movers(&self) -> bool {
        self.movers.len() <= FEW_MOVERS
    }

    /// Visits the crossings at `0 < t <= limit`: roughly from near to far if `SORTED`, else in any
    /// order. `visit` takes the object and the triangle and returns the new limit; one below 0 ends
    /// the traversal.
    #[inline(always)]
    fn traverse<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        poses: &mut Poses,
        ray: &Ray,
        mut limit: f64,
        mut visit: impl FnMut(usize, u32, Crossing) -> f64,
    ) {
        let time = poses.time();
        let mut stack = poses.take_stack(self.stack_size);
        let mut leaf_ray = LastLeafRay::default();
        self.world.traverse::<L, SORTED>(
            lanes,
            &mut stack,
            (ray, time),
            limit,
            #[inline(always)]
            |stack, Part { object, leaf }| {
                let before = limit;
                let visit = |triangle, crossing| {
                    limit = visit(object, triangle, crossing);
                    limit
                };
                match leaf {
                    Some(leaf) => {
                        let mesh = self.mesh(object).rigid();
                        if let Some(ray) = leaf_ray.get(mesh, object, poses, ray) {
                            mesh.intersect_leaf(lanes, leaf, ray, before, visit);
                        }
                    }
                    None if poses.is_missed(object, ray) => {}
                    None => {
                        let local = ray.transformed(&poses.pose(object).to_object);
                        let mesh = self.mesh(object);
                        mesh.traverse::<L, SORTED>(lanes, stack, &local, time, before, visit);
                    }
                }
                limit
            },
            #[inline(always)]
            |part| self.prefetch(part),
        );
        poses.stack = stack;
    }

    /// Finds the hit of [`SceneTree::closest`] by testing every triangle: the reference for tests.
    pub fn closest_of_all(&self, poses: &mut Poses, ray: &Ray) -> Option<Hit> {
        let time = poses.time();
        let mut best = None;
        for object in 0..self.scene.objects.len() {
            let local = ray.transformed(&poses.pose(object).to_object);
            let mesh = &self.scene.meshes[self.scene.objects[object].mesh];
            (self.mesh(object)).visit_all(mesh, &local, time, |triangle, crossing| {
                let seen = (Sight::Everything, time);
                self.keep_nearer(&mut best, seen, object, triangle, crossing);
            });
        }
        best
    }

    /// Prefetches the leaf of a part of the world tree.
    #[inline(always)]
    fn prefetch(&self, part: Part) {
        if let Some(leaf) = part.leaf {
            self.mesh(part.object).rigid().prefetch(leaf);
        }
    }

    #[inline(always)]
    fn is_opaque(&self, object: usize, triangle: u32, crossing: &Crossing) -> bool {
        self.is_seen(Sight::Opaque, object, triangle, crossing)
    }

    /// Returns true if a ray of this sight sees the surface at the crossing.
    #[inline(always)]
    fn is_seen(&self, sight: Sight, object: usize, triangle: u32, crossing: &Crossing) -> bool {
        let weights = [crossing.u, crossing.v];
        self.solid[object] || is_seen(sight, self.scene, (object, triangle), weights)
    }

    /// Replaces the best hit by a nearer crossing, if the ray sees the surface there.
    #[inline(always)]
    fn keep_nearer(
        &self,
        best: &mut Option<Hit>,
        (sight, time): (Sight, f64),
        object: usize,
        triangle: u32,
        crossing: Crossing,
    ) {
        let nearer = best.is_none_or(|best| {
            (crossing.t, object, triangle) < (best.t, best.object, best.triangle)
        });
        if nearer && self.is_seen(sight, object, triangle, &crossing) {
            *best = Some(Hit {
                t: crossing.t,
                object,
                triangle,
                weights: [crossing.u, crossing.v],
                time,
            });
        }
    }

    #[inline(always)]
    fn mesh(&self, object: usize) -> &MeshTree<'a> {
        self.meshes[self.scene.objects[object].mesh]
            .as_ref()
            .expect("every shown mesh has a tree")
    }
}
