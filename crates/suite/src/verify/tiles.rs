//! Tiles of rendered files, chosen at random and traced again.

use std::path::PathBuf;

use frame::{ExrFile, FileError, Tile, read_exr};
use store::RenderFile;
use tracer::{Scene, TraceError, Watch};

use super::difference::{find_attribute, find_difference};
use super::scene_renders::SceneRenders;
use crate::{Error, Monitor, Random};

/// Side of a retraced tile, in pixels.
pub const TILE_SIDE: u32 = 16;

/// Extent of a verification.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verification {
    /// Seed of the choice of replicates, rungs and tiles.
    pub seed: u64,
    /// Tiles per truth, frame and ladder.
    pub tiles: u32,
}

/// The verification of one scene's files.
pub(super) struct Work<'a> {
    pub scene: &'a Scene,
    pub renders: &'a SceneRenders,
    pub verification: &'a Verification,
    pub monitor: Monitor,
}

impl Work<'_> {
    /// Traces random tiles of randomly chosen files again, and compares the attributes of all files. The files are pictures of one size and
    /// differ only in their numbers: replicates of one truth, or rungs of one ladder.
    pub fn trace_tiles(
        &self,
        files: &[RenderFile],
        (width, height): (u32, u32),
        trace: impl Fn(RenderFile, Tile, Watch) -> Result<ExrFile, TraceError>,
    ) -> Result<Vec<(PathBuf, Tile)>, Error> {
        let Some(first) = files.first() else {
            return Ok(Vec::new());
        };
        let name = format!("{}/{first}", self.scene.id);
        let mut random = seeded(self.verification.seed, &name);
        let mut tiles = Vec::new();
        for _ in 0..self.verification.tiles {
            let file = files[random.below(files.len())];
            let tile = choose_tile(&mut random, width, height);
            let label = format!("verifying {}/{file}", self.scene.id);
            let mut made = (self.monitor).watch(&label, |watch| trace(file, tile, watch))?;
            if let Some(difference) = find_difference(&self.read_like(file, &made)?, tile, &made) {
                let text = format!(
                    "{difference}, tracing the tile of {}x{} pixels at ({}, {}) again",
                    tile.width, tile.height, tile.x, tile.y
                );
                return Err(self.altered(file, &text));
            }
            tiles.push((self.shown(file), tile));
            // Tiles are traced in a few files; attributes are compared in all.
            for &file in files.iter().filter(|_| tiles.len() == 1) {
                match file {
                    RenderFile::Replicate(_, index) => made.set("replicate", index),
                    RenderFile::Rung(_, subframes) => made.set("subframes", subframes),
                    RenderFile::Frame | RenderFile::Truth(_) => {}
                }
                if let Some(difference) = find_attribute(&self.read_like(file, &made)?, &made) {
                    return Err(self.altered(file, &difference));
                }
            }
        }
        Ok(tiles)
    }

    /// Reads a file of the same kind as `made`, with a correct checksum.
    fn read_like(&self, file: RenderFile, made: &ExrFile) -> Result<ExrFile, FileError> {
        let file = read_exr(&self.path(file))?;
        file.expect_kind(&made.get::<String>("kind")?)?;
        Ok(file)
    }

    /// Refuses a file of other inputs than this program would render.
    pub fn expect_hash(&self, file: RenderFile, found: &str, own: &str) -> Result<(), Error> {
        match found == own {
            true => Ok(()),
            false => Err(Error::Broken(format!(
                "{}: was made of another scene, of other settings, or by another tracer: its content_hash is {found}, and this program's \
                 is {own}; no run uses it: render it again",
                self.shown(file).display()
            ))),
        }
    }

    /// Describes a file's difference, its possible cause, and what to do.
    pub fn altered(&self, file: RenderFile, difference: &str) -> Error {
        Error::Broken(format!(
            "{}: {difference}; it was altered, or this processor computes otherwise than the one that rendered it; use none of these files, \
             and render {} again; the choice of tiles had the seed {}",
            self.shown(file).display(),
            self.scene.id,
            self.verification.seed
        ))
    }

    /// Returns the path of a file of the scene.
    pub fn path(&self, file: RenderFile) -> PathBuf {
        self.renders.folder.join(file.path())
    }

    /// Names a file of the scene for messages.
    pub fn shown(&self, file: RenderFile) -> PathBuf {
        self.renders.shown.join(file.path())
    }
}

/// Seeds random numbers from a seed and a name, the same everywhere.
fn seeded(seed: u64, name: &str) -> Random {
    let hash = blake3::hash(format!("verification {seed} of {name}").as_bytes());
    let [a, b, c, d, e, f, g, h, ..] = *hash.as_bytes();
    Random(u64::from_le_bytes([a, b, c, d, e, f, g, h]))
}

/// Chooses a tile of a picture; all of it if the picture is smaller.
fn choose_tile(random: &mut Random, width: u32, height: u32) -> Tile {
    let [columns, rows] = [width, height].map(|side| side.min(TILE_SIDE));
    let mut below = |count: u32| random.below(count as usize) as u32;
    Tile {
        x: below(width - columns + 1),
        y: below(height - rows + 1),
        width: columns,
        height: rows,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_pixel_may_be_chosen_and_no_tile_leaves_the_picture() {
        let mut seen = vec![false; 40 * 20];
        for seed in 0..2000 {
            let tile = choose_tile(&mut seeded(seed, "fan"), 40, 20);
            for pixel in tile.pixels(40) {
                seen[pixel as usize] = true;
            }
        }
        assert!(seen.iter().all(|seen| *seen));
        let small = choose_tile(&mut seeded(1, "fan"), 5, 3);
        assert_eq!(small, Tile::whole(5, 3));
    }
}
