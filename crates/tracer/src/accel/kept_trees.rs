//! Trees of rigid meshes that are kept from one stage to the next: frame, truths and ladder of a
//! scene have a stage each, and the tree of a large mesh takes longer to build than a small frame
//! takes to trace.

use std::sync::{Arc, Mutex, MutexGuard};

use blake3::{Hash, Hasher};
use bvh::RigidTree;
use scene::Mesh;

/// Triangles of the trees that only earlier stages needed, at most: some 300 MB.
const MOST_TRIANGLES: usize = 4 << 20;

/// The kept trees of this process.
static KEPT: Mutex<KeptTrees> = Mutex::new(KeptTrees(Vec::new()));

/// Returns the tree of a rigid mesh: a kept one, or a new one, which is kept.
pub(crate) fn rigid_tree(mesh: &Mesh) -> Arc<RigidTree> {
    let geometry = hash_geometry(mesh);
    if let Some(tree) = kept().find(geometry) {
        return tree;
    }
    // Other stages need not wait meanwhile.
    let tree = Arc::new(RigidTree::build(&mesh.positions, &mesh.triangles));
    kept().0.push(KeptTree {
        geometry,
        triangles: mesh.triangles.len(),
        tree: Arc::clone(&tree),
    });
    tree
}

/// Drops trees that only earlier stages needed, if they are too large; a stage that has all of its
/// trees calls this with their number.
pub(crate) fn drop_old_trees(needed: usize) {
    kept().drop_old(needed);
}

fn kept() -> MutexGuard<'static, KeptTrees> {
    KEPT.lock().expect("nothing panics while it is locked")
}

/// From the one that was used longest ago to the one used last.
struct KeptTrees(Vec<KeptTree>);

struct KeptTree {
    /// Hash of the triangles that it was built from.
    geometry: Hash,
    triangles: usize,
    tree: Arc<RigidTree>,
}

impl KeptTrees {
    fn find(&mut self, geometry: Hash) -> Option<Arc<RigidTree>> {
        let at = (self.0.iter()).position(|kept| kept.geometry == geometry)?;
        let found = self.0.remove(at);
        let tree = Arc::clone(&found.tree);
        self.0.push(found);
        Some(tree)
    }

    /// Drops those that were used longest ago, until all but the `needed` newest are few enough.
    fn drop_old(&mut self, needed: usize) {
        let mut old = self.0.len().saturating_sub(needed);
        let triangles = |kept: &[KeptTree]| kept.iter().map(|kept| kept.triangles).sum::<usize>();
        while triangles(&self.0[..old]) > MOST_TRIANGLES {
            self.0.remove(0);
            old -= 1;
        }
    }
}

/// Hashes all that the tree of a rigid mesh depends on.
fn hash_geometry(mesh: &Mesh) -> Hash {
    let mut hasher = Hasher::new();
    hasher.update(&(mesh.positions.len() as u64).to_le_bytes());
    for position in &mesh.positions {
        hasher.update(position.to_array().map(f32::to_le_bytes).as_flattened());
    }
    for triangle in &mesh.triangles {
        hasher.update(triangle.map(u32::to_le_bytes).as_flattened());
    }
    hasher.finalize()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn triangle(height: f32) -> Mesh {
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(0.0, height, 0.0)],
            triangles: vec![[0, 1, 2]],
            ..Mesh::default()
        }
    }

    #[test]
    fn a_mesh_is_built_once_and_another_one_again() {
        let tree = rigid_tree(&triangle(2.5));
        let path = "elsewhere.obj".into();
        let moved_file = Mesh {
            path,
            ..triangle(2.5)
        };
        assert!(Arc::ptr_eq(&tree, &rigid_tree(&moved_file)));
        assert!(!Arc::ptr_eq(&tree, &rigid_tree(&triangle(3.5))));
        let mut turned = triangle(2.5);
        turned.triangles[0].swap(1, 2);
        assert!(!Arc::ptr_eq(&tree, &rigid_tree(&turned)));
    }

    #[test]
    fn trees_used_longest_ago_leave_and_the_needed_ones_stay() {
        let mesh = triangle(1.0);
        let tree = Arc::new(RigidTree::build(&mesh.positions, &mesh.triangles));
        let kept_tree = |name: &str, triangles| KeptTree {
            geometry: blake3::hash(name.as_bytes()),
            triangles,
            tree: Arc::clone(&tree),
        };
        let names = |kept: &mut KeptTrees| {
            let is_kept = |name: &&str| {
                let geometry = blake3::hash(name.as_bytes());
                kept.0.iter().any(|kept| kept.geometry == geometry)
            };
            let all = ["first", "second", "huge", "small"];
            all.into_iter().filter(is_kept).collect::<Vec<&str>>()
        };
        let mut kept = KeptTrees(vec![
            kept_tree("first", MOST_TRIANGLES / 2 + 1),
            kept_tree("second", MOST_TRIANGLES / 2),
            kept_tree("huge", 10 * MOST_TRIANGLES),
            kept_tree("small", 1),
        ]);
        assert!(kept.find(blake3::hash(b"first")).is_some());
        kept.drop_old(4);
        assert_eq!(names(&mut kept), ["first", "second", "huge", "small"]);
        // From the oldest: second, huge, small, first.
        kept.drop_old(3);
        assert_eq!(names(&mut kept), ["first", "second", "huge", "small"]);
        kept.drop_old(2);
        assert_eq!(names(&mut kept), ["first", "small"]);
    }
}
