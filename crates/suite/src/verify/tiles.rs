//! Tiles of kept files, chosen at random and traced again.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use frame::{Frame, Tile, Truth};
use store::{LADDER, RenderFile, ladder_folder};
use tracer::{LadderTracer, RenderSettings, TruthTracer, trace_frame_tile};

use super::work::Work;
use crate::Error;
use crate::render::replicates::ReplicateFiles;

/// Traces tiles of a frame again.
pub(super) fn trace_frame_tiles(
    work: &Work,
    path: &Path,
    settings: &RenderSettings,
    frame: &Frame,
) -> Result<Vec<(PathBuf, Tile)>, Error> {
    let (width, height) = frame.size();
    let mut chance = work.chance("frame");
    let mut tiles = Vec::new();
    for _ in 0..work.verification.tiles {
        let tile = chance.tile(width, height);
        let label = format!("verifying {}, frame", work.scene.id);
        let made = work.monitor.watch(&label, |watch| {
            trace_frame_tile(work.scene, settings, tile, watch)
        })?;
        work.compare(path, tile, &made.to_exr())?;
        tiles.push((work.shown(path), tile));
    }
    Ok(tiles)
}

/// Traces tiles of random ones among some replicates again, and compares the attributes of all of them.
pub(super) fn trace_replicate_tiles(
    work: &Work,
    settings: &RenderSettings,
    files: &ReplicateFiles,
    indices: &BTreeSet<u32>,
) -> Result<Vec<(PathBuf, Tile)>, Error> {
    let indices: Vec<u32> = indices.iter().copied().collect();
    let tracer = TruthTracer::new(work.scene, settings, &[files.alignment])?;
    let mut chance = work.chance(&format!("truth_{}", files.alignment));
    let mut tiles = Vec::new();
    for _ in 0..work.verification.tiles {
        let index = indices[chance.below(indices.len() as u32) as usize];
        let tile = chance.tile(settings.width, settings.height);
        let label = format!(
            "verifying {}, {} replicate {index}",
            work.scene.id, files.alignment
        );
        let made = (work.monitor).watch(&label, |watch| tracer.trace_tile(index, tile, watch))?;
        let path = files.path(index);
        let mut made = made[0].to_exr();
        work.compare(&path, tile, &made)?;
        tiles.push((work.shown(&path), tile));
        for index in indices.iter().filter(|_| tiles.len() == 1) {
            made.set("replicate", index);
            work.compare_attributes(&files.path(*index), &made)?;
        }
    }
    Ok(tiles)
}

/// Traces tiles of random rungs of a truth's ladder again, among those that are kept.
pub(super) fn trace_rung_tiles(
    work: &Work,
    settings: &RenderSettings,
    truth: &Truth,
) -> Result<Vec<(PathBuf, Tile)>, Error> {
    let file = |rung: u32| work.path(RenderFile::Rung(truth.alignment, rung));
    let rungs = work.kept.rungs(truth.alignment);
    if rungs.is_empty() {
        return Ok(Vec::new());
    }
    let tracer = LadderTracer::new(work.scene, settings, truth, &LADDER)?;
    let mut chance = work.chance(&ladder_folder(truth.alignment));
    let mut tiles = Vec::new();
    for _ in 0..work.verification.tiles {
        let rung = rungs[chance.below(rungs.len() as u32) as usize];
        let tile = chance.tile(settings.width, settings.height);
        let label = format!(
            "verifying {}, {rung} sub-frames, {}",
            work.scene.id, truth.alignment
        );
        let made = (work.monitor).watch(&label, |watch| tracer.trace_tile(rung, tile, watch))?;
        let path = file(rung);
        let mut made = made.into_exr();
        work.compare(&path, tile, &made)?;
        tiles.push((work.shown(&path), tile));
        for rung in rungs.iter().filter(|_| tiles.len() == 1) {
            made.set("subframes", rung);
            work.compare_attributes(&file(*rung), &made)?;
        }
    }
    Ok(tiles)
}
