//! The command `truths verify`.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use clap::Args;
use frame::FileError;
use serde_json::json;
use store::{Pack, printable_path};
use suite::{
    Error, SceneRenders, TILE_SIDE, Verification, Verified, list_scene_renders, verify_scene,
};

use super::kept_truths::choose_seed;
use super::result::Ending;
use crate::arguments::{RootArgs, thread_count, within};
use crate::output::{count_text, make_monitor, print, print_json};
use crate::selection::{choose_names, select_scenes};

#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// Pack, or folder into which `run`, `check` or `truths render` wrote.
    #[arg(value_name = "FILE|DIR", default_value = "out")]
    pub truths: PathBuf,
    /// Scenes to verify: names with their @variant, or patterns such as 'rail*'; repeatable, or separated by commas [default: all].
    #[arg(
        long,
        visible_alias = "scene",
        value_delimiter = ',',
        value_name = "SCENES"
    )]
    pub scenes: Vec<String>,
    #[command(flatten)]
    pub root: RootArgs,
    /// Seed of the choice of replicates, rungs and tiles [default: another one each time, which is printed].
    #[arg(long, value_name = "S")]
    pub seed: Option<u64>,
    /// Tiles of 16x16 pixels to trace again of each frame, each truth and each ladder.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = within::<u32>(1..=10_000))]
    pub tiles: u32,
    /// Threads that render [default: one per core].
    #[arg(long, value_name = "N", value_parser = thread_count())]
    pub threads: Option<usize>,
    /// Print what was verified as JSON.
    #[arg(help_heading = "Output", long)]
    pub json: bool,
}

/// Traces random tiles of kept frames, truths and ladders again; fails if a file differs.
pub fn execute(args: &VerifyArgs) -> Result<Ending, Error> {
    let unpacked = unpack(&args.truths)?;
    let folder = (unpacked.as_ref()).map_or(args.truths.as_path(), tempfile::TempDir::path);
    let kept = list_scene_renders(folder, &args.truths)?;
    let known: BTreeSet<String> = (kept.iter())
        .map(|kept| kept.scene.at_frame(0).to_string())
        .collect();
    let known: Vec<String> = known.into_iter().collect();
    let verification = Verification {
        seed: args.seed.unwrap_or_else(choose_seed),
        tiles: args.tiles,
    };
    let mut verified = Verified::default();
    for name in choose_names("--scenes", &args.scenes, &known)? {
        verified.add(verify_named(args, &name, &kept, &verification)?);
    }
    if args.json {
        print_json(&verified_json(&verified, &verification))?;
    }
    let differences = verified.differences.join("\n");
    match (differences.is_empty(), args.json) {
        (true, true) => Ok(Ending::Done),
        (true, false) => {
            print(&verified_text(&args.truths, &verified, &verification))?;
            Ok(Ending::Done)
        }
        (false, true) => Ok(Ending::Failed(Error::Broken(differences))),
        (false, false) => Err(Error::Broken(differences)),
    }
}

/// Checks a pack and unpacks it into a temporary folder; none if `truths` is not a file.
fn unpack(truths: &Path) -> Result<Option<tempfile::TempDir>, Error> {
    if !truths.exists() {
        refuse!(
            "{}: there is no such file or folder; allowed: a pack, or a folder into which `shuttertruth run`, `check` or `truths render` \
             wrote",
            truths.display()
        );
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
    kept: &[SceneRenders],
    verification: &Verification,
) -> Result<Verified, Error> {
    let mut verified = Verified::default();
    let choices = select_scenes(&args.root.scenes_dir, &[name.to_owned()]).map_err(|error| {
        Error::Usage(format!(
            "{}: cannot be traced again: {error}; truths of an engine only that engine can draw again: name the scenes to verify with \
             --scenes",
            args.truths.join(name).display()
        ))
    })?;
    for kept in (kept.iter()).filter(|kept| kept.scene.at_frame(0) == name) {
        let scene = choices[0].scene.at_frame(kept.scene.frame);
        verified.add(verify_scene(&scene, kept, verification, make_monitor())?);
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

/// Describes what was verified as JSON, tiles in pixels from the top left.
fn verified_json(verified: &Verified, verification: &Verification) -> serde_json::Value {
    let tiles = verified.tiles.iter().map(|(file, tile)| {
        let [x, y] = [tile.x, tile.y];
        json!({"file": file, "x": x, "y": y, "width": tile.width, "height": tile.height})
    });
    json!({
        "seed": verification.seed,
        "truths": verified.truths,
        "tiles": tiles.collect::<Vec<_>>(),
        "differences": verified.differences,
    })
}
