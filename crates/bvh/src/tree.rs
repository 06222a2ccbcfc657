//! Bounding volume hierarchies of wide nodes, and their traversal.

use prefetch_index::prefetch_index;

use crate::lanes::{Boxes, Lanes, SlabRay, WIDTH};
use crate::ray::Ray;

/// Wide trees over boxes, which may share what is below their topmost nodes.
pub struct Tree {
    pub(crate) nodes: Vec<Node>,
    /// Greatest coordinate of any box, metres.
    pub(crate) largest_coordinate: f64,
    /// Size of the stack that a traversal needs.
    pub stack_size: usize,
}

/// A node or a leaf, by its number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Child(pub(crate) u32);

/// Bit that is set in a child that is a leaf. The rest is the leaf's number.
const IS_LEAF: u32 = 1 << 31;

/// The items of a tree's leaves. Leaves are numbered from 0.
pub struct Leaves {
    /// Per leaf and one past the last, the place in `order` where its items begin.
    pub(crate) starts: Vec<u32>,
    pub(crate) order: Vec<u32>,
}

/// Boxes and children of a wide node.
#[derive(Clone, Copy)]
#[repr(C, align(32))]
pub(crate) struct Node {
    pub boxes: Boxes,
    /// Children per lane; those of unused lanes have no meaning.
    pub children: [Child; WIDTH],
}

impl Child {
    /// The topmost node of a tree that was built first.
    pub const ROOT: Child = Child(0);

    /// Bits that a leaf's number may have.
    pub const LEAF_BITS: u32 = 31;

    /// A leaf of this number.
    pub fn leaf(number: u32) -> Self {
        assert!(number < IS_LEAF, "a leaf's number has 31 bits");
        Self(IS_LEAF | number)
    }

    /// The leaf's number; none for a node.
    pub fn leaf_number(self) -> Option<u32> {
        (self.0 & IS_LEAF != 0).then_some(self.0 & !IS_LEAF)
    }
}

impl Node {
    /// Prefetches the node from memory.
    #[inline(always)]
    fn prefetch(&self) {
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

    /// Number of leaves.
    pub fn count(&self) -> u32 {
        self.starts.len() as u32 - 1
    }
}

impl Tree {
    /// Visits the leaves below a node that the ray may enter before the limit, in units of its
    /// direction: roughly from near to far if `SORTED`, else in any order.
    ///
    /// `visit` takes the free part of the stack and returns the new limit; one below 0 ends the
    /// traversal. `prefetch` gets the leaves that are pushed on the stack.
    #[inline(always)]
    pub fn traverse<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        stack: &mut [u64],
        (ray, Child(root)): (&Ray, Child),
        limit: f64,
        mut visit: impl FnMut(&mut [u64], u32) -> f64,
        prefetch: impl Fn(u32),
    ) {
        let nodes: &[Node] = &self.nodes;
        if nodes.is_empty() {
            return;
        }
        let ray = SlabRay::new(ray.origin, ray.direction, self.largest_coordinate);
        let mut limit = limit as f32;
        let mut count = 0;
        let mut child = root;
        loop {
            if let Some(leaf) = Child(child).leaf_number() {
                limit = visit(&mut stack[count..], leaf) as f32;
            } else {
                let node = &nodes[child as usize];
                // Copied at once, so that the processor waits for memory once and not for each
                // child.
                let children = node.children;
                let (mut entered, near) = lanes.enter(&node.boxes, &ray, limit);
                if entered != 0 {
                    let mut next = || {
                        let lane = entered.trailing_zeros() as usize % WIDTH;
                        entered &= entered - 1;
                        (stack_entry(children[lane].0, near[lane]), entered)
                    };
                    let first = count;
                    let (mut nearest, mut rest) = next();
                    while rest != 0 {
                        let (other, left) = next();
                        rest = left;
                        let farther = nearest.max(other);
                        nearest = nearest.min(other);
                        match Child(farther as u32).leaf_number() {
                            Some(leaf) => prefetch(leaf),
                            None => nodes[farther as u32 as usize].prefetch(),
                        }
                        // Insertion sort, of fifteen at most and mostly of one or two. The nearest
                        // comes last.
                        let mut at = count;
                        while SORTED && at > first && stack[at - 1] < farther {
                            stack[at] = stack[at - 1];
                            at -= 1;
                        }
                        stack[at] = farther;
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
                if entry_distance(stack[count]) <= limit {
                    break stack[count] as u32;
                }
            };
        }
    }
}

/// A child, and the distance at which the ray enters it. Entries sort by their distances, which are
/// not negative.
#[inline(always)]
fn stack_entry(child: u32, near: f32) -> u64 {
    u64::from(near.to_bits()) << 32 | u64::from(child)
}

/// The distance of a [`stack_entry`].
#[inline(always)]
fn entry_distance(entry: u64) -> f32 {
    f32::from_bits((entry >> 32) as u32)
}
