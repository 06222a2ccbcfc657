//! Truths of scenes, made of replicates.

use std::ops::Range;
use std::path::Path;

use frame::{Alignment, Region, Truth};
use store::{MAX_REPLICATES, refuse_scene, scene_folder};
use tracer::{RenderSettings, Scene};

use super::memory::check_memory;
use super::replicates::{TruthFiles, render_shared};
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
    let files = TruthFiles::new(scene, settings, alignment, out, monitor);
    if let Some(found) = files.read_truth() {
        return Ok(found);
    }
    let truth = files.average()?;
    truth.write(&files.truth_path())?;
    Ok(truth)
}

/// Renders replicates of each truth until its noise floor reaches `target` where anything moves (everywhere if nothing does), or
/// there are `most`. Writes each truth when it ends, and hands it to `ended`, with true if it reached the target: truths of large
/// pictures are too large to be held together.
///
/// The floor that ends the render is measured on the same halves that the truth keeps: where the render ends early because
/// they happened to agree, the floor reads a little low.
pub fn render_truths_until(
    scene: &Scene,
    settings: &RenderSettings,
    alignments: &[Alignment],
    (target, most): (f64, u32),
    out: &Path,
    monitor: Monitor,
    mut ended: impl FnMut(&Truth, bool) -> Result<(), Error>,
) -> Result<(), Error> {
    let mut settings = *settings;
    let mut open = alignments.to_vec();
    while !open.is_empty() {
        let (count, mut next) = (settings.replicates, settings.replicates + 2);
        render_shared(scene, &settings, &open, 0..count, out, monitor)?;
        for alignment in std::mem::take(&mut open) {
            let files = TruthFiles::new(scene, &settings, alignment, out, monitor);
            let found = files.read_truth();
            let is_new = found.is_none();
            let truth = found.map_or_else(|| files.average(), Ok)?;
            let (_, floor) = deciding_floor(&truth);
            if floor > target && count + 2 <= most {
                next = next.max(predict_replicates(count, floor / target));
                open.push(alignment);
                continue;
            }
            if is_new {
                truth.write(&files.truth_path())?;
            }
            ended(&truth, floor <= target)?;
        }
        settings = settings.with_replicates(next.min(most - most % 2));
    }
    Ok(())
}

/// Predicts the even number of replicates that have a noise lower by `factor` than this many: noise falls with the root of their
/// number.
fn predict_replicates(replicates: u32, factor: f64) -> u32 {
    let pairs = 0.5 * f64::from(replicates) * factor.powi(2);
    // No more than there may ever be.
    2 * pairs.ceil().min(f64::from(MAX_REPLICATES / 2)) as u32
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

/// Renders some replicates of a truth and writes them to `out`.
pub fn render_part(
    scene: &Scene,
    settings: &RenderSettings,
    alignment: Alignment,
    indices: Range<u32>,
    out: &Path,
    monitor: Monitor,
) -> Result<(), Error> {
    refuse_scene(&scene_folder(out, scene))?;
    check_memory(scene, settings, indices.len() as u32)?;
    let files = TruthFiles::new(scene, settings, alignment, out, monitor);
    files.replicates(indices).map(drop)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_the_noise_takes_four_times_the_replicates() {
        for (replicates, factor, predicted) in
            [(2, 2.0, 8), (8, 1.01, 10), (6, 1.5, 14), (2, 1e9, 4096)]
        {
            assert_eq!(
                predict_replicates(replicates, factor),
                predicted,
                "{replicates} {factor}"
            );
        }
    }
}
