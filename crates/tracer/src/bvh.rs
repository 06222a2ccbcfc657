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

use crate::bounds::Bounds;
use crate::lanes::{Boxes, Lanes, SlabRay, WIDTH};
use crate::ray::Ray;

/// What a step down the tree costs relative to a test of one item, for the builder's decision which leaves to join.
const STEP_COST: f32 = 5.0;

/// Children that may wait without memory of their own being allocated: more than a tree of a million triangles needs.
const FEW_WAITING: usize = 64;

/// Set in a child that is a leaf; the rest is the leaf's number.
const IS_LEAF: u32 = 1 << 31;

/// An eight-wide tree over boxes. Leaves are numbered from 0.
pub(crate) struct Tree {
    /// The root comes first; none where there is nothing.
    nodes: Vec<Node>,
    /// Per leaf and one past the last, where its items begin in `order`.
    starts: Vec<u32>,
    order: Vec<u32>,
    /// The greatest coordinate of any box, metres.
    reach: f64,
    /// Children that may wait while a ray is in another.
    most_waiting: usize,
}

#[repr(C, align(64))]
struct Node {
    boxes: Boxes,
    children: [u32; WIDTH],
}

struct RoundedBox(Aabb);

impl Boundable for RoundedBox {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl Tree {
    /// A tree over `boxes`.
    pub fn over(boxes: &[Bounds], boxes_per_leaf: u32) -> Self {
        let mut tree = Self {
            nodes: Vec::new(),
            starts: vec![0],
            order: Vec::new(),
            reach: boxes
                .iter()
                .map(|bounds| bounds.reach())
                .fold(0.0, f64::max),
            most_waiting: 0,
        };
        if boxes.is_empty() {
            return tree;
        }
        let rounded: Vec<RoundedBox> = boxes
            .iter()
            .map(|bounds| {
                RoundedBox(Aabb::new(
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
        let binary = build_bvh2(&rounded, params, &mut Duration::default());
        tree.fold(&binary, &binary.nodes[0], 0);
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

    /// Adds a node for a part of the binary tree, and all below it, while so many children wait; returns its number.
    fn fold(&mut self, binary: &Bvh2, top: &Bvh2Node, waiting: usize) -> u32 {
        let children = opened(binary, top);
        let waiting = waiting + children.len() - 1;
        self.most_waiting = self.most_waiting.max(waiting);
        let number = self.nodes.len();
        self.nodes.push(Node {
            boxes: side_by_side(&children),
            children: [0; WIDTH],
        });
        for (lane, child) in children.iter().enumerate() {
            self.nodes[number].children[lane] = if child.is_leaf() {
                self.add_leaf(binary, child)
            } else {
                self.fold(binary, child, waiting)
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

    /// Visits the leaves that the ray may enter before the limit, in units of its direction, roughly from near to far.
    /// `visit` returns the limit from then on; one below 0 ends the walk.
    #[inline(always)]
    pub fn walk<L: Lanes>(
        &self,
        lanes: L,
        ray: &Ray,
        limit: f64,
        mut visit: impl FnMut(u32) -> f64,
    ) {
        if self.nodes.is_empty() {
            return;
        }
        let ray = SlabRay::new(ray.origin, ray.direction, self.reach);
        let mut limit = limit as f32;
        let mut few = [0; FEW_WAITING];
        let mut many;
        let waiting: &mut [u64] = if self.most_waiting <= FEW_WAITING {
            &mut few
        } else {
            many = vec![0; self.most_waiting];
            &mut many
        };
        let mut count = 0;
        let mut child = 0;
        loop {
            if child & IS_LEAF != 0 {
                limit = visit(child & !IS_LEAF) as f32;
            } else {
                let node = &self.nodes[child as usize];
                // Copied at once: a processor waits for memory once, not again for each child.
                let children = node.children;
                let (mut entered, near) = lanes.enter(&node.boxes, &ray, limit);
                if entered != 0 {
                    let mut next = || {
                        let lane = entered.trailing_zeros() as usize % WIDTH;
                        entered &= entered - 1;
                        (pending(children[lane], near[lane]), entered)
                    };
                    let first = count;
                    let (mut nearest, mut rest) = next();
                    while rest != 0 {
                        let (other, left) = next();
                        rest = left;
                        let farther = nearest.max(other);
                        nearest = nearest.min(other);
                        // Insertion sort: there are seven at most, and mostly one or two. The nearest comes last.
                        let mut at = count;
                        while at > first && waiting[at - 1] < farther {
                            waiting[at] = waiting[at - 1];
                            at -= 1;
                        }
                        waiting[at] = farther;
                        count += 1;
                    }
                    child = nearest as u32;
                    continue;
                }
            }
            child = loop {
                if count == 0 {
                    return;
                }
                count -= 1;
                if entry(waiting[count]) <= limit {
                    break waiting[count] as u32;
                }
            };
        }
    }
}

/// A child yet to be visited and the distance at which the ray enters it: numbers in the order of the distances, which
/// are not negative.
#[inline(always)]
fn pending(child: u32, near: f32) -> u64 {
    u64::from(near.to_bits()) << 32 | u64::from(child)
}

/// The distance in what [`pending`] gave.
#[inline(always)]
fn entry(pending: u64) -> f32 {
    f32::from_bits((pending >> 32) as u32)
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
