//! Scores of finished sequences: pictures of consecutive frames that were made elsewhere.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use frame::{Frame, Image, Truth};
use metrics::{Instant, Metric, SequenceReference, SequenceScores};
use tracer::{RenderSettings, Scene, truth_hash};

use crate::Error;
use crate::measure::points_of_frame::PointsOfFrame;

/// Frame and truth of one frame of a sequence, and the file of the truth, for messages.
pub struct SequenceTruth {
    /// What the filter got.
    pub frame: Frame,
    /// Truth of its shutter.
    pub truth: Truth,
    /// File of the truth.
    pub path: PathBuf,
}

/// Scores of a finished sequence.
pub struct ScoredSequence {
    /// Scores over all frames.
    pub scores: SequenceScores,
    /// Frame that is worst in a score, from 0, by the metrics that frames have a share in.
    pub worst_frames: BTreeMap<Metric, u32>,
    /// Squared error over what moves, per frame; none where nothing does.
    pub errors: Vec<Option<f64>>,
    /// Squared error of the change along the motion since the frame before, per frame; none for the first.
    pub flickers: Vec<Option<f64>>,
}

/// Names the file of a later frame beside that of the first one, as `run` and `render` lay them out: `out/fan/frame.exr` has
/// `out/fan/0001/frame.exr` behind it.
pub fn file_at_frame(first: &Path, frame: u32) -> PathBuf {
    match (frame, first.file_name()) {
        (1.., Some(name)) => first.with_file_name(format!("{frame:04}")).join(name),
        _ => first.to_owned(),
    }
}

/// Scores one picture per frame, from the first on, against the truths of a scene's frames, as `run` scores the sequences of filters.
///
/// # Errors
/// A truth is not that of the scene at its frame, or a picture has another size.
pub fn score_sequence(
    pictures: &[Image],
    scene: &Scene,
    truths: &[SequenceTruth],
    per_second: f64,
) -> Result<ScoredSequence, Error> {
    let instants = (0..).zip(truths).map(|(frame, own)| {
        let scene = scene.at_frame(frame);
        let settings = settings_of(own);
        check_scene(&scene, &settings, own)?;
        Ok(PointsOfFrame::trace(&scene, &settings)?.instant(&own.truth))
    });
    let instants = instants.collect::<Result<Vec<Instant>, Error>>()?;
    let reference = SequenceReference::new(instants, &scene.display.into(), per_second);
    let measured = reference.measure(pictures)?;
    let worst_frames = measured.worst_frames.into_iter();
    Ok(ScoredSequence {
        scores: measured.scores,
        worst_frames: worst_frames
            .map(|(metric, frame)| (Metric::Sequence(metric), frame as u32))
            .collect(),
        errors: measured.errors,
        flickers: measured.flickers,
    })
}

/// Returns the settings that a truth was rendered with, as its files state them.
fn settings_of(own: &SequenceTruth) -> RenderSettings {
    let (width, height) = own.truth.size();
    let provenance = &own.truth.provenance;
    RenderSettings {
        width,
        height,
        samples_per_pixel: provenance.samples_per_pixel,
        // A file may claim anything.
        replicates: provenance.replicates.max(1),
        seed: provenance.seed,
        exposure: Some(own.frame.exposure),
        ..RenderSettings::default()
    }
}

/// Refuses a truth of another scene: its motion, which the scores follow, would be another.
fn check_scene(scene: &Scene, settings: &RenderSettings, own: &SequenceTruth) -> Result<(), Error> {
    let provenance = &own.truth.provenance;
    if scene.id != provenance.scene.as_str() {
        return Err(Error::Usage(format!(
            "{}: is the truth of {}; needed: that of {}",
            own.path.display(),
            provenance.scene,
            scene.id
        )));
    }
    match truth_hash(scene, settings, own.truth.alignment) == provenance.content_hash {
        true => Ok(()),
        false => Err(Error::Usage(format!(
            "{}: was rendered from other files of the scene {}, or by another version of this program, and the scores of a sequence \
             follow the scene's motion; render frames and truths again",
            own.path.display(),
            scene.id
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_later_frames_lie_in_numbered_folders_beside_the_first() {
        let at = |frame| file_at_frame(Path::new("out/fan/frame.exr"), frame);
        assert_eq!(at(0), Path::new("out/fan/frame.exr"));
        assert_eq!(at(1), Path::new("out/fan/0001/frame.exr"));
        assert_eq!(
            file_at_frame(Path::new("frame.exr"), 12),
            Path::new("0012/frame.exr")
        );
    }
}
