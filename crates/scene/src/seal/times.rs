//! Times of a sealed variant.

use super::Seal;
use crate::model::{Mesh, Motion, Scene, Turn};

impl Seal {
    /// Changes all times: events at `t` move to `delay + t / speed`, or to `delay - t / speed`.
    pub(super) fn change_times(&self, scene: &mut Scene) {
        let sign = if self.reversed { -1.0 } else { 1.0 };
        scene.change_times(|time| self.delay + sign * time / self.speed);
        if self.reversed {
            let objects = scene.objects.iter_mut().map(|object| &mut object.motion);
            objects.chain([&mut scene.camera.motion]).for_each(reverse);
            scene.camera.vertical_fov.reverse();
            scene.meshes.iter_mut().for_each(reverse_shapes);
        }
    }
}

/// Reverses the order of keys whose times have changed their signs.
fn reverse(motion: &mut Motion) {
    let turns: Vec<Turn> = motion.keys.iter().map(|key| key.turn).collect();
    motion.keys.reverse();
    // A turn belongs to the key that it begins at, which was the one that it ended at.
    let back = turns.iter().rev().skip(1).map(|turn| Turn {
        angle: -turn.angle,
        ..*turn
    });
    let turns = back.chain([Turn::NONE]);
    for (key, turn) in motion.keys.iter_mut().zip(turns) {
        key.turn = turn;
    }
}

/// Reverses the order of key shapes whose times have changed their signs.
fn reverse_shapes(mesh: &mut Mesh) {
    mesh.shapes.reverse();
    if let Some(first) = mesh.shapes.first() {
        mesh.positions.clone_from(&first.positions);
        mesh.normals.clone_from(&first.normals);
    }
}
