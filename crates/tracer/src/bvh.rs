//! The bounding volume hierarchy: the one module that knows obvhs.
//!
//! Only obvhs's builder and its binary traversal are used. Its triangle tests leave holes along shared edges, its
//! two-level traversal drops instances and its eight-wide nodes ignore what is nearer than 1e-4, so the
//! intersections and the second level are this crate's own.

use std::time::Duration;

use glam::DVec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::ray::{Ray as SlabRay, RayHit};
use obvhs::{Boundable, BvhBuildParams};

use crate::bounds::Bounds;
use crate::ray::Ray;

/// Boxes are padded by this fraction of the greatest coordinate involved. The slab test runs in `f32` without guard
/// bits: origin, difference, direction, product and limit are each rounded by 6e-8 of at most a few times that
/// coordinate, about 1e-6 together. A hit at exactly the limit is therefore still visited, and the caller decides
/// ties.
const PAD: f64 = 2e-6;

/// A binary tree over boxes.
pub(crate) struct Tree {
    bvh: Bvh2,
}

struct PaddedBox(Aabb);

impl Boundable for PaddedBox {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl Tree {
    /// A tree over `boxes`, searched by rays whose origins have coordinates of at most `reach` metres or of those
    /// of the boxes, whichever is more.
    pub fn over(boxes: &[Bounds], reach: f64, boxes_per_leaf: u32) -> Self {
        if boxes.is_empty() {
            return Self {
                bvh: Bvh2::default(),
            };
        }
        let reach = boxes
            .iter()
            .fold(reach, |reach, bounds| reach.max(bounds.reach()));
        let padded: Vec<PaddedBox> = boxes
            .iter()
            .map(|bounds| {
                let bounds = bounds.grown(PAD * reach);
                PaddedBox(Aabb::new(
                    bounds.min.as_vec3().into(),
                    bounds.max.as_vec3().into(),
                ))
            })
            .collect();
        let params = BvhBuildParams {
            pre_split: false,
            max_prims_per_leaf: boxes_per_leaf,
            ..BvhBuildParams::slow_build()
        };
        Self {
            bvh: build_bvh2(&padded, params, &mut Duration::default()),
        }
    }

    /// The boxes' indices in the order of the slots that the walks report.
    pub fn order(&self) -> &[u32] {
        &self.bvh.primitive_indices
    }

    /// Visits, roughly from near to far, the slots whose box the ray enters before the limit (distance along the
    /// unit direction). `visit` returns the limit from then on.
    #[inline]
    pub fn walk(&self, ray: &Ray, limit: f64, mut visit: impl FnMut(usize) -> f64) {
        self.bvh
            .ray_traverse(slab_ray(ray, limit), &mut RayHit::none(), |_, slot| {
                visit(slot) as f32
            });
    }

    /// Visits slots until `visit` returns true; whether it did.
    #[inline]
    pub fn any(&self, ray: &Ray, limit: f64, mut visit: impl FnMut(usize) -> bool) -> bool {
        !self.bvh.ray_traverse_miss(slab_ray(ray, limit), |_, slot| {
            if visit(slot) {
                f32::NEG_INFINITY
            } else {
                f32::INFINITY
            }
        })
    }
}

fn slab_ray(ray: &Ray, limit: f64) -> SlabRay {
    let vector = |v: DVec3| v.as_vec3().into();
    SlabRay::new(vector(ray.origin), vector(ray.direction), 0.0, limit as f32)
}
