//! The bounding volume hierarchy: how rays walk through it.

use bytemuck::{Pod, Zeroable};
use prefetch_index::prefetch_index;

use crate::accel::build::Growth;
use crate::accel::collapse::LeafRules;
use crate::accel::lanes::{Boxes, Lanes, SlabRay, WIDTH};
use crate::accel::pages::Pages;
use crate::geometry::aabb::Bounds;
use crate::geometry::ray::Ray;

/// Wide trees over boxes, which may share what is below their topmost nodes.
pub(crate) struct Tree {
    pub nodes: Pages<Node>,
    /// The greatest coordinate of any box, metres.
    pub reach: f64,
    /// Children that may wait while a ray is in another: the room that a walk needs.
    pub most_waiting: usize,
}

/// A node or a leaf, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(transparent)]
pub(crate) struct Child(pub u32);

/// Set in a child that is a leaf; the rest is the leaf's number.
const IS_LEAF: u32 = 1 << 31;

/// What a tree's leaves hold. Leaves are numbered from 0.
pub(crate) struct Leaves {
    /// Per leaf and one past the last, where its items begin in `order`.
    starts: Vec<u32>,
    order: Vec<u32>,
}

#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C, align(32))]
pub(crate) struct Node {
    pub boxes: Boxes,
    /// Those of unused lanes have no meaning.
    pub children: [Child; WIDTH],
}

impl Child {
    /// The topmost node of a tree that was made at once.
    pub const ROOT: Child = Child(0);

    /// Bits that a leaf's number may have.
    pub const LEAF_BITS: u32 = 31;

    pub fn leaf(number: u32) -> Self {
        assert!(number < IS_LEAF, "a leaf's number has 31 bits");
        Self(IS_LEAF | number)
    }

    /// None for a node.
    pub fn leaf_number(self) -> Option<u32> {
        (self.0 & IS_LEAF != 0).then_some(self.0 & !IS_LEAF)
    }
}

impl Node {
    /// Has the processor fetch it from memory, to be there when it is visited.
    #[inline(always)]
    fn fetch(&self) {
        for axis in &self.boxes.0 {
            for side in axis {
                prefetch_index(side, 0);
            }
        }
        prefetch_index(self.children.as_slice(), 0);
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
        let mut growth = Growth::default();
        let mut leaves = Leaves {
            starts: vec![0],
            order: Vec::new(),
        };
        if !boxes.is_empty() {
            growth.grow(boxes, rules, 0, |items| {
                leaves.order.extend(items);
                leaves.starts.push(leaves.order.len() as u32);
                Child::leaf(leaves.count() - 1)
            });
        }
        (growth.finish(), leaves)
    }

    /// Bytes that the tree takes.
    pub fn bytes(&self) -> usize {
        size_of_val::<[Node]>(&self.nodes)
    }

    /// Visits the leaves below a node that the ray may enter before the limit, in units of its direction: roughly from near to far
    /// where `SORTED`, else in any order. `visit` takes the room that is left for children that wait, and returns the limit
    /// from then on; one below 0 ends the walk. `fetch` is told of leaves that are to be visited later.
    #[inline(always)]
    pub fn walk<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        waiting: &mut [u64],
        (ray, Child(root)): (&Ray, Child),
        limit: f64,
        mut visit: impl FnMut(&mut [u64], u32) -> f64,
        fetch: impl Fn(u32),
    ) {
        let nodes: &[Node] = &self.nodes;
        if nodes.is_empty() {
            return;
        }
        let ray = SlabRay::new(ray.origin, ray.direction, self.reach);
        let mut limit = limit as f32;
        let mut count = 0;
        let mut child = root;
        loop {
            if let Some(leaf) = Child(child).leaf_number() {
                limit = visit(&mut waiting[count..], leaf) as f32;
            } else {
                let node = &nodes[child as usize];
                // Copied at once: a processor waits for memory once, not again for each child.
                let children = node.children;
                let (mut entered, near) = lanes.enter(&node.boxes, &ray, limit);
                if entered != 0 {
                    let mut next = || {
                        let lane = entered.trailing_zeros() as usize % WIDTH;
                        entered &= entered - 1;
                        (pending(children[lane].0, near[lane]), entered)
                    };
                    let first = count;
                    let (mut nearest, mut rest) = next();
                    while rest != 0 {
                        let (other, left) = next();
                        rest = left;
                        let farther = nearest.max(other);
                        nearest = nearest.min(other);
                        match Child(farther as u32).leaf_number() {
                            Some(leaf) => fetch(leaf),
                            None => nodes[farther as u32 as usize].fetch(),
                        }
                        // Insertion sort: there are fifteen at most, and mostly one or two. The nearest comes last.
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
