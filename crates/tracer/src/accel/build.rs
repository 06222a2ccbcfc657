//! How trees grow: with [`crate::accel::binary_tree`] and [`crate::accel::collapse`] all that knows obvhs.
//!
//! A binary tree is built, which is folded into nodes of sixteen children with full-precision boxes. The triangle
//! tests of obvhs leave holes along shared edges, its two-level traversal drops instances and its eight-wide nodes ignore what is
//! nearer than 1e-4, so traversal, intersections and the second level are this crate's own.

use glam::DVec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::node::Bvh2Node;

use crate::accel::binary_tree::{clustered, improve};
use crate::accel::bvh::{Child, Node, Tree};
use crate::accel::collapse::{Folding, LeafRules};
use crate::accel::lanes::{Boxes, WIDTH};
use crate::accel::pages::Pages;
use crate::geometry::aabb::Bounds;

/// Trees that are still growing.
#[derive(Default)]
pub(crate) struct Growth {
    nodes: Vec<Node>,
    reach: f64,
    pub most_waiting: usize,
}

/// A part of the binary tree that is to become a child.
struct Due {
    part: usize,
    /// The number and the lane of the node that it is a child of.
    parent: Option<(usize, usize)>,
    /// Children that wait while a walk is in it.
    waiting: usize,
}

impl Growth {
    /// Nothing can be added any more.
    pub fn finish(self) -> Tree {
        Tree {
            nodes: Pages::of(self.nodes),
            reach: self.reach,
            most_waiting: self.most_waiting,
        }
    }

    /// Adds nodes over `boxes`, of which there is at least one; returns the topmost. `child` names what becomes of boxes that
    /// may share a leaf: a leaf, or where leaves are of one box also a node that there was before. While a walk is in such a
    /// node, up to `waiting` children wait.
    pub fn grow(
        &mut self,
        boxes: &[Bounds],
        rules: LeafRules,
        waiting: usize,
        mut child: impl FnMut(&[u32]) -> Child,
    ) -> Child {
        let reach = boxes.iter().map(|bounds| bounds.reach());
        self.reach = reach.fold(self.reach, f64::max);
        let rounded: Vec<Aabb> = boxes
            .iter()
            .map(|bounds| Aabb::new(bounds.min.as_vec3().into(), bounds.max.as_vec3().into()))
            .collect();
        let mut binary = clustered(&rounded);
        improve(&mut binary);
        let folding = Folding::of(&binary, rules);
        self.fold(&binary.nodes, &folding, 0, waiting, &mut child)
    }

    /// Children that together hold all that is below the root: of all nodes the largest is replaced by its children, until
    /// there are at least so many.
    pub fn opened(&self, count: usize) -> Vec<(Bounds, Child)> {
        let mut opened = self.below(Child::ROOT);
        while opened.len() < count {
            let nodes = opened.iter().enumerate();
            let largest = nodes
                .filter(|(_, (_, child))| child.leaf_number().is_none())
                .max_by(|(_, (a, _)), (_, (b, _))| a.half_area().total_cmp(&b.half_area()));
            let Some((largest, _)) = largest else {
                break;
            };
            let (_, node) = opened.swap_remove(largest);
            opened.extend(self.below(node));
        }
        opened
    }

    /// A node's children with their boxes.
    fn below(&self, Child(node): Child) -> Vec<(Bounds, Child)> {
        let Node { boxes, children } = &self.nodes[node as usize];
        (0..WIDTH)
            .map(|lane| {
                let [min, max] = [0, 1].map(|side| {
                    let corner = [0, 1, 2].map(|axis| f64::from(boxes.0[axis][side][lane]));
                    DVec3::from_array(corner)
                });
                (Bounds { min, max }, children[lane])
            })
            .filter(|(bounds, _)| bounds.min.x <= bounds.max.x)
            .collect()
    }

    /// Adds a node for a part of the binary tree, and all below it, while so many children wait.
    fn fold(
        &mut self,
        binary: &[Bvh2Node],
        folding: &Folding,
        top: usize,
        waiting: usize,
        child: &mut impl FnMut(&[u32]) -> Child,
    ) -> Child {
        let root = self.nodes.len();
        let mut due = vec![Due {
            part: top,
            parent: None,
            waiting,
        }];
        while let Some(Due {
            part,
            parent,
            waiting,
        }) = due.pop()
        {
            let made = if parent.is_some() && folding.is_leaf(part) {
                child(&folding.items(part))
            } else {
                let parts = folding.children(part);
                let waiting = waiting + parts.len() - 1;
                self.most_waiting = self.most_waiting.max(waiting);
                let number = self.nodes.len();
                self.nodes.push(Node {
                    boxes: side_by_side(parts.iter().map(|&part| &binary[part].aabb)),
                    children: [Child::ROOT; WIDTH],
                });
                due.extend(parts.into_iter().enumerate().rev().map(|(lane, part)| Due {
                    part,
                    parent: Some((number, lane)),
                    waiting,
                }));
                Child(number as u32)
            };
            if let Some((number, lane)) = parent {
                self.nodes[number].children[lane] = made;
            }
        }
        Child(root as u32)
    }
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
