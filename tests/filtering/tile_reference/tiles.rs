//! Half-velocities, tiles and neighbourhoods in 64-bit floats, in plain loops that share nothing
//! with the kernels.

use frame::Raster;
use tests::vector::{Vec2, direction, dot, length, scaled};

pub fn texel(raster: &Raster<[f32; 4]>, [x, y]: [i64; 2]) -> [f64; 4] {
    raster.at(x as u32, y as u32).map(f64::from)
}

/// Returns the first two components of a texel.
pub fn vector(raster: &Raster<[f32; 4]>, pixel: [i64; 2]) -> Vec2 {
    let [horizontal, vertical, ..] = texel(raster, pixel);
    [horizontal, vertical]
}

/// Tiles of `side` pixels over an image, with each one's half-velocity.
pub struct Tiles<'r> {
    pub side: i64,
    pub image: [i64; 2],
    pub vectors: &'r Raster<[f32; 4]>,
}

impl Tiles<'_> {
    /// Returns the number of columns and rows, including partial ones.
    pub fn count(&self) -> [i64; 2] {
        self.image
            .map(|side| side / self.side + i64::from(side % self.side > 0))
    }

    pub fn all(&self) -> impl Iterator<Item = [i64; 2]> + use<> {
        let [columns, rows] = self.count();
        (0..rows).flat_map(move |y| (0..columns).map(move |x| [x, y]))
    }

    pub fn pixels(&self, tile: [i64; 2]) -> impl Iterator<Item = [i64; 2]> + use<> {
        let from = tile.map(|index| index * self.side);
        let to = [0, 1].map(|axis| (from[axis] + self.side).min(self.image[axis]));
        (from[1]..to[1]).flat_map(move |y| (from[0]..to[0]).map(move |x| [x, y]))
    }

    pub fn of(&self, pixel: [i64; 2]) -> [i64; 2] {
        pixel.map(|coordinate| coordinate / self.side)
    }

    /// Returns a tile and its up to eight neighbours: their offsets and half-velocities.
    pub fn around(&self, tile: [i64; 2]) -> impl Iterator<Item = ([i64; 2], Vec2)> {
        let offsets = (-1..=1).flat_map(|y| (-1..=1).map(move |x| [x, y]));
        offsets.filter_map(move |offset| {
            let other = [tile[0] + offset[0], tile[1] + offset[1]];
            let exists = (0..2).all(|axis| (0..self.count()[axis]).contains(&other[axis]));
            exists.then(|| (offset, vector(self.vectors, other)))
        })
    }

    /// Computes 1 - the mean |cosine| between a tile's half-velocity and its moving neighbours'.
    pub fn variance(&self, tile: [i64; 2]) -> f64 {
        let middle = direction(vector(self.vectors, tile), [0.0; 2]);
        let cosines: Vec<f64> = self
            .around(tile)
            .filter(|(_, vector)| length(*vector) > 0.5001)
            .map(|(_, vector)| dot(middle, direction(vector, [0.0; 2])).abs())
            .collect();
        match middle {
            [0.0, 0.0] => 0.0,
            _ => 1.0 - cosines.iter().sum::<f64>() / cosines.len() as f64,
        }
    }
}

/// Returns whether a tile's half-velocity counts for the tile that sees it at `offset`.
pub fn counts(rule: &str, offset: [i64; 2], vector: Vec2) -> bool {
    let offset = offset.map(|component| component as f64);
    let diagonal = offset[0] != 0.0 && offset[1] != 0.0;
    match rule {
        "all" => true,
        _ if !diagonal => true,
        // Towards the middle means against the offset.
        "toward" => dot(vector, scaled(offset, -1.0)) > 0.0,
        "either_way" => {
            let signs = [0, 1].map(|axis| (vector[axis] * offset[axis]).signum());
            vector[0] != 0.0 && vector[1] != 0.0 && signs[0] == signs[1]
        }
        rule => panic!("no such rule: {rule}"),
    }
}
