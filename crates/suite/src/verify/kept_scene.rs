//! Verification of a scene's kept files.

use std::path::{Path, PathBuf};

use frame::{Alignment, Frame, Replicate, Shutter, Tile, Truth, read_exr};
use store::RenderFile;
use tracer::{RenderSettings, Scene};

use super::difference::find_difference;
use super::listing::KeptScene;
use super::tiles::{trace_frame_tiles, trace_replicate_tiles, trace_rung_tiles};
use super::work::{Verification, Work};
use crate::render::memory::check_memory;
use crate::render::replicates::ReplicateFiles;
use crate::{Error, Monitor};

/// The outcome of a verification.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Verified {
    /// Files of which tiles were traced again and are equal, with the tiles.
    pub tiles: Vec<(PathBuf, Tile)>,
    /// Truths that are the mean of their replicates.
    pub truths: usize,
    /// Files that hold something else than this program makes, and what to do.
    pub differences: Vec<String>,
}

/// Traces tiles of a scene's kept frame, of a replicate of each kept truth and of a rung of its ladder again, and compares them with the
/// files byte for byte. Compares every truth with the mean of its replicates, and verifies replicates without a truth as well. `scene` is
/// that of the frame that `kept` names: nothing that a file says keeps it from being traced.
///
/// # Errors
/// The scene cannot be rendered, or the caller interrupts. Differences are no error.
pub fn verify_scene(
    scene: &Scene,
    kept: &KeptScene,
    verification: &Verification,
    monitor: Monitor,
) -> Result<Verified, Error> {
    let mut verified = Verified::default();
    let work = Work {
        scene,
        kept,
        verification,
        monitor,
    };
    if kept.files.contains(&RenderFile::Frame) {
        verified.note(verify_frame(&work, &work.path(RenderFile::Frame)))?;
    }
    for alignment in kept.alignments() {
        let truth = RenderFile::Truth(alignment);
        match kept.files.contains(&truth) {
            true => {
                let truth = work.path(truth);
                let is_equal = verified.note(verify_truth(&work, &truth, alignment))?;
                verified.truths += usize::from(is_equal);
            }
            false => drop(verified.note(verify_part(&work, alignment))?),
        }
    }
    Ok(verified)
}

impl Verified {
    /// Adds what was verified of other scenes.
    pub fn add(&mut self, other: Self) {
        self.tiles.extend(other.tiles);
        self.truths += other.truths;
        self.differences.extend(other.differences);
    }

    /// Notes the tiles of a file, or the difference in their place; returns true if there is none.
    fn note(&mut self, found: Result<Vec<(PathBuf, Tile)>, Error>) -> Result<bool, Error> {
        let difference = match found {
            Ok(tiles) => {
                self.tiles.extend(tiles);
                return Ok(true);
            }
            Err(Error::Broken(difference)) => difference,
            Err(Error::File(error)) => error.to_string(),
            Err(Error::Truth(error)) => error.to_string(),
            Err(other) => return Err(other),
        };
        self.differences.push(difference);
        Ok(false)
    }
}

/// Verifies a frame.
fn verify_frame(work: &Work, path: &Path) -> Result<Vec<(PathBuf, Tile)>, Error> {
    let frame = Frame::read(path)?;
    let (width, height) = frame.size();
    let provenance = &frame.provenance;
    let settings = RenderSettings {
        width: width - 2 * frame.guard_band,
        height: height - 2 * frame.guard_band,
        samples_per_pixel: provenance.samples_per_pixel,
        replicates: 1,
        seed: provenance.seed,
        options: frame.options,
        guard_band: frame.guard_band,
        exposure: Some(frame.exposure),
    };
    let own = tracer::frame_hash(work.scene, &settings);
    work.expect_hash(path, &provenance.content_hash, &own)?;
    trace_frame_tiles(work, path, &settings, &frame)
}

/// Verifies a truth, its replicates and a rung of its ladder.
fn verify_truth(
    work: &Work,
    path: &Path,
    alignment: Alignment,
) -> Result<Vec<(PathBuf, Tile)>, Error> {
    let truth = Truth::read(path)?;
    let provenance = &truth.provenance;
    let settings = RenderSettings {
        samples_per_pixel: provenance.samples_per_pixel,
        replicates: provenance.replicates,
        ..picture_settings(provenance.seed, truth.size(), truth.shutter)
    };
    settings.check_truth(work.scene, alignment)?;
    let own = tracer::truth_hash(work.scene, &settings, alignment);
    work.expect_hash(path, &provenance.content_hash, &own)?;
    check_memory(work.scene, &settings, settings.replicates)?;
    let folder = work.kept.folder.clone();
    let files = ReplicateFiles::new(folder, work.scene, &settings, alignment);
    expect_mean(work, path, &truth, &files)?;
    // A run that asks for more replicates takes those beyond the truth's as well.
    let mut indices = work.list_own(&files);
    indices.extend(0..settings.replicates);
    let mut tiles = trace_replicate_tiles(work, &settings, &files, &indices)?;
    tiles.extend(trace_rung_tiles(work, &settings, &truth)?);
    Ok(tiles)
}

/// Verifies replicates that have no truth beside them, as a part of a render has. A ladder goes with a truth.
fn verify_part(work: &Work, alignment: Alignment) -> Result<Vec<(PathBuf, Tile)>, Error> {
    if let Some(rung) = work.kept.rungs(alignment).first() {
        let ladder = work.path(RenderFile::Rung(alignment, *rung));
        return Err(Error::Broken(format!(
            "{}: there is no truth_{alignment}.exr beside it, without which a ladder cannot be traced again; render {} again",
            work.shown(&ladder).display(),
            work.scene.id
        )));
    }
    let Some(first) = work.kept.replicates(alignment).pop_first() else {
        return Ok(Vec::new());
    };
    let path = work.path(RenderFile::Replicate(alignment, first));
    let replicate = Replicate::read(&path)?;
    let (color, provenance) = (&replicate.picture.color, &replicate.provenance);
    let settings = RenderSettings {
        // Those of the smallest truth that it can be a part of.
        samples_per_pixel: provenance.samples_per_pixel.saturating_mul(2),
        replicates: 2,
        ..picture_settings(
            provenance.seed,
            (color.width, color.height),
            replicate.shutter,
        )
    };
    settings.check_truth(work.scene, alignment)?;
    check_memory(work.scene, &settings, settings.replicates)?;
    let files = ReplicateFiles::new(work.kept.folder.clone(), work.scene, &settings, alignment);
    work.expect_hash(&path, &provenance.content_hash, &files.hash)?;
    let indices = work.list_own(&files);
    trace_replicate_tiles(work, &settings, &files, &indices)
}

/// Returns the settings of a truth of this size and shutter, but for its samples.
fn picture_settings(seed: u64, (width, height): (u32, u32), shutter: Shutter) -> RenderSettings {
    RenderSettings {
        width,
        height,
        seed,
        // That of the shutter, bit for bit: an interval has it whole or in halves.
        exposure: Some(shutter.close - shutter.open),
        ..RenderSettings::default()
    }
}

/// Refuses a truth that is not the mean of its replicates.
fn expect_mean(
    work: &Work,
    path: &Path,
    truth: &Truth,
    files: &ReplicateFiles,
) -> Result<(), Error> {
    let replicates = (0..truth.provenance.replicates)
        .map(|index| Replicate::read(&files.path(index)))
        .collect::<Result<Vec<_>, _>>()?;
    let mean = Truth::of(&replicates)?.to_exr();
    let (width, height) = truth.size();
    match find_difference(&read_exr(path)?, Tile::whole(width, height), &mean) {
        None => Ok(()),
        Some(difference) => Err(Error::Broken(format!(
            "{}: is not the mean of its replicates: {difference}; {}",
            work.shown(path).display(),
            work.way_out()
        ))),
    }
}
