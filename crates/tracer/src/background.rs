//! What rays see that leave the scene.

use glam::{DVec3, Vec3};

use crate::scene::Background;

impl Background {
    /// Radiance from a unit direction.
    pub fn radiance(&self, direction: DVec3) -> Vec3 {
        match *self {
            Background::Constant(radiance) => radiance,
            Background::Gradient {
                ground,
                horizon,
                zenith,
            } => {
                let height = direction.y as f32;
                if height < 0.0 {
                    horizon.lerp(ground, -height)
                } else {
                    horizon.lerp(zenith, height)
                }
            }
        }
    }
}
