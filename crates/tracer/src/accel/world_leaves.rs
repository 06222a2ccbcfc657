//! Which objects have their triangles in the tree of the world.

use crate::accel::mesh_tree::Geometry;
use crate::accel::world_tree::Numbers;
use crate::geometry::aabb::Bounds;
use crate::motion::poses::Poses;
use crate::scene::Scene;

/// So many leaves at most are in the tree of the world once more than they are in meshes: of up to 2 million triangles.
const MOST_REPEATED: usize = 1 << 18;
/// A ray's boxes are grown by 2e-6 of the greatest coordinate; by this measure a fifth of a leaf at most.
const LEAST_LEAF: f64 = 2e-5;

/// Per object the boxes of its leaves in the world, where they are to lie in the world's own tree: where the object stands still,
/// rays need no tree of its own, nor to be moved into its space before they meet a leaf. Objects that share a mesh share
/// its triangles; only the nodes above them are held once more. `reach`: the greatest coordinate in the scene.
pub(crate) fn joining(
    scene: &Scene,
    geometries: &[Option<Geometry>],
    poses: &mut Poses,
    reach: f64,
) -> Vec<Option<Vec<Bounds>>> {
    let mut joining = vec![None; scene.objects.len()];
    let most_leaves = Numbers::new(scene.objects.len()).most_leaves();
    let mut repeated = 0;
    for (mesh, geometry) in geometries.iter().enumerate() {
        let Some(Geometry::Rigid(tree)) = geometry else {
            continue;
        };
        let showing = (0..scene.objects.len()).filter(|&object| scene.objects[object].mesh == mesh);
        let (still, moving): (Vec<usize>, Vec<usize>) =
            showing.partition(|&object| poses.stands_still(object));
        let own = usize::from(moving.is_empty());
        let more = repeated + still.len().saturating_sub(own) * tree.leaf_count();
        if more > MOST_REPEATED || tree.leaf_count() > most_leaves {
            continue;
        }
        repeated = more;
        for object in still {
            let leaves = tree.leaf_bounds(&poses.pose(object).to_world);
            let sizes: f64 = leaves.iter().map(|bounds| bounds.diagonal()).sum();
            let coarse = sizes >= LEAST_LEAF * reach * leaves.len() as f64;
            joining[object] = coarse.then_some(leaves);
        }
    }
    joining
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use glam::{DVec3, Vec3};

    use super::*;
    use crate::load_scene;
    use crate::motion::keys::{Key, Motion, Turn};
    use crate::scene::{Mesh, Object, Parent};

    /// A fan of so many triangles, two metres wide.
    fn fan(triangles: u32) -> Mesh {
        let rim = (0..=triangles).map(|step| {
            let (sine, cosine) = (6.0 * step as f32 / triangles as f32).sin_cos();
            Vec3::new(cosine, sine, 0.0)
        });
        Mesh {
            path: PathBuf::new(),
            positions: std::iter::once(Vec3::Z).chain(rim).collect(),
            normals: Vec::new(),
            texcoords: Vec::new(),
            triangles: (1..=triangles)
                .map(|corner| [0, corner, corner + 1])
                .collect(),
            slots: vec![0; triangles as usize],
            shapes: Vec::new(),
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

    /// Whether each object joins.
    fn joined(meshes: Vec<Mesh>, objects: Vec<Object>, reach: f64) -> Vec<bool> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/two_spheres");
        let mut scene = load_scene(&folder, None).expect("the built-in scenes load");
        scene.meshes = meshes;
        scene.objects = objects;
        let meshes = scene.meshes.iter();
        let geometries: Vec<Option<Geometry>> = meshes
            .map(|mesh| Some(Geometry::of(mesh, -1.0, 0.0)))
            .collect();
        let mut poses = Poses::new(&scene, -1.0, 0.0);
        let joining = joining(&scene, &geometries, &mut poses, reach);
        joining.iter().map(Option::is_some).collect()
    }

    #[test]
    fn what_stands_still_joins_and_what_moves_does_not() {
        let objects = vec![still(0), turning(0), still(1), turning(1)];
        assert_eq!(
            joined(vec![fan(40), fan(9)], objects, 1.0),
            [true, false, true, false]
        );
    }

    #[test]
    fn what_is_fine_in_a_wide_world_does_not_join() {
        // Leaves of fans of 8 triangles in all are as large as the fan, those of thousands a hundred times smaller.
        let meshes = || vec![fan(8), fan(8000)];
        let objects = || vec![still(0), still(1)];
        assert_eq!(joined(meshes(), objects(), 1.0), [true, true]);
        assert_eq!(joined(meshes(), objects(), 8e4), [true, false]);
        assert_eq!(joined(meshes(), objects(), 1e7), [false, false]);
    }

    #[test]
    fn a_mesh_in_too_many_places_does_not_join() {
        // 8000 triangles take from 1000 leaves on.
        let objects = |count: usize| {
            let mut objects = vec![still(0); count];
            objects.push(still(1));
            objects
        };
        let meshes = || vec![fan(8000), fan(8)];
        assert!(
            joined(meshes(), objects(20), 1.0)
                .iter()
                .all(|joins| *joins)
        );
        let many = joined(meshes(), objects(MOST_REPEATED / 1000 + 2), 1.0);
        assert!(many.iter().rev().skip(1).all(|joins| !joins));
        assert_eq!(many.last(), Some(&true), "another mesh joins");
    }
}
