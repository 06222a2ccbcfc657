//! Binary trees over boxes, built in a time that does not depend on the arrangement of the boxes.
//!
//! Boxes are sorted along a curve through space. In rounds, each node looks for the neighbour with
//! which its union is smallest, and two that choose each other are merged (Meister and Bittner
//! 2018, PLOC). Among equal or nested boxes nearly all choose the same neighbour. Such a round
//! merges two nodes only: n boxes would take n rounds and make a tree as deep. Here a round that
//! merges few nodes is followed by one that merges every node with the next.
//!
//! obvhs then moves nodes to better places (Meister and Bittner 2017), up to a fixed amount of
//! work.

use glam::DVec3;
use obvhs::aabb::Aabb as Aabb32;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::bvh2::{Bvh2, DEFAULT_MAX_STACK_DEPTH};
use obvhs::ploc::morton::morton_encode_u128_unorm;

/// Neighbours on each side among which a node looks for its partner.
const NEIGHBOURS: usize = 14;
/// Nodes per merge above which a round counts as slow; the next round merges all.
const SLOW: usize = 32;
/// Passes of the optimisation, each over smaller and smaller parts of the nodes.
const PASSES: usize = 2;
/// Estimated node visits of one optimisation step at most, about a second of work.
const MAX_VISITS: f64 = 3e8;
/// Depth beyond which a tree is not optimised.
const MAX_DEPTH: usize = 2048;

/// Builds a binary tree over boxes of finite coordinates, one box per leaf.
pub(crate) fn build_binary_tree(boxes: &[Aabb32]) -> Bvh2 {
    let mut tree = Bvh2::zeroed(boxes.len());
    tree.primitive_indices = (0..boxes.len() as u32).collect();
    let mut nodes = sort_along_curve(boxes);
    let mut merged = Vec::with_capacity(nodes.len());
    // Nodes are filled in from the back.
    let mut free = tree.nodes.len();
    let mut rounds = 0;
    let mut slow = false;
    while nodes.len() > 1 {
        let partners = match rounds {
            _ if slow => pair_up(nodes.len()),
            0 => choose_of_two(&nodes),
            _ => choose_of_many(&nodes),
        };
        merged.clear();
        for (index, &partner) in partners.iter().enumerate() {
            if partner == index || partners[partner] != index {
                merged.push(nodes[index]);
            } else if partner < index {
                let [first, second] = [nodes[index], nodes[partner]];
                free -= 2;
                tree.nodes[free] = first;
                tree.nodes[free + 1] = second;
                let union = first.aabb.union(&second.aabb);
                merged.push(Bvh2Node::new(union, 0, free as u32));
            }
        }
        slow = (nodes.len() - merged.len()) * SLOW < nodes.len();
        std::mem::swap(&mut nodes, &mut merged);
        rounds += 1;
    }
    if let Some(root) = nodes.first() {
        tree.nodes[0] = *root;
    }
    tree
}

/// Moves nodes to places where boxes are smaller.
pub(crate) fn optimize(tree: &mut Bvh2) {
    let mut optimizer = ReinsertionOptimizer::default();
    for _ in 0..PASSES {
        for part in (1..32).step_by(2) {
            let Shape { depth, overlap } = Shape::of(tree);
            if depth > MAX_DEPTH {
                return;
            }
            // obvhs panics if its stack is too small.
            tree.max_depth = (depth + 1).max(DEFAULT_MAX_STACK_DEPTH);
            let affordable = MAX_VISITS / (overlap * tree.nodes.len() as f64);
            let ratio = (1.0 / part as f32).min(affordable as f32);
            optimizer.run(tree, 1.0, Some(vec![ratio]));
        }
    }
}

/// The measures of a tree that the work of optimisation depends on.
struct Shape {
    /// Nodes from the root to the deepest leaf.
    depth: usize,
    /// Mean number of nodes that a ray through the root's box enters. A search for a better place
    /// visits about as many.
    overlap: f64,
}

impl Shape {
    fn of(tree: &Bvh2) -> Self {
        let mut depths = vec![1_u32; tree.nodes.len()];
        let mut deepest = 1;
        let mut areas = 0.0;
        for node in parents_first(tree) {
            let depth = depths[node as usize];
            deepest = deepest.max(depth);
            let node = &tree.nodes[node as usize];
            areas += f64::from(node.aabb.half_area());
            if !node.is_leaf() {
                let first = node.first_index as usize;
                depths[first..first + 2].fill(depth + 1);
            }
        }
        let whole = (tree.nodes.first()).map_or(0.0, |root| f64::from(root.aabb.half_area()));
        Self {
            depth: deepest as usize,
            overlap: (areas / whole.max(f64::MIN_POSITIVE))
                .clamp(1.0, tree.nodes.len().max(1) as f64),
        }
    }
}

/// Makes leaves of the boxes and sorts them by their centres along a Morton curve; equal ones keep
/// their order.
fn sort_along_curve(boxes: &[Aabb32]) -> Vec<Bvh2Node> {
    let mut whole = Aabb32::empty();
    for each in boxes {
        whole.extend(each.min);
        whole.extend(each.max);
    }
    let scale = 1.0 / whole.diagonal().as_dvec3();
    let offset = -whole.min.as_dvec3() * scale;
    let code = |each: &Aabb32| -> u128 {
        let centre: DVec3 = each.center().as_dvec3();
        morton_encode_u128_unorm(centre * scale + offset)
    };
    let mut order: Vec<(u128, u32)> = boxes.iter().map(code).zip(0..).collect();
    order.sort_unstable();
    (order.iter())
        .map(|&(_, index)| Bvh2Node::new(boxes[index as usize], 1, index))
        .collect()
}

/// Chooses per node the better of its two neighbours.
fn choose_of_two(nodes: &[Bvh2Node]) -> Vec<usize> {
    let last = nodes.len() - 1;
    let mut before = f32::INFINITY;
    let mut partners: Vec<usize> = (0..last)
        .map(|index| {
            let cost = union_area(nodes, index, index + 1);
            let partner = if before < cost { index - 1 } else { index + 1 };
            before = cost;
            partner
        })
        .collect();
    partners.push(last - 1);
    partners
}

/// Chooses per node the best of its neighbours; the last of equally good ones.
fn choose_of_many(nodes: &[Bvh2Node]) -> Vec<usize> {
    let mut best: Vec<(f32, usize)> = (0..nodes.len())
        .map(|index| (f32::INFINITY, index))
        .collect();
    for index in 0..nodes.len() {
        for other in index + 1..nodes.len().min(index + 1 + NEIGHBOURS) {
            let cost = union_area(nodes, index, other);
            for (node, partner) in [(index, other), (other, index)] {
                if cost <= best[node].0 {
                    best[node] = (cost, partner);
                }
            }
        }
    }
    best.into_iter().map(|(_, partner)| partner).collect()
}

/// Chooses per node the other one of its pair. The last of an odd number chooses itself.
fn pair_up(count: usize) -> Vec<usize> {
    (0..count).map(|index| (index ^ 1).min(count - 1)).collect()
}

/// All nodes of a binary tree, every one before those below it. A loop, because trees may be deeper
/// than a thread's stack.
pub(crate) fn parents_first(binary: &Bvh2) -> Vec<u32> {
    let mut order = Vec::with_capacity(binary.nodes.len());
    order.extend((!binary.nodes.is_empty()).then_some(0));
    let mut next = 0;
    while let Some(&node) = order.get(next) {
        next += 1;
        let node = &binary.nodes[node as usize];
        if !node.is_leaf() {
            order.extend([node.first_index, node.first_index + 1]);
        }
    }
    order
}

fn union_area(nodes: &[Bvh2Node], one: usize, other: usize) -> f32 {
    nodes[one].aabb.union(&nodes[other].aabb).half_area()
}

#[cfg(test)]
pub(in crate::accel) mod tests {
    use super::*;

    const MANY: u32 = 200_000;
    /// Two rounds at least halve the nodes, which makes 36 levels of 200,000 boxes; optimisation
    /// adds a few.
    const SHALLOW: usize = 60;

    fn cube(centre: f32, size: f32) -> Aabb32 {
        Aabb32::new([centre - size; 3].into(), [centre + size; 3].into())
    }

    /// Boxes of all sizes here and there.
    pub(in crate::accel) fn scatter_boxes(count: u32) -> Vec<Aabb32> {
        let part = |number: u32, step: f32| (number as f32 * step).fract();
        let scattered = (0..count).map(|index| {
            let corner = [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step| part(index, step));
            let size = 0.5 * part(index, 0.618_034).powi(3);
            Aabb32::new(corner.into(), corner.map(|least| least + size).into())
        });
        scattered.collect()
    }

    /// The depth of the optimised tree, in which every box is one leaf.
    fn depth(boxes: Vec<Aabb32>) -> usize {
        let mut tree = build_binary_tree(&boxes);
        optimize(&mut tree);
        let leaves = tree.nodes.iter().filter(|node| node.is_leaf());
        let mut items: Vec<u32> = leaves.map(|leaf| leaf.first_index).collect();
        items.sort_unstable();
        assert!(items.into_iter().eq(0..boxes.len() as u32));
        for node in tree.nodes.iter().filter(|node| !node.is_leaf()) {
            let first = node.first_index as usize;
            let below = tree.nodes[first].aabb.union(&tree.nodes[first + 1].aabb);
            assert_eq!((below.min, below.max), (node.aabb.min, node.aabb.max));
        }
        Shape::of(&tree).depth
    }

    #[track_caller]
    fn assert_depth(boxes: Vec<Aabb32>, most: usize) {
        let levels = depth(boxes);
        assert!(
            levels <= most,
            "the tree is {levels} nodes deep, not {most}"
        );
    }

    #[test]
    fn no_boxes_and_one_make_a_tree() {
        assert_eq!(build_binary_tree(&[]).nodes.len(), 0);
        assert_eq!(depth(vec![cube(0.0, 1.0)]), 1);
    }

    #[test]
    fn equal_boxes_make_a_tree_that_is_not_deep() {
        assert_depth(vec![cube(0.0, 1.0); MANY as usize], SHALLOW);
    }

    #[test]
    fn boxes_without_volume_make_a_tree_that_is_not_deep() {
        assert_depth(vec![cube(3.0, 0.0); MANY as usize], SHALLOW);
        let on_a_line = (0..MANY).map(|x| {
            let [min, max] = [x as f32, x as f32 + 1.0].map(|x| [x, 0.0, 0.0].into());
            Aabb32::new(min, max)
        });
        assert_depth(on_a_line.collect(), 100);
    }

    #[test]
    fn nested_boxes_make_a_tree_that_is_far_less_deep_than_they_are_many() {
        let nested = (1..=MANY).map(|size| cube(0.0, size as f32));
        // Optimisation makes a chain of them, in which rays enter fewest boxes. It ends beyond
        // MAX_DEPTH; its last pass may have added as much again.
        assert_depth(nested.collect(), 2 * MAX_DEPTH);
        // Each twice as large as the one before, from the smallest to the largest with an area in
        // 32 bits.
        let growing = (0..100).map(|size| cube(0.0, 2_f32.powi(size - 50)));
        assert_depth(growing.collect(), 100);
    }

    #[test]
    fn boxes_here_and_there_make_a_tree_that_is_not_deep() {
        assert_depth(scatter_boxes(20_000), 60);
    }
}
