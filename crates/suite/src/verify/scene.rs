//! Verification of a scene's rendered files.

use std::collections::BTreeSet;
use std::path::PathBuf;

use filters::EXCLUSION;
use frame::{
    Alignment, Frame, Provenance, Replicate, Shutter, Tile, Truth, TruthError, read_attribute,
    read_exr,
};
use store::{LADDER, RenderFile};
use tracer::{
    LadderTracer, PixelGrid, RenderSettings, Scene, TruthTracer, trace_frame_part,
    trace_further_velocities,
};

use super::difference::find_difference;
use super::scene_renders::SceneRenders;
use super::tiles::{Verification, Work};
use crate::render::exclusion::draw_exclusion;
use crate::render::files::remove_truth;
use crate::render::memory::check_memory;
use crate::render::settings::settings_of;
use crate::{Error, Monitor};

/// The outcome of a verification.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Verified {
    /// Tiles that were traced again and are equal, with their files.
    pub tiles: Vec<(PathBuf, Tile)>,
    /// Number of truths that are the mean of their replicates.
    pub truths: usize,
    /// Files that differ from what this program makes, and what to do.
    pub differences: Vec<String>,
}

/// Traces again some tiles of a scene's frame, of a replicate of each truth and of a rung of its ladder, and compares them with the files
/// byte for byte. Compares every truth with the mean of its replicates, and verifies replicates without a truth as well. `scene` belongs
/// to the frame that `renders` names: nothing that a file says exempts it.
///
/// # Errors
/// The scene cannot be rendered, or the caller interrupts. Differences are no error.
pub fn verify_scene(
    scene: &Scene,
    renders: &SceneRenders,
    verification: &Verification,
    monitor: Monitor,
) -> Result<Verified, Error> {
    let mut verified = Verified::default();
    let work = Work {
        scene,
        renders,
        verification,
        monitor,
    };
    if renders.files.contains(&RenderFile::Frame) {
        verified.note(verify_frame(&work))?;
    }
    for alignment in renders.alignments() {
        if renders.files.contains(&RenderFile::Truth(alignment)) {
            let is_equal = verified.note(verify_truth(&work, alignment))?;
            verified.truths += usize::from(is_equal);
        } else {
            verified.note(verify_part(&work, alignment))?;
        }
    }
    Ok(verified)
}

impl Verified {
    /// Adds the verification of other scenes.
    pub fn add(&mut self, other: Self) {
        self.tiles.extend(other.tiles);
        self.truths += other.truths;
        self.differences.extend(other.differences);
    }

    /// Records the tiles of a file, or its difference; returns true without a difference.
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
fn verify_frame(work: &Work) -> Result<Vec<(PathBuf, Tile)>, Error> {
    let frame = Frame::read(&work.path(RenderFile::Frame))?;
    let settings = settings_of(&frame);
    let own = tracer::frame_hash(work.scene, &settings);
    work.expect_hash(RenderFile::Frame, &frame.provenance.content_hash, &own)?;
    let grid = PixelGrid::of_picture(settings.width, settings.height);
    let has_further = frame.velocity_next.is_some() || frame.velocity_z.is_some();
    let further = has_further.then(|| trace_further_velocities(work.scene, &settings, &grid));
    let further = further.transpose()?;
    work.trace_tiles(&[RenderFile::Frame], frame.size(), |_, tile, watch| {
        let mut made = trace_frame_part(work.scene, &settings, &grid, Some(tile), watch)?;
        made.frame.velocity_next = further.as_ref().map(|(next, _)| next.part(tile));
        made.frame.velocity_z = further.as_ref().map(|(_, z)| z.part(tile));
        let mut file = made.to_exr();
        if has_further {
            file.push_plane(EXCLUSION, &draw_exclusion(&made.frame, work.scene));
        }
        Ok(file)
    })
}

/// Verifies a truth, its replicates and a rung of its ladder.
fn verify_truth(work: &Work, alignment: Alignment) -> Result<Vec<(PathBuf, Tile)>, Error> {
    let file = RenderFile::Truth(alignment);
    let truth = Truth::read(&work.path(file))?;
    let replicates = truth.provenance.replicates;
    let settings = truth_settings(&truth.provenance, truth.size(), truth.shutter);
    let own = tracer::truth_hash(work.scene, &settings, alignment);
    check_truth(work, file, &settings, &truth.provenance, &own)?;
    expect_mean(work, &truth)?;
    let mut tiles = trace_replicates(work, &settings, alignment, replicates)?;
    let (_, rungs) = work.renders.of_truth(alignment);
    if !rungs.is_empty() {
        let tracer = LadderTracer::new(work.scene, &settings, &truth, &LADDER)?;
        tiles.extend(work.trace_tiles(&rungs, truth.size(), |file, tile, watch| {
            let rung = tracer.trace_tile(file.number(), tile, watch)?;
            Ok(rung.into_exr())
        })?);
    }
    Ok(tiles)
}

/// Traces tiles of replicates again: a truth's, and further ones, which a run with more replicates uses as well.
fn trace_replicates(
    work: &Work,
    settings: &RenderSettings,
    alignment: Alignment,
    of_truth: u32,
) -> Result<Vec<(PathBuf, Tile)>, Error> {
    let hash = Some(tracer::replicate_hash(work.scene, settings, alignment));
    let (found, _) = work.renders.of_truth(alignment);
    let is_own = |file: &RenderFile| read_attribute(&work.path(*file), "content_hash") == hash;
    let found = found.into_iter().filter(is_own);
    let of_truth = (0..of_truth).map(|index| RenderFile::Replicate(alignment, index));
    let own: Vec<RenderFile> = found
        .chain(of_truth)
        .collect::<BTreeSet<_>>()
        .into_iter()
        .collect();
    let tracer = TruthTracer::new(work.scene, settings, &[alignment])?;
    let size = (settings.width, settings.height);
    work.trace_tiles(&own, size, |file, tile, watch| {
        Ok(tracer.trace_tile(file.number(), tile, watch)?[0].to_exr())
    })
}

/// Verifies replicates without a truth, as in a part of a render. A ladder needs a truth.
fn verify_part(work: &Work, alignment: Alignment) -> Result<Vec<(PathBuf, Tile)>, Error> {
    let (replicates, rungs) = work.renders.of_truth(alignment);
    if let Some(rung) = rungs.first() {
        return Err(Error::Broken(format!(
            "{}: there is no {} next to it, which a ladder needs to be traced again; render {} again",
            work.shown(*rung).display(),
            RenderFile::Truth(alignment),
            work.scene.id
        )));
    }
    let Some(&first) = replicates.first() else {
        return Ok(Vec::new());
    };
    let replicate = Replicate::read(&work.path(first))?;
    let (color, provenance) = (&replicate.picture.color, &replicate.provenance);
    let size = (color.width, color.height);
    let settings = RenderSettings {
        // The smallest truth that it can be a part of.
        samples_per_pixel: provenance.samples_per_pixel.saturating_mul(2),
        replicates: 2,
        ..truth_settings(provenance, size, replicate.shutter)
    };
    let own = tracer::replicate_hash(work.scene, &settings, alignment);
    check_truth(work, first, &settings, provenance, &own)?;
    trace_replicates(work, &settings, alignment, 0)
}

/// Reads the settings of a truth or a replicate of this size and shutter.
fn truth_settings(
    provenance: &Provenance,
    (width, height): (u32, u32),
    shutter: Shutter,
) -> RenderSettings {
    RenderSettings {
        width,
        height,
        samples_per_pixel: provenance.samples_per_pixel,
        replicates: provenance.replicates,
        seed: provenance.seed,
        // The shutter's, bit for bit: an interval has it whole or in halves.
        exposure: Some(shutter.close - shutter.open),
        ..RenderSettings::default()
    }
}

/// Refuses settings that a truth of the scene cannot have, a file with another hash than `own`, and too little memory.
fn check_truth(
    work: &Work,
    file: RenderFile,
    settings: &RenderSettings,
    provenance: &Provenance,
    own: &str,
) -> Result<(), Error> {
    let alignment = file.alignment().expect("it is of a truth");
    settings.check_truth(work.scene, alignment)?;
    work.expect_hash(file, &provenance.content_hash, own)?;
    check_memory(work.scene, settings, settings.replicates)
}

/// Refuses a truth that is not the mean of its replicates.
fn expect_mean(work: &Work, truth: &Truth) -> Result<(), Error> {
    let file = RenderFile::Truth(truth.alignment);
    let replicates = (0..truth.provenance.replicates)
        .map(|index| Replicate::read(&work.path(RenderFile::Replicate(truth.alignment, index))))
        .collect::<Result<Vec<_>, _>>()?;
    let mean = Truth::of(&replicates).map_err(|error| {
        let way_out = match error {
            TruthError::Foreign { .. } => remove_truth(&work.shown(file).with_extension("")),
            _ => String::new(),
        };
        work.altered(
            file,
            &format!("is not the mean of its replicates: {error}; {way_out}render it again"),
        )
    })?;
    let mean = mean.to_exr();
    let whole = Tile::whole(mean.width, mean.height);
    find_difference(&read_exr(&work.path(file))?, whole, &mean).map_or(Ok(()), |difference| {
        let text = format!("is not the mean of its replicates: {difference}");
        Err(work.altered(file, &text))
    })
}
