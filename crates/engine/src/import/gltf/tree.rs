//! The tree of nodes.

use super::file::File;
use super::schema::Gltf;

/// Most parents above a node.
const DEEPEST: usize = 1024;

/// Parents of nodes, and the nodes of the scene.
#[derive(Debug)]
pub struct Tree {
    /// Parent of each node; none for a root.
    pub parents: Vec<Option<usize>>,
    /// All nodes, parents before their children.
    pub order: Vec<usize>,
    /// Nodes that the scene shows, parents before their children.
    pub shown: Vec<usize>,
}

impl Tree {
    /// Reads the tree; refuses nodes with two parents and circles.
    pub fn read(json: &Gltf) -> Result<Self, String> {
        let count = json.nodes.len();
        let mut parents = vec![None; count];
        for (parent, node) in json.nodes.iter().enumerate() {
            for child in &*node.children {
                File::entry(&json.nodes, "nodes", *child)?;
                if let Some(other) = parents[*child].replace(parent) {
                    return Err(format!(
                        "nodes[{child}] is a child of nodes[{other}] and of nodes[{parent}]; allowed: one parent; \
                         export the file again"
                    ));
                }
            }
        }
        let roots: Vec<usize> = (0..count).filter(|node| parents[*node].is_none()).collect();
        let order = walk(json, &roots);
        if order.len() < count {
            let mut is_reached = vec![false; count];
            order.iter().for_each(|node| is_reached[*node] = true);
            let node = is_reached
                .iter()
                .position(|reached| !reached)
                .unwrap_or_default();
            return Err(format!(
                "nodes[{node}] is among its own parents; allowed: a tree; export the file again"
            ));
        }
        let mut depths = vec![0; count];
        for node in &order {
            depths[*node] = parents[*node].map_or(0, |parent| depths[parent] + 1);
            if depths[*node] > DEEPEST {
                return Err(format!(
                    "nodes[{node}] has more than {DEEPEST} nodes above it; allowed: {DEEPEST}; flatten the scene"
                ));
            }
        }
        let shown = match (json.scenes.get(json.scene.unwrap_or(0)), json.scene) {
            (Some(scene), _) => {
                for root in &*scene.nodes {
                    File::entry(&json.nodes, "nodes", *root)?;
                }
                let mut roots = scene.nodes.to_vec();
                roots.sort_unstable();
                roots.dedup();
                walk(json, &roots)
            }
            (None, Some(scene)) => {
                File::entry(&json.scenes, "scenes", scene)?;
                Vec::new()
            }
            (None, None) => order.clone(),
        };
        Ok(Self {
            parents,
            order,
            shown,
        })
    }
}

/// Lists nodes and all below them. Each node has one parent, so none is met twice but below a root
/// that is another's child.
fn walk(json: &Gltf, roots: &[usize]) -> Vec<usize> {
    let mut is_met = vec![false; json.nodes.len()];
    let mut order = Vec::new();
    let mut waiting: Vec<usize> = roots.iter().rev().copied().collect();
    while let Some(node) = waiting.pop() {
        if !std::mem::replace(&mut is_met[node], true) {
            order.push(node);
            waiting.extend(json.nodes[node].children.iter().rev());
        }
    }
    order
}
