//! Truths of scenes, made of replicates.

use std::ops::Range;
use std::path::Path;

use frame::{Alignment, Region, Replicate, Truth};
use tracer::{RenderSettings, Scene};

use super::memory::check_memory;
use super::replicates::ReplicateFiles;
use crate::folder::scene_folder::{refuse_scene, scene_folder};
use crate::{Error, Monitor};

/// Renders the truth of `scene` over the shutter of `alignment` and writes it to `out`. Reads the truth from there if its inputs
/// are the same, or else those of its replicates that are.
pub fn render_truth(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    out: &Path,
    monitor: Monitor,
) -> Result<Truth, Error> {
    let files = ReplicateFiles::new(scene_folder(out, scene), scene, settings, alignment);
    let expected = tracer::truth_hash(scene, settings, alignment);
    if let Ok(found) = Truth::read(&files.truth_path())
        && found.provenance.content_hash == expected
    {
        return Ok(found);
    }
    settings.check_truth(scene, alignment)?;
    check_memory(scene, settings, settings.replicates)?;
    let all = 0..settings.replicates;
    let replicates = files.read_or_render(scene, settings, all, monitor)?;
    let truth = Truth::of(&replicates)?;
    // Writing takes as much memory again as they do.
    drop(replicates);
    truth.write(&files.truth_path())?;
    Ok(truth)
}

/// Adds replicates in pairs until the noise floor reaches `target` where anything moves (everywhere if nothing does), or there
/// are `most`; returns the truth, and true if it reached the target.
///
/// The floor that ends the render is measured on the same halves that the truth keeps: where the render ends early because
/// they happened to agree, the floor reads a little low.
pub fn render_truth_until(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    (target, most): (f64, u32),
    out: &Path,
    monitor: Monitor,
) -> Result<(Truth, bool), Error> {
    let mut settings = *settings;
    loop {
        let truth = render_truth(scene, &settings, alignment, out, monitor)?;
        let (_, floor) = deciding_floor(&truth);
        if floor <= target {
            return Ok((truth, true));
        }
        if settings.replicates + 2 > most {
            return Ok((truth, false));
        }
        settings = settings.with_replicates(settings.replicates + 2);
    }
}

/// Returns the noise floor that a target is compared with: that of the moving region, or of the whole picture where nothing
/// moves.
pub fn deciding_floor(truth: &Truth) -> (Region, f64) {
    let floors = truth.noise_floors();
    *floors
        .iter()
        .find(|(region, _)| *region == Region::Moving)
        .or(floors.last())
        .expect("a picture has pixels")
}

/// Renders all replicates of a truth, or reads those that `out` holds.
pub(crate) fn render_replicates(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    out: &Path,
    monitor: Monitor,
) -> Result<Vec<Replicate>, Error> {
    let files = ReplicateFiles::new(scene_folder(out, scene), scene, settings, alignment);
    settings.check_truth(scene, alignment)?;
    files.read_or_render(scene, settings, 0..settings.replicates, monitor)
}

/// Renders some replicates of a truth and keeps them in `out`.
pub fn render_part(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    indices: Range<u32>,
    out: &Path,
    monitor: Monitor,
) -> Result<(), Error> {
    let folder = scene_folder(out, scene);
    refuse_scene(&folder)?;
    settings.check_truth(scene, alignment)?;
    check_memory(scene, settings, indices.len() as u32)?;
    let files = ReplicateFiles::new(folder, scene, settings, alignment);
    (files.read_or_render(scene, settings, indices, monitor)).map(drop)
}
