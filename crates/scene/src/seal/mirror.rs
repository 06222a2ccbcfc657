//! Mirrored scenes.

use glam::{DQuat, DVec3};

use crate::model::{Background, Key, Scene};

/// Mirrors a scene at the plane x = 0, camera and lights included: its picture is the scene's, left
/// for right.
pub(super) fn mirror(mut scene: Scene) -> Scene {
    for mesh in &mut scene.meshes {
        let shapes = (mesh.shapes.iter_mut())
            .flat_map(|shape| shape.positions.iter_mut().chain(&mut shape.normals));
        for vector in (mesh.positions.iter_mut().chain(&mut mesh.normals)).chain(shapes) {
            vector.x = -vector.x;
        }
        for triangle in &mut mesh.triangles {
            triangle.swap(1, 2);
        }
    }
    let objects = scene.objects.iter_mut().map(|object| &mut object.motion);
    for motion in objects.chain([&mut scene.camera.motion]) {
        motion.keys.iter_mut().for_each(mirror_key);
    }
    if let Background::Map(map) = &mut scene.background {
        for row in map.texels.chunks_exact_mut(map.width as usize) {
            row.reverse();
        }
        map.rotation = -map.rotation;
    }
    if let Some(sun) = &mut scene.sun {
        sun.direction.x = -sun.direction.x;
    }
    scene
}

fn mirror_key(key: &mut Key) {
    let mirror_axis = |axis: DVec3| DVec3::new(axis.x, -axis.y, -axis.z);
    key.translation.x = -key.translation.x;
    let axis = mirror_axis(key.orientation.xyz());
    key.orientation = DQuat::from_xyzw(axis.x, axis.y, axis.z, key.orientation.w);
    key.turn.axis = mirror_axis(key.turn.axis);
}
