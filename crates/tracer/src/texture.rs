//! Bilinear, repeating lookup of textures.

use glam::{Vec2, Vec4};

use crate::scene::Texture;

impl Texture {
    /// The texture's linear RGBA at texture coordinates `uv`, v up: (0, 0) is the image's bottom left corner.
    pub fn sample(&self, uv: Vec2) -> Vec4 {
        let x = wrapped(uv.x, self.width);
        let y = wrapped(1.0 - uv.y, self.height);
        let [left, top] = [x.floor(), y.floor()];
        let [across, down] = [x - left, y - top];
        let texel = |dx: i64, dy: i64| {
            let column = (left as i64 + dx).rem_euclid(i64::from(self.width)) as usize;
            let row = (top as i64 + dy).rem_euclid(i64::from(self.height)) as usize;
            Vec4::from(self.texels[row * self.width as usize + column])
        };
        let upper = texel(0, 0).lerp(texel(1, 0), across);
        let lower = texel(0, 1).lerp(texel(1, 1), across);
        upper.lerp(lower, down)
    }
}

/// A coordinate in texels from the centre of the first; the integer part of `fraction` goes first, so that far
/// repeats keep their precision.
fn wrapped(fraction: f32, texels: u32) -> f32 {
    fraction.rem_euclid(1.0) * texels as f32 - 0.5
}
