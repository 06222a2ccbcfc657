//! What a ray walks through first: trees over the whole scene, in the world.

use crate::accel::build::Growth;
use crate::accel::bvh::{Child, Tree};
use crate::accel::collapse::LeafRules;
use crate::accel::lanes::Lanes;
use crate::geometry::aabb::Bounds;
use crate::geometry::ray::Ray;

/// Nodes of the tree over what stands still are opened until there are so many, for the trees of the slices to sort in
/// among what moves.
const OPENED: usize = 16;
const LEAF_RULES: LeafRules = LeafRules {
    most: 1,
    item_cost: 0.0,
};

/// A tree over the leaves of the objects that stand still, and per slice of the shutter a small one over its topmost nodes and
/// the boxes that all other objects sweep.
pub(crate) struct WorldTree {
    tree: Tree,
    /// Per slice; all are equally long.
    roots: Vec<Child>,
    from: f64,
    to: f64,
    numbers: Numbers,
}

/// What a leaf of the tree holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Part {
    /// Index into the scene's objects.
    pub object: usize,
    /// A leaf of the object's mesh; none for the whole object.
    pub leaf: Option<u32>,
}

/// How parts are numbered: the object's index, and below it the leaf's.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers {
    /// Bits of the leaf's.
    bits: u32,
}

impl Numbers {
    /// For scenes of so many objects.
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

    /// Leaves of one object that have numbers.
    pub fn most_leaves(self) -> usize {
        self.whole() as usize
    }

    /// What stands for no leaf.
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
    /// `leaves`: per object the boxes of its leaves where they lie in this tree. `slices`: per slice of `[from, to]` the boxes
    /// that the objects sweep.
    pub fn over(
        leaves: &[Option<Vec<Bounds>>],
        slices: &[Vec<Bounds>],
        [from, to]: [f64; 2],
    ) -> Self {
        let numbers = Numbers::new(leaves.len());
        let mut boxes = Vec::new();
        let mut children = Vec::new();
        for (object, leaves) in leaves.iter().enumerate() {
            for (leaf, bounds) in leaves.iter().flatten().enumerate() {
                let leaf = Some(leaf as u32);
                boxes.push(*bounds);
                children.push(numbers.child(Part { object, leaf }));
            }
        }
        let mut growth = Growth::default();
        let mut opened = Vec::new();
        if !boxes.is_empty() {
            growth.grow(&boxes, LEAF_RULES, 0, |items| children[items[0] as usize]);
            opened = growth.opened(OPENED);
        }
        let waiting = growth.most_waiting;
        let whole: Vec<usize> = (0..leaves.len())
            .filter(|&object| leaves[object].is_none())
            .collect();
        let roots = if whole.is_empty() {
            vec![Child::ROOT]
        } else {
            let slices = slices.iter();
            slices
                .map(|swept| {
                    let objects = whole.iter().map(|&object| {
                        let part = Part { object, leaf: None };
                        (swept[object], numbers.child(part))
                    });
                    let items: Vec<(Bounds, Child)> =
                        opened.iter().copied().chain(objects).collect();
                    let boxes: Vec<Bounds> = items.iter().map(|(bounds, _)| *bounds).collect();
                    growth.grow(&boxes, LEAF_RULES, waiting, |item| {
                        items[item[0] as usize].1
                    })
                })
                .collect()
        };
        Self {
            tree: growth.finish(),
            roots,
            from,
            to,
            numbers,
        }
    }

    /// Bytes that the trees take.
    pub fn bytes(&self) -> usize {
        self.tree.bytes()
    }

    /// Room that [`WorldTree::walk`] needs for children that wait.
    pub fn most_waiting(&self) -> usize {
        self.tree.most_waiting
    }

    /// As [`Tree::walk`], at a time.
    #[inline(always)]
    pub fn walk<L: Lanes, const SORTED: bool>(
        &self,
        lanes: L,
        waiting: &mut [u64],
        (ray, time): (&Ray, f64),
        limit: f64,
        mut visit: impl FnMut(&mut [u64], Part) -> f64,
        fetch: impl Fn(Part),
    ) {
        self.tree.walk::<L, SORTED>(
            lanes,
            waiting,
            (ray, self.root(time)),
            limit,
            #[inline(always)]
            |waiting, leaf| visit(waiting, self.numbers.part(leaf)),
            #[inline(always)]
            |leaf| fetch(self.numbers.part(leaf)),
        );
    }

    #[inline(always)]
    fn root(&self, time: f64) -> Child {
        assert!(
            self.from <= time && time <= self.to,
            "a ray's time lies in the stage's interval"
        );
        let last = self.roots.len() - 1;
        if last == 0 {
            return self.roots[0];
        }
        let fraction = (time - self.from) / (self.to - self.from);
        let slice = (fraction * self.roots.len() as f64) as usize;
        self.roots[slice.min(last)]
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::accel::lanes::Portable;

    /// A cube of 0.9 metres.
    fn cube(x: f64) -> Bounds {
        let centre = DVec3::new(x, 0.0, 0.0);
        Bounds {
            min: centre,
            max: centre,
        }
        .grown(0.45)
    }

    /// The parts that a ray along x comes to at a time, in order.
    fn met(tree: &WorldTree, time: f64) -> Vec<Part> {
        let ray = Ray {
            origin: DVec3::new(-1000.0, 0.1, 0.2),
            direction: DVec3::X,
        };
        let mut parts = Vec::new();
        let mut waiting = vec![0; tree.most_waiting()];
        tree.walk::<_, true>(
            Portable,
            &mut waiting,
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
    fn every_part_has_a_number_of_its_own() {
        for objects in [1, 2, 7, 8, 1000] {
            let numbers = Numbers::new(objects);
            let last = numbers.most_leaves() as u32 - 1;
            for object in [0, objects / 2, objects - 1] {
                for leaf in [None, Some(0), Some(last)] {
                    let part = Part { object, leaf };
                    let number = numbers.child(part).leaf_number();
                    assert_eq!(number.map(|number| numbers.part(number)), Some(part));
                }
            }
        }
    }

    #[test]
    fn what_moves_is_met_among_what_stands_still() {
        // A hundred leaves in a row; the second object passes from before them over their middle to behind them.
        let leaves = (0..100).map(|x| cube(f64::from(x))).collect();
        let slices: Vec<Vec<Bounds>> = [-10.0, 49.5, 200.0]
            .map(|x| vec![Bounds::EMPTY, cube(x)])
            .into();
        let tree = WorldTree::over(&[Some(leaves), None], &slices, [0.0, 3.0]);
        for (time, places) in [(0.5, 0..1), (1.5, 1..100), (3.0, 100..101)] {
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
        let leaves: Vec<Bounds> = (0..1000).map(|x| cube(f64::from(x))).collect();
        let bytes = |slices: usize| {
            let slices = vec![vec![Bounds::EMPTY, cube(-5.0)]; slices];
            WorldTree::over(&[Some(leaves.clone()), None], &slices, [0.0, 1.0]).bytes()
        };
        // Over a thousand leaves there are at least 143 nodes; above 16 of them and one object, at most 17.
        assert!(bytes(8) < 2 * bytes(1), "{} and {}", bytes(8), bytes(1));
    }
}
