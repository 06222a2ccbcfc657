//! The world tree: the upper level of the hierarchy, over the whole scene.

use crate::aabb::Aabb;
use crate::builder::TreeBuilder;
use crate::collapse::LeafRules;
use crate::lanes::Lanes;
use crate::ray::Ray;
use crate::slices::Slices;
use crate::tree::{Child, Tree};

/// Topmost nodes of the still tree that the slices' trees sort in among the moving objects.
const TOPMOST: usize = 16;
const LEAF_RULES: LeafRules = LeafRules {
    max_items: 1,
    item_cost: 0.0,
};

/// A tree over the leaves of still objects. Per slice of the shutter interval, there is a small
/// tree above it, over its topmost nodes and the boxes that all other objects sweep.
pub struct WorldTree {
    /// Trees of all slices.
    pub tree: Tree,
    slices: Slices,
    /// Root of each slice, or of them all.
    roots: Vec<Child>,
    numbers: Numbers,
}

/// The content of one leaf of the world tree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Index into the scene's objects.
    pub object: usize,
    /// Leaf of the object's mesh; none for the whole object.
    pub leaf: Option<u32>,
}

/// The numbering of parts: the object's index in the high bits, the leaf's in the low ones.
#[derive(Clone, Copy, Debug)]
pub struct Numbers {
    /// Bits of the leaf's index.
    bits: u32,
}

impl Numbers {
    /// The numbering for a scene of this many objects.
    pub fn new(objects: usize) -> Self {
        let for_objects = usize::BITS - objects.leading_zeros();
        assert!(
            for_objects < Child::LEAF_BITS,
            "objects are fewer than 2^30"
        );
        Self {
            bits: Child::LEAF_BITS - for_objects,
        }
    }

    /// Most leaves of one object that can be numbered.
    pub fn max_leaves(self) -> usize {
        self.whole() as usize
    }

    /// The low bits of a whole object.
    #[inline(always)]
    fn whole(self) -> u32 {
        (1 << self.bits) - 1
    }

    fn child(self, part: Part) -> Child {
        Child::leaf((part.object as u32) << self.bits | part.leaf.unwrap_or(self.whole()))
    }

    #[inline(always)]
    fn part(self, number: u32) -> Part {
        let leaf = number & self.whole();
        Part {
            object: (number >> self.bits) as usize,
            leaf: (leaf != self.whole()).then_some(leaf),
        }
    }
}

impl WorldTree {
    /// Builds the tree. `leaves` has the boxes of each object's leaves if they are in the world
    /// tree. `swept` has the boxes that the objects sweep in each slice.
    pub fn build(leaves: &[Option<Vec<Aabb>>], slices: Slices, swept: &[Vec<Aabb>]) -> Self {
        let numbers = Numbers::new(leaves.len());
        let mut boxes = Vec::new();
        let mut children = Vec::new();
        for (object, leaves) in leaves.iter().enumerate() {
            for (leaf, aabb) in leaves.iter().flatten().enumerate() {
                let leaf = Some(leaf as u32);
                boxes.push(*aabb);
                children.push(numbers.child(Part { object, leaf }));
            }
        }
        let mut builder = TreeBuilder::default();
        let mut topmost = Vec::new();
        if !boxes.is_empty() {
            builder.add_tree(&boxes, LEAF_RULES, 0, |items| children[items[0] as usize]);
            topmost = builder.topmost(TOPMOST);
        }
        let stack_size = builder.stack_size;
        let whole: Vec<usize> = (0..leaves.len())
            .filter(|&object| leaves[object].is_none())
            .collect();
        let roots = if whole.is_empty() {
            vec![Child::ROOT]
        } else {
            let swept = swept.iter();
            swept
                .map(|swept| {
                    let objects = whole.iter().map(|&object| {
                        let part = Part { object, leaf: None };
                        (swept[object], numbers.child(part))
                    });
                    let items = topmost.iter().copied().chain(objects);
                    let (boxes, children): (Vec<Aabb>, Vec<Child>) = items.unzip();
                    builder.add_tree(&boxes, LEAF_RULES, stack_size, |item| {
                        children[item[0] as usize]
                    })
                })
                .collect()
        };
        Self {
            tree: builder.finish(),
            slices,
            roots,
            numbers,
        }
    }

    /// Traverses the tree at a time; see [`Tree::traverse`].
    #[inline(always)]
    pub fn traverse<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        stack: &mut [u64],
        (ray, time): (&Ray, f64),
        limit: f64,
        mut visit: impl FnMut(&mut [u64], Part) -> f64,
        prefetch: impl Fn(Part),
    ) {
        self.tree.traverse::<L, SORTED>(
            lanes,
            stack,
            (ray, self.root(time)),
            limit,
            #[inline(always)]
            |stack, leaf| visit(stack, self.numbers.part(leaf)),
            #[inline(always)]
            |leaf| prefetch(self.numbers.part(leaf)),
        );
    }

    #[inline(always)]
    fn root(&self, time: f64) -> Child {
        assert!(
            self.slices.contains(time),
            "a ray's time lies in the stage's interval"
        );
        match self.roots[..] {
            [root] => root,
            _ => self.roots[self.slices.find(time)],
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::lanes::Portable;

    /// A cube of 0.9 metres.
    fn cube(x: f64) -> Aabb {
        let centre = DVec3::new(x, 0.0, 0.0);
        Aabb {
            min: centre,
            max: centre,
        }
        .grown(0.45)
    }

    /// The parts that a ray along x meets at a time, in order.
    fn met(tree: &WorldTree, time: f64) -> Vec<Part> {
        let ray = Ray {
            origin: DVec3::new(-1000.0, 0.1, 0.2),
            direction: DVec3::X,
        };
        let mut parts = Vec::new();
        let mut stack = vec![0; tree.tree.stack_size];
        tree.traverse::<_, true>(
            Portable,
            &mut stack,
            (&ray, time),
            f64::INFINITY,
            |_, part| {
                parts.push(part);
                f64::INFINITY
            },
            |_| {},
        );
        parts
    }

    #[test]
    fn what_moves_is_met_among_what_stands_still() {
        // A hundred leaves in a row; the second object passes from before them over their middle to
        // behind them.
        let leaves = (0..100).map(|x| cube(f64::from(x))).collect();
        let swept = [-10.0, 49.5, 49.5, 200.0].map(|x| vec![Aabb::EMPTY, cube(x)]);
        let slices = Slices::new([0.0, 4.0], 4.0);
        let tree = WorldTree::build(&[Some(leaves), None], slices, &swept);
        for (time, places) in [(0.5, 0..1), (1.5, 1..100), (4.0, 100..101)] {
            let mut parts = met(&tree, time);
            let place = parts.iter().position(|part| part.object == 1);
            let place = place.expect("the ray comes to the second object");
            assert!(places.contains(&place), "met as number {place} at {time}");
            parts.remove(place);
            let leaves = parts.iter().map(|part| part.leaf);
            assert!(leaves.eq((0..100).map(Some)), "{parts:?} at {time}");
        }
    }

    #[test]
    fn slices_share_the_tree_of_what_stands_still() {
        let leaves: Vec<Aabb> = (0..1000).map(|x| cube(f64::from(x))).collect();
        let nodes = |count: usize| {
            let swept = vec![vec![Aabb::EMPTY, cube(-5.0)]; count];
            let slices = Slices::new([0.0, 1.0], count as f64);
            let tree = WorldTree::build(&[Some(leaves.clone()), None], slices, &swept).tree;
            tree.nodes.len()
        };
        // Over a thousand leaves there are at least 143 nodes; above 16 of them and one object, at
        // most 17.
        assert!(nodes(8) < 2 * nodes(1), "{} and {}", nodes(8), nodes(1));
    }
}
