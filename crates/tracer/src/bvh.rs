//! The bounding volume hierarchy: the one module that knows obvhs.
//!
//! obvhs builds a binary tree, which is folded into nodes of eight children with full-precision boxes. Its own triangle
//! tests leave holes along shared edges, its two-level traversal drops instances and its eight-wide nodes ignore what is
//! nearer than 1e-4, so traversal, intersections and the second level are this crate's own.

use std::time::Duration;

use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::{Boundable, BvhBuildParams};
use smallvec::SmallVec;

use crate::bounds::Bounds;
use crate::lanes::{Boxes, Lanes, SlabRay, WIDTH};
use crate::ray::Ray;

/// Boxes are padded by this fraction of the greatest coordinate involved. The slab test runs in `f32` without guard
/// bits: origin, difference, direction, product and limit are each rounded by 6e-8 of at most a few times that
/// coordinate, about 1e-6 together. A hit at exactly the limit is therefore still visited, and the caller decides
/// ties.
const PAD: f64 = 2e-6;

/// What a step down the tree costs relative to a test of one item, for the builder's decision which leaves to join.
const STEP_COST: f32 = 3.0;

/// Set in a child that is a leaf; the rest is the leaf's number.
const IS_LEAF: u32 = 1 << 31;

/// An eight-wide tree over boxes. Leaves are numbered from 0.
pub(crate) struct Tree {
    /// The root comes first; none where there is nothing.
    nodes: Vec<Node>,
    /// Per leaf and one past the last, where its items begin in `order`.
    starts: Vec<u32>,
    order: Vec<u32>,
}

struct Node {
    boxes: Boxes,
    children: [u32; WIDTH],
}

struct PaddedBox(Aabb);

impl Boundable for PaddedBox {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

/// A child yet to be visited, and the distance at which the ray enters it.
type Pending = (u32, f32);

impl Tree {
    /// A tree over `boxes`, searched by rays whose origins have coordinates of at most `reach` metres or of those
    /// of the boxes, whichever is more.
    pub fn over(boxes: &[Bounds], reach: f64, boxes_per_leaf: u32) -> Self {
        let mut tree = Self {
            nodes: Vec::new(),
            starts: vec![0],
            order: Vec::new(),
        };
        if boxes.is_empty() {
            return tree;
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
            collapse_traversal_cost: STEP_COST,
            ..BvhBuildParams::slow_build()
        };
        let binary = build_bvh2(&padded, params, &mut Duration::default());
        tree.fold(&binary, &binary.nodes[0]);
        tree
    }

    /// Indices of a leaf's boxes.
    pub fn items(&self, leaf: u32) -> &[u32] {
        let [start, end] = [0, 1].map(|next| self.starts[leaf as usize + next] as usize);
        &self.order[start..end]
    }

    /// How many leaves there are.
    pub fn leaves(&self) -> u32 {
        self.starts.len() as u32 - 1
    }

    /// Bytes that the tree takes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.starts.as_slice())
            + size_of_val(self.order.as_slice())
    }

    /// Adds a node for a part of the binary tree, and all below it; returns its number.
    fn fold(&mut self, binary: &Bvh2, top: &Bvh2Node) -> u32 {
        let children = opened(binary, top);
        let number = self.nodes.len();
        self.nodes.push(Node {
            boxes: side_by_side(&children),
            children: [0; WIDTH],
        });
        for (lane, child) in children.iter().enumerate() {
            self.nodes[number].children[lane] = if child.is_leaf() {
                self.add_leaf(binary, child)
            } else {
                self.fold(binary, child)
            };
        }
        number as u32
    }

    fn add_leaf(&mut self, binary: &Bvh2, leaf: &Bvh2Node) -> u32 {
        let first = leaf.first_index as usize;
        let items = &binary.primitive_indices[first..first + leaf.prim_count as usize];
        self.order.extend_from_slice(items);
        self.starts.push(self.order.len() as u32);
        IS_LEAF | (self.starts.len() as u32 - 2)
    }

    /// Visits the leaves that the ray may enter before the limit (distance along its unit direction), roughly from near
    /// to far. `visit` returns the limit from then on.
    #[inline(always)]
    pub fn walk<L: Lanes>(
        &self,
        lanes: L,
        ray: &Ray,
        limit: f64,
        mut visit: impl FnMut(u32) -> f64,
    ) {
        let ray = SlabRay::new(ray.origin, ray.direction);
        let mut limit = limit as f32;
        let mut pending: SmallVec<[Pending; 64]> = SmallVec::new();
        if !self.nodes.is_empty() {
            pending.push((0, 0.0));
        }
        while let Some((mut child, near)) = pending.pop() {
            if near > limit {
                continue;
            }
            while child & IS_LEAF == 0 {
                let node = &self.nodes[child as usize];
                let (mut entered, near) = lanes.enter(&node.boxes, &ray, limit);
                let Some(lane) = next(&mut entered) else {
                    break;
                };
                let mut nearest = (node.children[lane], near[lane]);
                let first = pending.len();
                while let Some(lane) = next(&mut entered) {
                    let mut other = (node.children[lane], near[lane]);
                    if other.1 < nearest.1 {
                        std::mem::swap(&mut other, &mut nearest);
                    }
                    pending.push(other);
                }
                sort_far_to_near(&mut pending[first..]);
                child = nearest.0;
            }
            if child & IS_LEAF != 0 {
                limit = visit(child & !IS_LEAF) as f32;
            }
        }
    }
}

/// Takes the lowest bit.
#[inline(always)]
fn next(bits: &mut u32) -> Option<usize> {
    let lowest = bits.trailing_zeros() as usize;
    *bits &= bits.wrapping_sub(1);
    (lowest < WIDTH).then_some(lowest)
}

/// Insertion sort: there are seven at most, and mostly one or two.
#[inline(always)]
fn sort_far_to_near(pending: &mut [Pending]) {
    for end in 1..pending.len() {
        let mut at = end;
        while at > 0 && pending[at - 1].1 < pending[at].1 {
            pending.swap(at - 1, at);
            at -= 1;
        }
    }
}

/// Up to eight descendants that cover a node: of those at hand, the largest is opened until there is no room.
fn opened<'a>(binary: &'a Bvh2, top: &'a Bvh2Node) -> Vec<&'a Bvh2Node> {
    let mut children = vec![top];
    while children.len() < WIDTH {
        let largest = (0..children.len())
            .filter(|&child| !children[child].is_leaf())
            .max_by(|&a, &b| {
                let area = |child: usize| children[child].aabb.half_area();
                area(a).total_cmp(&area(b))
            });
        let Some(largest) = largest else { break };
        let first = children[largest].first_index as usize;
        children[largest] = &binary.nodes[first];
        children.push(&binary.nodes[first + 1]);
    }
    children
}

fn side_by_side(children: &[&Bvh2Node]) -> Boxes {
    let empty = [f32::INFINITY, f32::NEG_INFINITY];
    Boxes(std::array::from_fn(|axis| {
        std::array::from_fn(|side| {
            std::array::from_fn(|lane| {
                children.get(lane).map_or(empty[side], |child| {
                    [child.aabb.min, child.aabb.max][side].to_array()[axis]
                })
            })
        })
    }))
}
