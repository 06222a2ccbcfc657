//! Radiance and places of environment maps.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3, Vec3};

use crate::model::EnvironmentMap;

impl EnvironmentMap {
    /// Radiance from a unit direction: bilinear, wrapped around the horizon and clamped at the
    /// poles.
    pub fn radiance(&self, direction: DVec3) -> Vec3 {
        let [x, y] = self.place(direction).map(|part| part - 0.5);
        let [left, top] = [x.floor(), y.floor()];
        let [across, down] = [(x - left) as f32, (y - top) as f32];
        let texel = |dx: i64, dy: i64| self.texel(left as i64 + dx, top as i64 + dy);
        let upper = texel(0, 0).lerp(texel(1, 0), across);
        let lower = texel(0, 1).lerp(texel(1, 1), across);
        self.strength * upper.lerp(lower, down)
    }

    /// A texel, wrapped around the horizon and clamped at the poles.
    pub fn texel(&self, column: i64, row: i64) -> Vec3 {
        let column = column.rem_euclid(i64::from(self.width)) as usize;
        let row = row.clamp(0, i64::from(self.height) - 1) as usize;
        Vec3::from(self.texels[row * self.width as usize + column])
    }

    /// The place of a unit direction in the image, in texels from its top left.
    fn place(&self, direction: DVec3) -> [f64; 2] {
        let local = DMat3::from_rotation_y(-self.rotation) * direction;
        let azimuth = local.x.atan2(-local.z);
        let polar = local.y.clamp(-1.0, 1.0).acos();
        [
            (azimuth / TAU + 0.5) * f64::from(self.width),
            polar / PI * f64::from(self.height),
        ]
    }

    /// The texel that contains a unit direction.
    pub fn cell(&self, direction: DVec3) -> usize {
        let [x, y] = self.place(direction);
        let column = (x as usize).min(self.width as usize - 1);
        let row = (y as usize).min(self.height as usize - 1);
        row * self.width as usize + column
    }

    /// The direction at an azimuth, as a part of the image's width, and a height above the horizon,
    /// as a sine.
    pub fn direction(&self, across: f64, height: f64) -> DVec3 {
        let (sine, cosine) = (TAU * (across - 0.5)).sin_cos();
        let level = (1.0 - height * height).max(0.0).sqrt();
        DMat3::from_rotation_y(self.rotation) * DVec3::new(level * sine, height, -level * cosine)
    }

    /// The height above the horizon of a row's upper border, as a sine.
    pub fn border(&self, row: usize) -> f64 {
        (PI * row as f64 / f64::from(self.height)).cos()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(width: u32, height: u32, texel: impl Fn(u32, u32) -> [f32; 3]) -> EnvironmentMap {
        EnvironmentMap {
            path: "made by a test".into(),
            width,
            height,
            texels: (0..width * height)
                .map(|at| texel(at % width, at / width))
                .collect(),
            strength: 2.0,
            rotation: 0.0,
        }
    }

    #[test]
    fn the_middle_looks_ahead_and_the_right_quarter_to_the_right() {
        let bright_at = |bright: u32| map(64, 32, |x, _| [f32::from(u8::from(x == bright)); 3]);
        let texel = TAU / 64.0;
        let at = |map: &EnvironmentMap, azimuth: f64| {
            map.radiance(DVec3::new(azimuth.sin(), 0.0, -azimuth.cos()))
                .x
        };
        // A texel's centre is half a texel right of its left border.
        assert!((at(&bright_at(32), 0.5 * texel) - 2.0).abs() < 1e-5);
        assert!((at(&bright_at(48), 0.25 * TAU + 0.5 * texel) - 2.0).abs() < 1e-5);
        // Across the seam behind, where columns 63 and 0 meet.
        assert!((at(&bright_at(63), 0.5 * TAU) - 1.0).abs() < 1e-5);
        let up = map(8, 4, |_, y| [f32::from(u8::from(y == 0)); 3]);
        assert_eq!(up.radiance(DVec3::Y), Vec3::splat(2.0));
        assert_eq!(up.radiance(DVec3::NEG_Y), Vec3::ZERO);
    }

    #[test]
    fn rotation_turns_the_map_about_y() {
        let mut turned = map(64, 32, |x, _| [x as f32; 3]);
        let before = turned.radiance(DVec3::NEG_Z);
        turned.rotation = 0.5 * PI;
        // A quarter turn about +Y takes -Z to -X.
        assert!(turned.radiance(DVec3::NEG_X).distance(before) < 1e-4);
    }
}
