//! Binary trees over boxes, built by obvhs.
//!
//! obvhs sorts the boxes along a curve through space. In rounds, each node looks for the neighbour
//! with which its union is smallest, and two that choose each other are merged (Meister and Bittner
//! 2018, PLOC). obvhs then moves nodes to better places (Meister and Bittner 2017), up to a fixed
//! amount of work. Its feature `parallel` is off, so the tree is the same on any number of threads.
//!
//! Among equal or nested boxes nearly all nodes choose the same neighbour, and a round merges two
//! of them only: n boxes would take n rounds and make a tree as deep. obvhs therefore sees each box
//! moved by a thousandth of its size, in a direction that depends on its index. The finished tree
//! has the boxes themselves, rounded outwards to 32 bits.

use glam::DVec3;
use obvhs::aabb::Aabb as Aabb32;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::bvh2::{Bvh2, DEFAULT_MAX_STACK_DEPTH};
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use crate::aabb::Aabb;

/// Rounds in which nodes choose between their two neighbours only.
const SHORT_ROUNDS: usize = 1;
/// Part of its size by which a box is moved.
const SHIFT: f64 = 1e-3;
/// Least part of all boxes' size by which one is moved: 32 bits hold some thirty steps of it.
const LEAST_SHIFT: f64 = 2e-6;
/// Passes of the optimisation, each over smaller and smaller parts of the nodes.
const PASSES: usize = 2;
/// Estimated node visits of one optimisation step at most, about a second of work.
const MAX_VISITS: f64 = 3e8;
/// Depth beyond which a tree is not optimised.
const MAX_DEPTH: usize = 2048;

/// Builds a binary tree over boxes of finite coordinates, one box per leaf.
pub(crate) fn build_binary_tree(boxes: &[Aabb]) -> Bvh2 {
    let mut tree = PlocBuilder::new().build(
        PlocSearchDistance::Medium,
        &move_apart(boxes),
        (0..boxes.len() as u32).collect(),
        SortPrecision::U128,
        SHORT_ROUNDS,
    );
    for node in tree.nodes.iter_mut().filter(|node| node.is_leaf()) {
        node.aabb = round_outwards(&boxes[node.first_index as usize]);
    }
    tree.refit_all();
    tree
}

/// Scales the boxes into a unit cube around the origin and moves each in a direction of its own.
fn move_apart(boxes: &[Aabb]) -> Vec<Aabb32> {
    let whole = (boxes.iter()).fold(Aabb::EMPTY, |union, aabb| union.union(*aabb));
    let scale = 1.0 / (whole.max - whole.min).max_element().max(f64::MIN_POSITIVE);
    let moved = boxes.iter().zip(0..).map(|(aabb, index)| {
        let [min, max] = [aabb.min, aabb.max].map(|corner| (corner - whole.centre()) * scale);
        let shift = (SHIFT * (max - min).max_element()).max(LEAST_SHIFT) * chance(index);
        let [min, max] = [min, max].map(|corner| (corner + shift).as_vec3a());
        Aabb32 { min, max }
    });
    moved.collect()
}

/// The smallest box of 32-bit coordinates around a box.
fn round_outwards(aabb: &Aabb) -> Aabb32 {
    let round_up = |coordinate: f64| {
        let rounded = coordinate as f32;
        if f64::from(rounded) < coordinate {
            rounded.next_up()
        } else {
            rounded
        }
    };
    Aabb32 {
        min: (aabb.min.to_array()).map(|least| -round_up(-least)).into(),
        max: aabb.max.to_array().map(round_up).into(),
    }
}

/// Three numbers between 0 and 1 that depend on an index and look like chance (Steele, Lea and
/// Flood 2014, SplitMix).
fn chance(index: u64) -> DVec3 {
    let mut bits = (index + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ bits >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ bits >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^= bits >> 31;
    let part = |from: u32| (bits >> from & 0x1f_ffff) as f64 / f64::from(1 << 21);
    DVec3::new(part(0), part(21), part(42))
}

/// Moves nodes to places where boxes are smaller.
pub fn optimize(tree: &mut Bvh2) {
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

/// All nodes of a binary tree, every one before those below it. A loop, because trees may be deeper
/// than a thread's stack.
pub fn parents_first(binary: &Bvh2) -> Vec<u32> {
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

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    const MANY: u32 = 200_000;
    /// Two rounds at least halve the nodes, which makes 36 levels of 200,000 boxes; optimisation
    /// adds a few.
    const SHALLOW: usize = 60;

    fn cube(centre: f64, size: f64) -> Aabb {
        Aabb {
            min: DVec3::splat(centre - size),
            max: DVec3::splat(centre + size),
        }
    }

    /// Boxes of all sizes here and there.
    pub(crate) fn scatter_boxes(count: u32) -> Vec<Aabb> {
        let part = |number: u32, step: f64| (f64::from(number) * step).fract();
        let scattered = (0..count).map(|index| {
            let corner = [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step| part(index, step));
            let size = 0.5 * part(index, 0.618_034).powi(3);
            let min = DVec3::from_array(corner);
            Aabb {
                min,
                max: min + size,
            }
        });
        scattered.collect()
    }

    /// The depth of the optimised tree, in which every box is one leaf.
    fn depth(boxes: Vec<Aabb>) -> usize {
        let mut tree = build_binary_tree(&boxes);
        optimize(&mut tree);
        let leaves = || tree.nodes.iter().filter(|node| node.is_leaf());
        for leaf in leaves() {
            let Aabb { min, max } = boxes[leaf.first_index as usize];
            assert!(leaf.aabb.min.as_dvec3().cmple(min).all());
            assert!(leaf.aabb.max.as_dvec3().cmpge(max).all());
        }
        let mut items: Vec<u32> = leaves().map(|leaf| leaf.first_index).collect();
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
            let min = DVec3::new(f64::from(x), 0.0, 0.0);
            Aabb {
                min,
                max: min + DVec3::X,
            }
        });
        assert_depth(on_a_line.collect(), 100);
    }

    #[test]
    fn nested_boxes_make_a_tree_that_is_far_less_deep_than_they_are_many() {
        let nested = (1..=MANY).map(|size| cube(0.0, f64::from(size)));
        // Optimisation makes a chain of them, in which rays enter fewest boxes. It ends beyond
        // MAX_DEPTH; its last pass may have added as much again.
        assert_depth(nested.collect(), 2 * MAX_DEPTH);
        // Each twice as large as the one before, from the smallest to the largest with an area in
        // 32 bits.
        let growing = (0..100).map(|size| cube(0.0, 2_f64.powi(size - 50)));
        assert_depth(growing.collect(), 100);
    }

    #[test]
    fn boxes_here_and_there_make_a_tree_that_is_not_deep() {
        assert_depth(scatter_boxes(20_000), 60);
    }
}
