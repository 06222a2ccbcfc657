//! Scores of finished sequences: pictures of consecutive frames from elsewhere.

use std::path::{Path, PathBuf};

use frame::{Frame, Image, Size, Truth};
use metrics::{Instant, SequenceMeasurement, SequenceReference};
use scene::Scene;
use tracer::{RenderSettings, truth_hash};

use crate::Error;
use crate::measuring::points_of_frame::{make_instant, trace_points};

/// Frame and truth of one frame of a sequence, and the truth's file, for messages.
pub struct SequenceTruth {
    /// What the filter got.
    pub frame: Frame,
    /// Truth of its shutter.
    pub truth: Truth,
    /// File of the truth.
    pub path: PathBuf,
}

/// Names a later frame's file from the first one's, as `run` and `render` lay them out:
/// `out/fan/frame.exr` is followed by `out/fan/0001/frame.exr`.
pub fn file_at_frame(first: &Path, frame: u32) -> PathBuf {
    match (frame, first.file_name()) {
        (1.., Some(name)) => first.with_file_name(format!("{frame:04}")).join(name),
        _ => first.to_owned(),
    }
}

/// Scores one picture per frame, from the first on, against the truths of a scene's frames, as
/// `run` scores filters' sequences.
///
/// # Errors
/// A truth belongs to another scene or frame, or a picture has another size.
pub fn score_sequence(
    pictures: &[Image],
    scene: &Scene,
    truths: &[SequenceTruth],
    per_second: f64,
) -> Result<SequenceMeasurement, Error> {
    let instants = (0..).zip(truths).map(|(frame, frame_truth)| {
        let scene = scene.at_frame(frame);
        let settings = settings_of(frame_truth);
        check_scene(&scene, &settings, frame_truth)?;
        Ok(make_instant(
            &frame_truth.truth,
            trace_points(&scene, &settings)?,
        ))
    });
    let instants = instants.collect::<Result<Vec<Instant>, Error>>()?;
    let reference = SequenceReference::new(instants, &scene.display.into(), per_second);
    Ok(reference.measure(pictures)?)
}

/// Returns a truth's render settings, as stated in its files.
fn settings_of(frame_truth: &SequenceTruth) -> RenderSettings {
    let Size { width, height } = frame_truth.truth.size();
    let provenance = &frame_truth.truth.provenance;
    RenderSettings {
        width,
        height,
        samples_per_pixel: provenance.samples_per_pixel,
        // A file may say anything.
        replicates: provenance.replicates.max(1),
        seed: provenance.seed,
        exposure: Some(frame_truth.frame.exposure),
        ..RenderSettings::default()
    }
}

/// Refuses a truth of another scene: its motion, which the scores follow, would be another.
fn check_scene(
    scene: &Scene,
    settings: &RenderSettings,
    frame_truth: &SequenceTruth,
) -> Result<(), Error> {
    let provenance = &frame_truth.truth.provenance;
    if scene.id != provenance.scene.as_str() {
        return Err(Error::Refused(format!(
            "{}: is the truth of {}; needed: that of {}",
            frame_truth.path.display(),
            provenance.scene,
            scene.id
        )));
    }
    if truth_hash(scene, settings, frame_truth.truth.alignment) == provenance.content_hash {
        Ok(())
    } else {
        Err(Error::Refused(format!(
            "{}: was rendered from other files of the scene {}, or by another version of this program, and the scores of a sequence \
             follow the scene's motion; render frames and truths again",
            frame_truth.path.display(),
            scene.id
        )))
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
