//! Random choice of what is traced again.

use frame::Tile;

/// Side of a tile that is traced again, in pixels.
pub const TILE_SIDE: u32 = 16;

/// Choices that a seed and a name give, the same everywhere.
pub(super) struct Chance(blake3::OutputReader);

impl Chance {
    pub fn new(seed: u64, name: &str) -> Self {
        let text = format!("verification {seed} of {name}");
        Self(blake3::Hasher::new().update(text.as_bytes()).finalize_xof())
    }

    /// Chooses a number below `count`, which is 1 or more.
    pub fn below(&mut self, count: u32) -> u32 {
        let mut bytes = [0; 8];
        self.0.fill(&mut bytes);
        ((u128::from(u64::from_le_bytes(bytes)) * u128::from(count)) >> 64) as u32
    }

    /// Chooses a tile of a picture; all of it where it is smaller.
    pub fn tile(&mut self, width: u32, height: u32) -> Tile {
        let [columns, rows] = [width, height].map(|side| side.min(TILE_SIDE));
        Tile {
            x: self.below(width - columns + 1),
            y: self.below(height - rows + 1),
            width: columns,
            height: rows,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_may_be_chosen_and_no_tile_leaves_the_picture() {
        let mut seen = vec![false; 40 * 20];
        for seed in 0..2000 {
            let tile = Chance::new(seed, "fan").tile(40, 20);
            for pixel in tile.pixels(40) {
                seen[pixel as usize] = true;
            }
        }
        assert!(seen.iter().all(|seen| *seen));
        let small = Chance::new(1, "fan").tile(5, 3);
        assert_eq!(small, Tile::whole(5, 3));
        let choose = |seed, name| {
            let mut chance = Chance::new(seed, name);
            [0; 4].map(|_: u32| chance.below(1000))
        };
        assert_eq!(choose(1, "fan"), choose(1, "fan"));
        assert_ne!(choose(1, "fan"), choose(2, "fan"));
        assert_ne!(choose(1, "fan"), choose(1, "car"));
    }
}
