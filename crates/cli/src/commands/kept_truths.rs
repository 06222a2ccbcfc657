//! Truths of `--truths`: a folder, or a pack.

use std::collections::hash_map::RandomState;
use std::hash::{BuildHasher, Hasher};
use std::path::Path;

use store::{Pack, printable_path};
use suite::{Error, RunPlan, Unpacked, Verification, take_pack};

use crate::output::{count_text, print_note};

/// Files that a note names before it counts the rest.
const MAX_NAMED: usize = 4;

/// Refuses a path that is neither a folder nor a pack, before anything is rendered, and says whom
/// the run believes.
pub fn check_truths(truths: &Path) -> Result<(), Error> {
    if truths.is_file() {
        Pack::open(truths)?;
    } else if !truths.is_dir() {
        refuse!(
            "--truths {}: {}; allowed: a folder into which `shuttertruth truths render --ladders` or `run` \
             wrote, or a pack",
            truths.display(),
            match truths.exists() {
                true => "is neither a folder nor a regular file",
                false => "there is no such folder or file",
            }
        );
    }
    print_note(&format!(
        "whoever wrote {} decides the scores and the verdict: its truths are believed",
        truths.display()
    ));
    Ok(())
}

/// Unpacks the truths that the plan needs into the plan's locked folder, and says so. A folder is left for the run to read.
pub fn take_packed_truths(plan: &mut RunPlan) -> Result<(), Error> {
    let Some(path) = plan.truths.as_ref().filter(|truths| truths.is_file()) else {
        return Ok(());
    };
    let pack = Pack::open(path)?;
    let verification = Verification {
        seed: choose_seed(),
        tiles: 1,
    };
    let unpacked = take_pack(plan, &pack, &verification)?;
    print_note(&unpacked_text(&pack, &unpacked, &verification));
    // They are all there now.
    plan.truths = Some(plan.out.clone());
    Ok(())
}

/// Chooses an unpredictable seed.
pub fn choose_seed() -> u64 {
    // Short enough to type.
    RandomState::new().build_hasher().finish() % 1_000_000_000
}

/// `truths.tar.zst: took 33 files, and traced 3 tiles again, which are equal (seed 7); nothing is rendered`
fn unpacked_text(pack: &Pack, unpacked: &Unpacked, verification: &Verification) -> String {
    let mut text = printable_path(&pack.path);
    match unpacked.files {
        0 => text += ": took no file",
        taken => {
            text += &format!(
                ": took {}, and traced {} again, which are equal (seed {})",
                count_text(taken, "file", "files"),
                count_text(unpacked.verified.tiles.len(), "tile", "tiles"),
                verification.seed
            );
        }
    }
    match unpacked.missing.as_slice() {
        [] => text += "; nothing is rendered",
        missing => {
            let named = &missing[..missing.len().min(MAX_NAMED)];
            text += &format!("; renders what it lacks: {}", named.join(", "));
            if missing.len() > named.len() {
                text += &format!(" and {} more", missing.len() - named.len());
            }
            text +=
                ". A pack serves runs of its scenes, its settings and this version of the tracer";
        }
    }
    text
}
