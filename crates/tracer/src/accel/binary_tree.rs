//! Binary trees over boxes, built in a time that no arrangement of the boxes prolongs.
//!
//! Boxes are sorted along a curve through space. In rounds, each looks for the neighbour with which its union is smallest,
//! and two that choose each other are joined (Meister and Bittner 2018, PLOC). Among equal or nested boxes nearly all choose
//! the same: such a round joins two of them and leaves the rest, so that n boxes take n rounds and make a tree as deep.
//! Here a round that joins few is followed by one that joins every node with the next. The finished tree is improved by
//! moving nodes to better places (Meister and Bittner 2017), by obvhs, as far as a fixed amount of work goes.

use glam::DVec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::bvh2::{Bvh2, DEFAULT_MAX_STACK_DEPTH};
use obvhs::ploc::morton::morton_encode_u128_unorm;

use crate::accel::collapse::parents_first;

/// Neighbours on either side among which a node looks for its partner.
const NEIGHBOURS: usize = 14;
/// A round that joins fewer than one node of so many is followed by one that joins all.
const SLOW: usize = 32;
/// Passes over all nodes, each looking for better places for ever fewer of them.
const IMPROVEMENTS: usize = 2;
/// Nodes that one round of improvement may look at, as far as that is known before: about a second of work.
const MOST_LOOKS: f64 = 3e8;
/// Deeper trees are left as they are.
const DEEPEST: usize = 2048;

/// A binary tree over boxes, of finite coordinates; one box per leaf.
pub(crate) fn clustered(boxes: &[Aabb]) -> Bvh2 {
    let mut tree = Bvh2::zeroed(boxes.len());
    tree.primitive_indices = (0..boxes.len() as u32).collect();
    let mut nodes = along_a_curve(boxes);
    let mut joined = Vec::with_capacity(nodes.len());
    // Filled from the back.
    let mut free = tree.nodes.len();
    let mut rounds = 0;
    let mut slow = false;
    while nodes.len() > 1 {
        let partners = match rounds {
            _ if slow => every_next(nodes.len()),
            0 => better_of_two(&nodes),
            _ => best_of_many(&nodes),
        };
        joined.clear();
        for (index, &partner) in partners.iter().enumerate() {
            if partner == index || partners[partner] != index {
                joined.push(nodes[index]);
            } else if partner < index {
                let [first, second] = [nodes[index], nodes[partner]];
                free -= 2;
                tree.nodes[free] = first;
                tree.nodes[free + 1] = second;
                let union = first.aabb.union(&second.aabb);
                joined.push(Bvh2Node::new(union, 0, free as u32));
            }
        }
        slow = (nodes.len() - joined.len()) * SLOW < nodes.len();
        std::mem::swap(&mut nodes, &mut joined);
        rounds += 1;
    }
    if let Some(root) = nodes.first() {
        tree.nodes[0] = *root;
    }
    tree
}

/// Moves nodes to places where boxes are smaller.
pub(crate) fn improve(tree: &mut Bvh2) {
    let mut optimizer = ReinsertionOptimizer::default();
    for _ in 0..IMPROVEMENTS {
        for part in (1..32).step_by(2) {
            let Shape { depth, overlap } = Shape::of(tree);
            if depth > DEEPEST {
                return;
            }
            // obvhs ends the program where its room for nodes that wait is too small.
            tree.max_depth = (depth + 1).max(DEFAULT_MAX_STACK_DEPTH);
            let affordable = MOST_LOOKS / (overlap * tree.nodes.len() as f64);
            let ratio = (1.0 / part as f32).min(affordable as f32);
            optimizer.run(tree, 1.0, Some(vec![ratio]));
        }
    }
}

/// What the work on a tree depends on.
struct Shape {
    /// Nodes from the root to the deepest leaf.
    depth: usize,
    /// Nodes that a ray through the root's box enters on average: those that a search for a better place looks at are about as
    /// many.
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

/// The boxes as leaves, in the order of their centres along a Z-shaped curve; equal ones in their own.
fn along_a_curve(boxes: &[Aabb]) -> Vec<Bvh2Node> {
    let mut whole = Aabb::empty();
    for each in boxes {
        whole.extend(each.min);
        whole.extend(each.max);
    }
    let scale = 1.0 / whole.diagonal().as_dvec3();
    let offset = -whole.min.as_dvec3() * scale;
    let code = |each: &Aabb| -> u128 {
        let centre: DVec3 = each.center().as_dvec3();
        morton_encode_u128_unorm(centre * scale + offset)
    };
    let mut order: Vec<(u128, u32)> = boxes.iter().map(code).zip(0..).collect();
    order.sort_unstable();
    (order.iter())
        .map(|&(_, index)| Bvh2Node::new(boxes[index as usize], 1, index))
        .collect()
}

/// Per node its better neighbour.
fn better_of_two(nodes: &[Bvh2Node]) -> Vec<usize> {
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

/// Per node the best of its neighbours; the last of equally good ones.
fn best_of_many(nodes: &[Bvh2Node]) -> Vec<usize> {
    let mut best: Vec<(f32, usize)> = (0..nodes.len()).map(|own| (f32::INFINITY, own)).collect();
    for index in 0..nodes.len() {
        for other in index + 1..nodes.len().min(index + 1 + NEIGHBOURS) {
            let cost = union_area(nodes, index, other);
            for (own, partner) in [(index, other), (other, index)] {
                if cost <= best[own].0 {
                    best[own] = (cost, partner);
                }
            }
        }
    }
    best.into_iter().map(|(_, partner)| partner).collect()
}

/// Per node the other of its pair; the last has none where they are odd in number.
fn every_next(count: usize) -> Vec<usize> {
    (0..count).map(|index| (index ^ 1).min(count - 1)).collect()
}

fn union_area(nodes: &[Bvh2Node], one: usize, other: usize) -> f32 {
    nodes[one].aabb.union(&nodes[other].aabb).half_area()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MANY: u32 = 200_000;
    /// Two rounds halve the nodes at least, which makes 36 levels of 200,000 boxes; improvement adds a few.
    const SHALLOW: usize = 60;

    fn cube(centre: f32, size: f32) -> Aabb {
        Aabb::new([centre - size; 3].into(), [centre + size; 3].into())
    }

    /// The improved tree, of which every box is one leaf; its depth.
    fn depth(boxes: Vec<Aabb>) -> usize {
        let mut tree = clustered(&boxes);
        improve(&mut tree);
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
    fn assert_depth(boxes: Vec<Aabb>, most: usize) {
        let found = depth(boxes);
        assert!(found <= most, "the tree is {found} nodes deep, not {most}");
    }

    #[test]
    fn no_boxes_and_one_make_a_tree() {
        assert_eq!(clustered(&[]).nodes.len(), 0);
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
            Aabb::new(min, max)
        });
        assert_depth(on_a_line.collect(), 100);
    }

    #[test]
    fn nested_boxes_make_a_tree_that_is_far_less_deep_than_they_are_many() {
        let nested = (1..=MANY).map(|size| cube(0.0, size as f32));
        // Improvement makes a chain of them, which is where rays enter fewest boxes. It ends beyond DEEPEST; its last pass may
        // have added as much again.
        assert_depth(nested.collect(), 2 * DEEPEST);
        // Each twice as large as the one before: the smallest and the largest that 32 bits allow an area of.
        let growing = (0..100).map(|size| cube(0.0, 2_f32.powi(size - 50)));
        assert_depth(growing.collect(), 100);
    }

    #[test]
    fn boxes_here_and_there_make_a_tree_that_is_not_deep() {
        let part = |number: u32, step: f32| (number as f32 * step).fract();
        let scattered = (0..20_000).map(|index| {
            let corner = [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step| part(index, step));
            let size = 0.5 * part(index, 0.618_034).powi(3);
            Aabb::new(corner.into(), corner.map(|least| least + size).into())
        });
        assert_depth(scattered.collect(), 60);
    }
}
