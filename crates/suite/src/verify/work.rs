//! The verification of one scene's files: what is chosen, and how it is compared.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use frame::{ExrFile, FileError, Tile, read_exr};
use store::RenderFile;
use tracer::Scene;

use super::chance::Chance;
use super::difference::{find_attribute, find_difference};
use super::listing::KeptScene;
use crate::render::replicates::ReplicateFiles;
use crate::{Error, Monitor};

/// What is traced again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verification {
    /// Seed of the choice of replicates, rungs and tiles.
    pub seed: u64,
    /// Tiles of every truth, of its frame and of its ladder.
    pub tiles: u32,
}

/// The verification of one scene's files.
pub(super) struct Work<'a> {
    pub scene: &'a Scene,
    pub kept: &'a KeptScene,
    pub verification: &'a Verification,
    pub monitor: Monitor,
}

impl Work<'_> {
    /// Refuses a file of other inputs than this program would render.
    pub fn expect_hash(&self, path: &Path, found: &str, own: &str) -> Result<(), Error> {
        match found == own {
            true => Ok(()),
            false => Err(Error::Broken(format!(
                "{}: was made of another scene, of other settings, or by another tracer: its content_hash is {found}, and this program's \
                 is {own}; no run uses it: render it again",
                self.shown(path).display()
            ))),
        }
    }

    /// Refuses a file that does not hold in a tile what was made for it.
    pub fn compare(&self, path: &Path, tile: Tile, made: &ExrFile) -> Result<(), Error> {
        match find_difference(&read_like(path, made)?, tile, made) {
            None => Ok(()),
            Some(difference) => Err(Error::Broken(format!(
                "{}: {difference}, tracing the tile of {}x{} pixels at ({}, {}) again; {}",
                self.shown(path).display(),
                tile.width,
                tile.height,
                tile.x,
                tile.y,
                self.way_out()
            ))),
        }
    }

    /// Refuses a file with other attributes than were made for it. A tile is traced in a few files; attributes are compared in all.
    pub fn compare_attributes(&self, path: &Path, made: &ExrFile) -> Result<(), Error> {
        match find_attribute(&read_like(path, made)?, made) {
            None => Ok(()),
            Some(difference) => Err(Error::Broken(format!(
                "{}: {difference}; {}",
                self.shown(path).display(),
                self.way_out()
            ))),
        }
    }

    /// Says why a file may be different, and what to do.
    pub fn way_out(&self) -> String {
        format!(
            "it was altered, or this processor computes otherwise than the one that rendered it; use none of these files, and render \
             {} again; the choice of tiles had the seed {}",
            self.scene.id, self.verification.seed
        )
    }

    /// Returns the path of a file of the scene.
    pub fn path(&self, file: RenderFile) -> PathBuf {
        self.kept.folder.join(file.path())
    }

    /// Lists the replicates whose headers name the inputs of these files: those that a render reads instead of tracing them.
    pub fn list_own(&self, files: &ReplicateFiles) -> BTreeSet<u32> {
        let mut found = self.kept.replicates(files.alignment);
        found.retain(|index| files.has(*index));
        found
    }

    /// Names a file of the scene as messages do.
    pub fn shown(&self, path: &Path) -> PathBuf {
        let below = path.strip_prefix(&self.kept.folder).unwrap_or(path);
        self.kept.shown.join(below)
    }

    /// Makes the random choices of a file of this scene.
    pub fn chance(&self, name: &str) -> Chance {
        let name = format!("{} {name}", self.scene.id);
        Chance::new(self.verification.seed, &name)
    }
}

/// Reads a file of the kind that was made, whose checksum is right.
fn read_like(path: &Path, made: &ExrFile) -> Result<ExrFile, FileError> {
    let file = read_exr(path)?;
    file.expect_kind(&made.get::<String>("kind")?)?;
    Ok(file)
}
