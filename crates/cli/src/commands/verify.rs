//! The command `verify`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use frame::{FileError, Tile};
use serde::Serialize;
use suite::{
    Error, KeptScene, Pack, TILE_SIDE, Verification, Verified, list_kept_scenes, printable_path,
    verify_scene,
};

use super::ending::Ending;
use super::kept_truths::choose_seed;
use crate::arguments::VerifyArgs;
use crate::output::count::count_text;
use crate::output::print::{print, print_json};
use crate::output::progress::make_monitor;
use crate::selection::{choose_names, select_scenes};

/// Traces random tiles of kept frames, truths and ladders again; fails if a file holds anything else.
pub fn execute(args: &VerifyArgs) -> Result<Ending, Error> {
    let unpacked = unpack(&args.truths)?;
    let folder = (unpacked.as_ref()).map_or(args.truths.as_path(), tempfile::TempDir::path);
    let kept = list_kept_scenes(folder, &args.truths)?;
    let known: BTreeSet<String> = (kept.iter())
        .map(|kept| kept.scene.at_frame(0).to_string())
        .collect();
    let known: Vec<String> = known.into_iter().collect();
    let chosen = choose_names("--scenes", &args.scenes, &known)?;
    let verification = Verification {
        seed: args.seed.unwrap_or_else(choose_seed),
        tiles: args.tiles,
    };
    let mut verified = Verified::default();
    for name in &chosen {
        verified.add(verify_named(args, name, &kept, &verification)?);
    }
    let result = match verified.differences.as_slice() {
        [] => Ok(()),
        differences => Err(Error::Broken(differences.join("\n"))),
    };
    if args.json {
        print_json(&Json::new(&verified, &verification))?;
        return match result {
            Ok(()) => Ok(Ending::Done),
            Err(error) => Ok(Ending::Failed(error)),
        };
    }
    result?;
    print(&verified_text(&args.truths, &verified, &verification))?;
    Ok(Ending::Done)
}

/// Checks a pack and unpacks it into a temporary folder; none for what is no file.
fn unpack(truths: &Path) -> Result<Option<tempfile::TempDir>, Error> {
    if !truths.exists() {
        return Err(Error::Usage(format!(
            "{}: there is no such file or folder; allowed: a pack, or a folder into which `shuttertruth run`, `check` or `render` \
             wrote",
            truths.display()
        )));
    }
    if truths.is_dir() {
        return Ok(None);
    }
    let pack = Pack::open(truths)?;
    pack.check()?;
    let folder = tempfile::tempdir()
        .map_err(|source| FileError::io(&std::env::temp_dir(), "write", source))?;
    pack.unpack(folder.path(), |_| true)?;
    Ok(Some(folder))
}

/// Verifies all kept frames of one scene.
fn verify_named(
    args: &VerifyArgs,
    name: &str,
    kept: &[KeptScene],
    verification: &Verification,
) -> Result<Verified, Error> {
    let mut verified = Verified::default();
    let choices = select_scenes(&args.scenes_dir, &[name.to_owned()]).map_err(|error| {
        Error::Usage(format!(
            "{}: cannot be traced again: {error}; truths of an engine only that engine can draw again: name the scenes to verify with \
             --scenes",
            args.truths.join(name).display()
        ))
    })?;
    for kept in (kept.iter()).filter(|kept| kept.scene.at_frame(0) == name) {
        let scene = choices[0].scene.at_frame(kept.scene.frame);
        let found = verify_scene(&scene, kept, verification, make_monitor())?;
        verified.add(found);
    }
    Ok(verified)
}

/// `out: 5 tiles of 16x16 pixels were traced again and are equal; 2 truths are the means of their replicates; seed 7`
fn verified_text(truths: &Path, verified: &Verified, verification: &Verification) -> String {
    format!(
        "{}: {} of {TILE_SIDE}x{TILE_SIDE} pixels traced again and equal; {} equal to the mean of the replicates; seed {}\n",
        printable_path(truths),
        count_text(verified.tiles.len(), "tile", "tiles"),
        count_text(verified.truths, "truth", "truths"),
        verification.seed
    )
}

/// What was verified, for machines.
#[derive(Serialize)]
struct Json<'a> {
    /// Seed of the choice.
    seed: u64,
    /// Truths that are equal to the mean of their replicates.
    truths: usize,
    /// Tiles that are equal.
    tiles: Vec<JsonTile<'a>>,
    /// What differs, and what to do.
    differences: &'a [String],
}

/// A tile of a file, in pixels from the top left.
#[derive(Serialize)]
struct JsonTile<'a> {
    file: &'a Path,
    x: u32,
    y: u32,
    width: u32,
    height: u32,
}

impl<'a> Json<'a> {
    fn new(verified: &'a Verified, verification: &Verification) -> Self {
        let tile = |(file, tile): &'a (PathBuf, Tile)| JsonTile {
            file,
            x: tile.x,
            y: tile.y,
            width: tile.width,
            height: tile.height,
        };
        Self {
            seed: verification.seed,
            truths: verified.truths,
            tiles: verified.tiles.iter().map(tile).collect(),
            differences: &verified.differences,
        }
    }
}
