//! The build of wide trees.
//!
//! A binary tree is built ([`crate::binary_tree`]) and collapsed ([`crate::collapse`]) into nodes of
//! sixteen children with full-precision boxes. Only these three files use obvhs. Its triangle tests
//! leave holes along shared edges, its two-level traversal drops instances, and its eight-wide nodes
//! ignore hits nearer than 1e-4. Collapse, traversal, intersections and the second level are
//! therefore this crate's.

use glam::DVec3;
use obvhs::aabb::Aabb as Aabb32;
use obvhs::bvh2::node::Bvh2Node;

use crate::aabb::Aabb;
use crate::binary_tree::{build_binary_tree, optimize};
use crate::collapse::{Collapse, LeafRules};
use crate::lanes::{Boxes, WIDTH};
use crate::tree::{Child, Leaves, Node, Tree};

/// Builds a tree over `boxes`; returns it with the items of its leaves.
pub fn build_tree(boxes: &[Aabb], rules: LeafRules) -> (Tree, Leaves) {
    let mut builder = TreeBuilder::default();
    let mut leaves = Leaves {
        starts: vec![0],
        order: Vec::new(),
    };
    if !boxes.is_empty() {
        builder.add_tree(boxes, rules, 0, |items| {
            leaves.order.extend(items);
            leaves.starts.push(leaves.order.len() as u32);
            Child::leaf(leaves.count() - 1)
        });
    }
    (builder.finish(), leaves)
}

/// A builder of trees that share their nodes.
#[derive(Default)]
pub(crate) struct TreeBuilder {
    nodes: Vec<Node>,
    largest_coordinate: f64,
    pub stack_size: usize,
}

/// A binary node that is to become a child.
struct Pending {
    binary_node: usize,
    /// Number of the parent node, and the lane in it.
    parent: Option<(usize, usize)>,
    /// Entries on the stack while a traversal is in it.
    stack_size: usize,
}

impl TreeBuilder {
    /// Ends the build.
    pub fn finish(self) -> Tree {
        Tree {
            nodes: self.nodes,
            largest_coordinate: self.largest_coordinate,
            stack_size: self.stack_size,
        }
    }

    /// Adds nodes over at least one box; returns the topmost node.
    ///
    /// `child` makes the child for boxes that share a leaf. If leaves have one box, it may also be
    /// a node that was built before; a traversal of such a node needs up to `stack_size` entries.
    pub fn add_tree(
        &mut self,
        boxes: &[Aabb],
        rules: LeafRules,
        stack_size: usize,
        mut child: impl FnMut(&[u32]) -> Child,
    ) -> Child {
        let coordinates = boxes.iter().map(|aabb| aabb.largest_coordinate());
        self.largest_coordinate = coordinates.fold(self.largest_coordinate, f64::max);
        let mut binary = build_binary_tree(boxes);
        optimize(&mut binary);
        let collapse = Collapse::new(&binary, rules);
        self.add_nodes(&binary.nodes, &collapse, stack_size, &mut child)
    }

    /// Children that together hold everything below the root. The largest node is replaced by its
    /// children until there are at least `count`.
    pub fn topmost(&self, count: usize) -> Vec<(Aabb, Child)> {
        let mut topmost = self.children(Child::ROOT);
        while topmost.len() < count {
            let nodes = topmost.iter().enumerate();
            let largest = nodes
                .filter(|(_, (_, child))| child.leaf_number().is_none())
                .max_by(|(_, (a, _)), (_, (b, _))| a.half_area().total_cmp(&b.half_area()));
            let Some((largest, _)) = largest else {
                break;
            };
            let (_, node) = topmost.swap_remove(largest);
            topmost.extend(self.children(node));
        }
        topmost
    }

    /// The children of a node, with their boxes.
    fn children(&self, Child(node): Child) -> Vec<(Aabb, Child)> {
        let Node { boxes, children } = &self.nodes[node as usize];
        (0..WIDTH)
            .map(|lane| {
                let [min, max] = [0, 1].map(|side| {
                    let corner = [0, 1, 2].map(|axis| f64::from(boxes.0[axis][side][lane]));
                    DVec3::from_array(corner)
                });
                (Aabb { min, max }, children[lane])
            })
            .filter(|(aabb, _)| aabb.min.x <= aabb.max.x)
            .collect()
    }

    /// Adds the nodes of a collapsed binary tree. The stack already has `stack_size` entries above
    /// its root.
    fn add_nodes(
        &mut self,
        binary: &[Bvh2Node],
        collapse: &Collapse,
        stack_size: usize,
        child: &mut impl FnMut(&[u32]) -> Child,
    ) -> Child {
        let root = self.nodes.len();
        let mut pending = vec![Pending {
            binary_node: 0,
            parent: None,
            stack_size,
        }];
        while let Some(Pending {
            binary_node,
            parent,
            stack_size,
        }) = pending.pop()
        {
            let added = if parent.is_some() && collapse.is_leaf(binary_node) {
                child(&collapse.items(binary_node))
            } else {
                let below = collapse.children(binary_node);
                let stack_size = stack_size + below.len() - 1;
                self.stack_size = self.stack_size.max(stack_size);
                let number = self.nodes.len();
                self.nodes.push(Node {
                    boxes: pack_boxes(below.iter().map(|&node| &binary[node].aabb)),
                    children: [Child::ROOT; WIDTH],
                });
                let below = below.into_iter().enumerate().rev();
                pending.extend(below.map(|(lane, binary_node)| Pending {
                    binary_node,
                    parent: Some((number, lane)),
                    stack_size,
                }));
                Child(number as u32)
            };
            if let Some((number, lane)) = parent {
                self.nodes[number].children[lane] = added;
            }
        }
        Child(root as u32)
    }
}

/// Packs the boxes of a node's children side by side.
fn pack_boxes<'a>(children: impl Iterator<Item = &'a Aabb32>) -> Boxes {
    let empty = Aabb32 {
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
