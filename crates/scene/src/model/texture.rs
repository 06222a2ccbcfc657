//! Bilinear lookup of repeating textures.

use glam::{Vec2, Vec4};

use crate::model::Texture;

impl Texture {
    /// The texture's linear RGBA at texture coordinates `uv`, v up: (0, 0) is the image's bottom
    /// left corner.
    #[inline]
    pub fn sample(&self, uv: Vec2) -> Vec4 {
        let x = wrap(uv.x, self.width);
        let y = wrap(1.0 - uv.y, self.height);
        let [left, top] = [x.floor(), y.floor()];
        let [across, down] = [x - left, y - top];
        let columns = neighbours(left, self.width);
        let rows = neighbours(top, self.height);
        let texel = |column: usize, row: usize| {
            Vec4::from(self.texels[rows[row] * self.width as usize + columns[column]])
        };
        let upper = texel(0, 0).lerp(texel(1, 0), across);
        let lower = texel(0, 1).lerp(texel(1, 1), across);
        upper.lerp(lower, down)
    }
}

/// Wraps a texture coordinate and converts it to texels from the centre of the first. The integer
/// part of `fraction` is dropped first, so that far repeats keep their precision.
fn wrap(fraction: f32, texels: u32) -> f32 {
    (fraction - fraction.floor()) * texels as f32 - 0.5
}

/// A texel and the next one, in a row of `texels` that repeats; `first` is a whole number from -1
/// to `texels`.
fn neighbours(first: f32, texels: u32) -> [usize; 2] {
    let last = texels as usize - 1;
    match first as i64 {
        ..0 => [last, 0],
        first if first as usize >= last => [last, 0],
        first => [first as usize, first as usize + 1],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 x 2 texels: 1 2 above 3 4.
    fn texture() -> Texture {
        Texture {
            path: "made by a test".into(),
            width: 2,
            height: 2,
            texels: [1.0, 2.0, 3.0, 4.0].map(|value| [value; 4]).to_vec(),
        }
    }

    #[test]
    fn texels_lie_at_their_centres_with_v_up() {
        for (u, v, expected) in [
            (0.25, 0.75, 1.0),
            (0.75, 0.75, 2.0),
            (0.25, 0.25, 3.0),
            (0.75, 0.25, 4.0),
        ] {
            assert_eq!(texture().sample(Vec2::new(u, v)), Vec4::splat(expected));
            // One repeat on, and several back.
            assert_eq!(
                texture().sample(Vec2::new(u + 1.0, v - 3.0)),
                Vec4::splat(expected)
            );
        }
    }

    #[test]
    fn between_centres_texels_mix_and_wrap_at_the_border() {
        assert_eq!(texture().sample(Vec2::new(0.5, 0.75)), Vec4::splat(1.5));
        assert_eq!(texture().sample(Vec2::new(0.25, 0.5)), Vec4::splat(2.0));
        assert_eq!(texture().sample(Vec2::new(0.0, 0.75)), Vec4::splat(1.5));
        assert_eq!(texture().sample(Vec2::new(0.5, 0.5)), Vec4::splat(2.5));
    }
}
