//! The choice of objects with leaves in the world tree.

use bvh::{Aabb, Numbers};
use scene::Scene;

use crate::accel::mesh_tree::MeshTree;
use crate::motion::poses::Poses;

/// Upper limit on instanced leaves that are copied into the world tree; so many hold up to 2
/// million triangles.
const MAX_COPIES: usize = 1 << 18;
/// Least mean size of an object's leaves, as a part of the scene's greatest coordinate. A ray's
/// boxes are grown by 2e-6 of that coordinate, so by a fifth of a leaf at most.
const MIN_LEAF_SIZE: f64 = 2e-5;

/// Collects, per object with leaves in the world tree, their boxes in the world.
///
/// Rays then need no tree of the object's own, and enter its space only at a leaf. Only still
/// objects qualify. Objects that share a mesh share its triangles; only the nodes above them are
/// copied.
pub(crate) fn collect_world_leaves(
    scene: &Scene,
    meshes: &[Option<MeshTree>],
    poses: &mut Poses,
    largest_coordinate: f64,
) -> Vec<Option<Vec<Aabb>>> {
    let mut world_leaves = vec![None; scene.objects.len()];
    let max_leaves = Numbers::new(scene.objects.len()).max_leaves();
    let mut copies = 0;
    for (mesh, tree) in meshes.iter().enumerate() {
        let Some(MeshTree::Rigid(tree)) = tree else {
            continue;
        };
        let showing = (0..scene.objects.len()).filter(|&object| scene.objects[object].mesh == mesh);
        let (still, moving): (Vec<usize>, Vec<usize>) =
            showing.partition(|&object| poses.stands_still(object));
        let originals = usize::from(moving.is_empty());
        let with_these = copies + still.len().saturating_sub(originals) * tree.leaf_count();
        if with_these > MAX_COPIES || tree.leaf_count() > max_leaves {
            continue;
        }
        copies = with_these;
        for object in still {
            let leaves = tree.leaf_aabbs(&poses.pose(object).to_world);
            let sizes: f64 = leaves.iter().map(|aabb| aabb.diagonal()).sum();
            let coarse = sizes >= MIN_LEAF_SIZE * largest_coordinate * leaves.len() as f64;
            world_leaves[object] = coarse.then_some(leaves);
        }
    }
    world_leaves
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};
    use scene::{Key, Mesh, Motion, Object, Parent, Turn};

    use super::*;
    use crate::test_scene::load_test_scene;

    /// A fan of this many triangles, two metres wide.
    fn fan(triangles: u32) -> Mesh {
        let rim = (0..=triangles).map(|step| {
            let (sine, cosine) = (6.0 * step as f32 / triangles as f32).sin_cos();
            Vec3::new(cosine, sine, 0.0)
        });
        Mesh {
            positions: std::iter::once(Vec3::Z).chain(rim).collect(),
            triangles: (1..=triangles)
                .map(|corner| [0, corner, corner + 1])
                .collect(),
            slots: vec![0; triangles as usize],
            ..Mesh::default()
        }
    }

    fn still(mesh: usize) -> Object {
        Object {
            name: "fan".into(),
            mesh,
            materials: vec![0],
            motion: Motion::still(Key::REST),
            parent: Parent::World,
        }
    }

    /// Turns by a radian per frame.
    fn turning(mesh: usize) -> Object {
        let mut object = still(mesh);
        let turn = Turn {
            axis: DVec3::Z,
            angle: 1.0,
        };
        let key = Key { turn, ..Key::REST };
        let later = Key { time: 1.0, ..key };
        object.motion.keys = vec![key, later];
        object
    }

    /// Finds per object whether its leaves are in the world tree.
    fn in_world_tree(
        meshes: Vec<Mesh>,
        objects: Vec<Object>,
        largest_coordinate: f64,
    ) -> Vec<bool> {
        let mut scene = load_test_scene("two_spheres");
        scene.meshes = meshes;
        scene.objects = objects;
        let meshes = scene.meshes.iter();
        let trees: Vec<Option<MeshTree>> = meshes
            .map(|mesh| Some(MeshTree::build(mesh, -1.0, 0.0)))
            .collect();
        let mut poses = Poses::new(&scene, -1.0, 0.0);
        let leaves = collect_world_leaves(&scene, &trees, &mut poses, largest_coordinate);
        leaves.iter().map(Option::is_some).collect()
    }

    #[test]
    fn leaves_of_still_objects_lie_in_the_world_tree() {
        let objects = vec![still(0), turning(0), still(1), turning(1)];
        assert_eq!(
            in_world_tree(vec![fan(40), fan(9)], objects, 1.0),
            [true, false, true, false]
        );
    }

    #[test]
    fn fine_meshes_in_a_wide_scene_stay_out() {
        // Leaves of fans of 8 triangles in all are as large as the fan, those of thousands a
        // hundred times smaller.
        let meshes = || vec![fan(8), fan(8000)];
        let objects = || vec![still(0), still(1)];
        assert_eq!(in_world_tree(meshes(), objects(), 1.0), [true, true]);
        assert_eq!(in_world_tree(meshes(), objects(), 8e4), [true, false]);
        assert_eq!(in_world_tree(meshes(), objects(), 1e7), [false, false]);
    }

    #[test]
    fn a_mesh_in_too_many_places_stays_out() {
        // 8000 triangles take 1000 leaves or more.
        let objects = |count: usize| {
            let mut objects = vec![still(0); count];
            objects.push(still(1));
            objects
        };
        let meshes = || vec![fan(8000), fan(8)];
        assert!(
            in_world_tree(meshes(), objects(20), 1.0)
                .iter()
                .all(|inside| *inside)
        );
        let many = in_world_tree(meshes(), objects(MAX_COPIES / 1000 + 2), 1.0);
        assert!(many.iter().rev().skip(1).all(|inside| !inside));
        assert_eq!(many.last(), Some(&true), "another mesh is in");
    }
}
