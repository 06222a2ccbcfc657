//! The collapse of a binary tree into wide nodes and leaves that rays are expected to visit least.
//!
//! A ray that enters a box enters a box inside it with a probability in proportion to their areas
//! (Wald, Benthin and Boulos 2008). The cheapest collapse by that measure into leaves and nodes of
//! at most sixteen children is found from the leaves upwards (Ylitie, Karras and Laine 2017,
//! section 4).

use obvhs::bvh2::Bvh2;

use crate::binary_tree::parents_first;
use crate::lanes::WIDTH;

/// The size and the cost of leaves.
#[derive(Clone, Copy, Debug)]
pub struct LeafRules {
    /// Most items of a leaf.
    pub max_items: u32,
    /// Cost of testing one item, added to that of the visit; a visit to a node or leaf costs 1.
    pub item_cost: f32,
}

/// The cheapest collapse of a binary tree.
pub struct Collapse<'a> {
    binary: &'a Bvh2,
    rules: LeafRules,
    /// Costs per node of the binary tree.
    costs: Vec<Costs>,
}

/// The costs of everything below a node of the binary tree.
#[derive(Clone, Copy, Default)]
struct Costs {
    items: u32,
    /// Cost as a leaf; infinite if it has too many items.
    leaf: f32,
    /// Cost if at most 1, 2, ... children of a wide node cover it.
    children: [f32; WIDTH],
}

impl<'a> Collapse<'a> {
    /// Finds the cheapest collapse of a tree that is not empty.
    pub fn new(binary: &'a Bvh2, rules: LeafRules) -> Self {
        let mut collapse = Self {
            binary,
            rules,
            costs: vec![Costs::default(); binary.nodes.len()],
        };
        for node in parents_first(binary).into_iter().rev() {
            collapse.compute_costs(node as usize);
        }
        collapse
    }

    /// The nodes of the binary tree that become the children of the wide node for `top`; `top`
    /// itself if it is a leaf.
    pub fn children(&self, top: usize) -> Vec<usize> {
        let mut children = Vec::with_capacity(WIDTH);
        if self.is_leaf(top) {
            children.push(top);
        } else {
            self.share(top, WIDTH, &mut children);
        }
        children
    }

    /// Returns true if a node of the binary tree becomes a leaf when a single child covers it.
    pub fn is_leaf(&self, node: usize) -> bool {
        self.costs[node].leaf <= self.costs[node].children[0]
    }

    /// All items below a node of the binary tree.
    pub fn items(&self, node: usize) -> Vec<u32> {
        let mut items = Vec::with_capacity(self.costs[node].items as usize);
        let mut below = vec![node];
        while let Some(node) = below.pop() {
            let node = &self.binary.nodes[node];
            let first = node.first_index as usize;
            if node.is_leaf() {
                let count = node.prim_count as usize;
                items.extend_from_slice(&self.binary.primitive_indices[first..first + count]);
            } else {
                below.extend([first + 1, first]);
            }
        }
        items
    }

    /// Computes the costs of a node; those of its two children are known.
    fn compute_costs(&mut self, node: usize) {
        let binary = &self.binary.nodes[node];
        let area = binary.aabb.half_area();
        let is_leaf = binary.is_leaf();
        let mut items = binary.prim_count;
        if !is_leaf {
            let halves = [0, 1].map(|half| binary.first_index as usize + half);
            items = halves.iter().map(|&half| self.costs[half].items).sum();
        }
        let leaf = if is_leaf || items <= self.rules.max_items {
            area * (1.0 + items as f32 * self.rules.item_cost)
        } else {
            f32::INFINITY
        };
        let mut children = [leaf; WIDTH];
        if !is_leaf {
            children[0] = leaf.min(area + self.split(node, WIDTH).0);
            for count in 2..=WIDTH {
                children[count - 1] = children[count - 2].min(self.split(node, count).0);
            }
        }
        self.costs[node] = Costs {
            items,
            leaf,
            children,
        };
    }

    /// The cost of a node's two halves if they share `count` children of a wide node, and the first
    /// half's number of them.
    fn split(&self, node: usize, count: usize) -> (f32, usize) {
        let first = self.binary.nodes[node].first_index as usize;
        let [left, right] = [first, first + 1].map(|half| &self.costs[half].children);
        (1..count)
            .map(|given| (left[given - 1] + right[count - given - 1], given))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .expect("halves share at least two children")
    }

    /// Adds `count` children that cover the two halves of a node.
    fn share(&self, node: usize, count: usize, children: &mut Vec<usize>) {
        let first = self.binary.nodes[node].first_index as usize;
        let (_, given) = self.split(node, count);
        self.cover(first, given, children);
        self.cover(first + 1, count - given, children);
    }

    /// Adds at most `count` children that cover a node, as few as cost no more.
    fn cover(&self, node: usize, count: usize, children: &mut Vec<usize>) {
        let costs = &self.costs[node].children[..count];
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
    use super::*;
    use crate::binary_tree::build_binary_tree;
    use crate::binary_tree::tests::scatter_boxes;

    /// Every way to cover a node of the binary tree by nodes at or below it.
    fn covers(binary: &Bvh2, node: usize) -> Vec<Vec<usize>> {
        let mut ways = vec![vec![node]];
        if !binary.nodes[node].is_leaf() {
            let first = binary.nodes[node].first_index as usize;
            let [left, right] = [first, first + 1].map(|half| covers(binary, half));
            for left in &left {
                ways.extend(right.iter().map(|right| [&left[..], right].concat()));
            }
        }
        ways
    }

    /// The cost of the cheapest child of a wide node that covers a node of the binary tree, found
    /// by trying all covers.
    fn least_cost(binary: &Bvh2, rules: LeafRules, node: usize, known: &mut [Option<f32>]) -> f32 {
        if let Some(cost) = known[node] {
            return cost;
        }
        let mut least = f32::INFINITY;
        for cover in covers(binary, node) {
            if (2..=WIDTH).contains(&cover.len()) {
                let parts = cover.iter();
                let cost: f32 = parts
                    .map(|&part| least_cost(binary, rules, part, known))
                    .sum();
                least = least.min(cost + binary.nodes[node].aabb.half_area());
            }
        }
        let cost = least.min(leaf_cost(binary, rules, node));
        known[node] = Some(cost);
        cost
    }

    /// The cost of a node as a leaf; infinite if it has too many items.
    fn leaf_cost(binary: &Bvh2, rules: LeafRules, node: usize) -> f32 {
        let items = Collapse::new(binary, rules).items(node).len();
        if items > rules.max_items as usize {
            return f32::INFINITY;
        }
        binary.nodes[node].aabb.half_area() * (1.0 + items as f32 * rules.item_cost)
    }

    /// The cost of a child of a wide node after the collapse.
    fn cost(collapse: &Collapse, node: usize) -> f32 {
        if collapse.is_leaf(node) {
            return leaf_cost(collapse.binary, collapse.rules, node);
        }
        let children = collapse.children(node).into_iter();
        let below: f32 = children.map(|child| cost(collapse, child)).sum();
        below + collapse.binary.nodes[node].aabb.half_area()
    }

    #[test]
    fn no_other_collapse_is_cheaper() {
        for (max_items, item_cost) in [(1, 0.0), (3, 0.2), (3, 1.0)] {
            let rules = LeafRules {
                max_items,
                item_cost,
            };
            let binary = build_binary_tree(&scatter_boxes(22));
            let known = &mut vec![None; binary.nodes.len()];
            let least = least_cost(&binary, rules, 0, known);
            let total = cost(&Collapse::new(&binary, rules), 0);
            // Sums of two dozen numbers of 32 bits in another order.
            assert!(
                (total / least - 1.0).abs() < 1e-5,
                "{total} instead of {least}"
            );
        }
    }
}
