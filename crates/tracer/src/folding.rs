//! How a binary tree is folded into wide nodes and leaves, so that rays are expected to visit as few as possible.
//!
//! A ray that enters a box enters one inside it with a probability in proportion to their areas. Of all ways to cut the
//! binary tree into nodes of at most eight children and leaves, the cheapest by that measure is found from the leaves
//! upwards (Wald, Benthin and Boulos 2008 state the measure; Ylitie, Karras and Laine 2017, section 4, the search).

use obvhs::bvh2::Bvh2;

use crate::lanes::WIDTH;

/// What a leaf may hold, and what it costs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LeafRules {
    /// Items at most.
    pub most: u32,
    /// What the test of one item costs on top of the visit; a visit to a node or leaf costs 1.
    pub item_cost: f32,
}

/// The cheapest cuts of a binary tree.
pub(crate) struct Folding<'a> {
    binary: &'a Bvh2,
    rules: LeafRules,
    /// Per node of the binary tree.
    parts: Vec<Part>,
}

/// What is below a node of the binary tree.
#[derive(Clone, Copy, Default)]
struct Part {
    items: u32,
    /// What it costs as a leaf; infinite where it is none.
    leaf: f32,
    /// What it costs if at most 1, 2, ... children of a wide node cover it.
    costs: [f32; WIDTH],
}

impl<'a> Folding<'a> {
    /// Of a tree that is not empty.
    pub fn of(binary: &'a Bvh2, rules: LeafRules) -> Self {
        let mut folding = Self {
            binary,
            rules,
            parts: vec![Part::default(); binary.nodes.len()],
        };
        folding.weigh(0);
        folding
    }

    /// The nodes of the binary tree that become the children of the wide node for `top`: itself where all fits into a leaf.
    pub fn children(&self, top: usize) -> Vec<usize> {
        let mut children = Vec::with_capacity(WIDTH);
        if self.is_leaf(top) {
            children.push(top);
        } else {
            self.share(top, WIDTH, &mut children);
        }
        children
    }

    /// Whether a node of the binary tree becomes a leaf, if a child is to cover it.
    pub fn is_leaf(&self, node: usize) -> bool {
        self.parts[node].leaf <= self.parts[node].costs[0]
    }

    /// Adds all items below a node of the binary tree.
    pub fn add_items(&self, node: usize, items: &mut Vec<u32>) {
        let first = self.binary.nodes[node].first_index as usize;
        if self.binary.nodes[node].is_leaf() {
            let count = self.binary.nodes[node].prim_count as usize;
            items.extend_from_slice(&self.binary.primitive_indices[first..first + count]);
        } else {
            self.add_items(first, items);
            self.add_items(first + 1, items);
        }
    }

    /// Works out a part after both of its own.
    fn weigh(&mut self, node: usize) {
        let binary = &self.binary.nodes[node];
        let area = binary.aabb.half_area();
        let is_leaf = binary.is_leaf();
        let mut items = binary.prim_count;
        if !is_leaf {
            let halves = [0, 1].map(|half| binary.first_index as usize + half);
            halves.into_iter().for_each(|half| self.weigh(half));
            items = halves.iter().map(|&half| self.parts[half].items).sum();
        }
        let leaf = if is_leaf || items <= self.rules.most {
            area * (1.0 + items as f32 * self.rules.item_cost)
        } else {
            f32::INFINITY
        };
        let mut costs = [leaf; WIDTH];
        if !is_leaf {
            costs[0] = leaf.min(area + self.split(node, WIDTH).0);
            for count in 2..=WIDTH {
                costs[count - 1] = costs[count - 2].min(self.split(node, count).0);
            }
        }
        self.parts[node] = Part { items, leaf, costs };
    }

    /// What a node's two halves cost that share so many children of a wide node, and how many of them the first gets.
    fn split(&self, node: usize, count: usize) -> (f32, usize) {
        let first = self.binary.nodes[node].first_index as usize;
        let [left, right] = [first, first + 1].map(|half| &self.parts[half].costs);
        (1..count)
            .map(|given| (left[given - 1] + right[count - given - 1], given))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .expect("halves share two children at least")
    }

    fn share(&self, node: usize, count: usize, children: &mut Vec<usize>) {
        let first = self.binary.nodes[node].first_index as usize;
        let (_, given) = self.split(node, count);
        self.cover(first, given, children);
        self.cover(first + 1, count - given, children);
    }

    /// Adds at most so many children that cover a node, as few as cost no more.
    fn cover(&self, node: usize, count: usize, children: &mut Vec<usize>) {
        let costs = &self.parts[node].costs[..count];
        let enough = 1 + costs
            .iter()
            .take_while(|cost| **cost > costs[count - 1])
            .count();
        if enough == 1 {
            children.push(node);
        } else {
            self.share(node, enough, children);
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use obvhs::BvhBuildParams;
    use obvhs::aabb::Aabb;
    use obvhs::bvh2::builder::build_bvh2;

    use super::*;

    /// Boxes along a line.
    fn boxes(count: u32) -> Bvh2 {
        let boxes: Vec<Aabb> = (0..count)
            .map(|index| {
                let x = index as f32;
                Aabb::new([x, 0.0, 0.0].into(), [x + 0.9, 1.0, 1.0].into())
            })
            .collect();
        let params = BvhBuildParams {
            max_prims_per_leaf: 1,
            ..BvhBuildParams::very_slow_build()
        };
        build_bvh2(&boxes, params, &mut Duration::default())
    }

    /// The items of every leaf at or below the wide node for `top`.
    fn leaves(folding: &Folding, top: usize) -> Vec<Vec<u32>> {
        let children = folding.children(top);
        assert!((1..=WIDTH).contains(&children.len()));
        let below = children.into_iter().map(|child| {
            if !folding.is_leaf(child) {
                return leaves(folding, child);
            }
            let mut items = Vec::new();
            folding.add_items(child, &mut items);
            vec![items]
        });
        below.flatten().collect()
    }

    #[test]
    fn every_item_is_in_one_leaf_and_no_leaf_is_too_full() {
        for count in [1, 2, 7, 8, 9, 64, 1000] {
            for most in [1, 4, 8] {
                let binary = boxes(count);
                let rules = LeafRules {
                    most,
                    item_cost: 0.5,
                };
                let leaves = leaves(&Folding::of(&binary, rules), 0);
                assert!(leaves.iter().all(|items| items.len() <= most as usize));
                let mut items = leaves.concat();
                items.sort_unstable();
                assert_eq!(items, (0..count).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn items_that_cost_nothing_share_leaves_and_dear_ones_do_not() {
        let binary = boxes(64);
        let count = |item_cost| {
            let rules = LeafRules { most: 8, item_cost };
            leaves(&Folding::of(&binary, rules), 0).len()
        };
        // 64 boxes in leaves of eight, in one node; apart, they take nine nodes.
        assert_eq!(count(0.0), 8);
        assert_eq!(count(100.0), 64);
    }
}
