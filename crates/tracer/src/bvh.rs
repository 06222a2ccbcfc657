//! The bounding volume hierarchy: with [`crate::folding`] all that knows obvhs.
//!
//! obvhs builds a binary tree, which is folded into nodes of eight children with full-precision boxes. Its own triangle
//! tests leave holes along shared edges, its two-level traversal drops instances and its eight-wide nodes ignore what is
//! nearer than 1e-4, so traversal, intersections and the second level are this crate's own.

use std::time::Duration;

use obvhs::aabb::Aabb;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::{Boundable, BvhBuildParams};
use prefetch_index::prefetch_index;

use crate::bounds::Bounds;
use crate::folding::{Folding, LeafRules};
use crate::lanes::{Boxes, Lanes, SlabRay, WIDTH};
use crate::ray::Ray;

/// Set in a child that is a leaf; the rest is the leaf's number.
const IS_LEAF: u32 = 1 << 31;

/// An eight-wide tree over boxes.
pub(crate) struct Tree {
    /// The root comes first; none where there is nothing.
    nodes: Vec<Node>,
    /// The greatest coordinate of any box, metres.
    reach: f64,
    /// Children that may wait while a ray is in another: the room that a walk needs.
    pub most_waiting: usize,
}

/// What a tree's leaves hold. Leaves are numbered from 0.
pub(crate) struct Leaves {
    /// Per leaf and one past the last, where its items begin in `order`.
    starts: Vec<u32>,
    order: Vec<u32>,
}

#[repr(C, align(32))]
struct Node {
    boxes: Boxes,
    children: [u32; WIDTH],
}

impl Node {
    /// Has the processor fetch it from memory, to be there when it is visited.
    #[inline(always)]
    fn fetch(&self) {
        for axis in &self.boxes.0 {
            prefetch_index(axis.as_flattened(), 0);
        }
        prefetch_index(self.children.as_slice(), 0);
    }
}

struct RoundedBox(Aabb);

impl Boundable for RoundedBox {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

impl Leaves {
    /// Indices of a leaf's boxes.
    pub fn items(&self, leaf: u32) -> &[u32] {
        let [start, end] = [0, 1].map(|next| self.starts[leaf as usize + next] as usize);
        &self.order[start..end]
    }

    /// How many there are.
    pub fn count(&self) -> u32 {
        self.starts.len() as u32 - 1
    }

    /// Bytes that they take.
    pub fn bytes(&self) -> usize {
        size_of_val(self.starts.as_slice()) + size_of_val(self.order.as_slice())
    }
}

impl Tree {
    /// A tree over `boxes`, and what its leaves hold.
    pub fn over(boxes: &[Bounds], rules: LeafRules) -> (Self, Leaves) {
        let mut tree = Self {
            nodes: Vec::new(),
            reach: boxes
                .iter()
                .map(|bounds| bounds.reach())
                .fold(0.0, f64::max),
            most_waiting: 0,
        };
        let mut leaves = Leaves {
            starts: vec![0],
            order: Vec::new(),
        };
        if boxes.is_empty() {
            return (tree, leaves);
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
            max_prims_per_leaf: 1,
            ..BvhBuildParams::very_slow_build()
        };
        let binary = build_bvh2(&rounded, params, &mut Duration::default());
        let folding = Folding::of(&binary, rules);
        tree.fold(&binary.nodes, &folding, 0, 0, &mut leaves);
        (tree, leaves)
    }

    /// Bytes that the tree takes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
    }

    /// Adds a node for a part of the binary tree, and all below it, while so many children wait; returns its number.
    fn fold(
        &mut self,
        binary: &[Bvh2Node],
        folding: &Folding,
        top: usize,
        waiting: usize,
        leaves: &mut Leaves,
    ) -> u32 {
        let children = folding.children(top);
        let waiting = waiting + children.len() - 1;
        self.most_waiting = self.most_waiting.max(waiting);
        let number = self.nodes.len();
        self.nodes.push(Node {
            boxes: side_by_side(children.iter().map(|&child| &binary[child].aabb)),
            children: [0; WIDTH],
        });
        for (lane, child) in children.into_iter().enumerate() {
            self.nodes[number].children[lane] = if folding.is_leaf(child) {
                folding.add_items(child, &mut leaves.order);
                leaves.starts.push(leaves.order.len() as u32);
                IS_LEAF | (leaves.count() - 1)
            } else {
                self.fold(binary, folding, child, waiting, leaves)
            };
        }
        number as u32
    }

    /// Visits the leaves that the ray may enter before the limit, in units of its direction: roughly from near to far
    /// where `SORTED`, else in any order. `visit` takes the room that is left for children that wait, and returns the limit
    /// from then on; one below 0 ends the walk. `fetch` is told of leaves that are to be visited later.
    #[inline(always)]
    pub fn walk<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        waiting: &mut [u64],
        ray: &Ray,
        limit: f64,
        mut visit: impl FnMut(&mut [u64], u32) -> f64,
        fetch: impl Fn(u32),
    ) {
        if self.nodes.is_empty() {
            return;
        }
        let ray = SlabRay::new(ray.origin, ray.direction, self.reach);
        let mut limit = limit as f32;
        let mut count = 0;
        let mut child = 0;
        loop {
            if child & IS_LEAF != 0 {
                limit = visit(&mut waiting[count..], child & !IS_LEAF) as f32;
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
                        match farther as u32 {
                            leaf if leaf & IS_LEAF != 0 => fetch(leaf & !IS_LEAF),
                            node => self.nodes[node as usize].fetch(),
                        }
                        // Insertion sort: there are seven at most, and mostly one or two. The nearest comes last.
                        let mut at = count;
                        while SORTED && at > first && waiting[at - 1] < farther {
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

fn side_by_side<'a>(children: impl Iterator<Item = &'a Aabb>) -> Boxes {
    let empty = Aabb {
        min: [f32::INFINITY; 3].into(),
        max: [f32::NEG_INFINITY; 3].into(),
    };
    let mut lanes = [&empty; WIDTH];
    for (lane, child) in lanes.iter_mut().zip(children) {
        *lane = child;
    }
    Boxes(std::array::from_fn(|axis| {
        [
            lanes.map(|child| child.min.to_array()[axis]),
            lanes.map(|child| child.max.to_array()[axis]),
        ]
    }))
}
