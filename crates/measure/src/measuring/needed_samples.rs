//! How many samples per pixel a scene needs for a noise.

use std::path::PathBuf;

use scene::Scene;
use serde::Serialize;
use tracer::{MAX_SAMPLES, RenderSettings};

use super::plan::RunPlan;
use crate::render::in_memory::small_settings;
use crate::render::run_scene::RunScene;
use crate::{Error, MemoryRender, RenderFile, hash_inputs, look_up, put};

/// Samples per pixel of the renders that the noise is measured on.
const PILOT: u32 = 64;
/// File with the number of samples, next to the frame.
const RECORD: &str = "samples.json";

/// Everything that determines the number of samples of a scene.
#[derive(Serialize)]
struct Inputs {
    /// Hash of the truth that the noise is measured on.
    truth: String,
    noise: f64,
}

/// Place of a scene's number of samples, and the hash of what determines it.
struct Record {
    path: PathBuf,
    inputs: String,
}

impl RunPlan {
    /// Finds the samples per pixel that bring truth and frame of each scene to the noise `target`,
    /// a root mean square of radiance where anything moves. Two small renders of every scene
    /// tell it; the folder keeps the number. Engines' scenes have the samples that they have.
    ///
    /// # Errors
    /// More samples than allowed would be needed, a scene cannot be rendered with the plan's
    /// settings, or the monitor interrupted.
    pub fn find_needed_samples(&self, target: f64) -> Result<Vec<u32>, Error> {
        let scenes = self.scenes.iter();
        let needed = scenes.map(|scene| match self.look_up_samples(scene, target) {
            Some(samples) => Ok(samples),
            None => self.measure_samples(scene, target),
        });
        needed.collect()
    }

    /// Counts the scenes that [`RunPlan::find_needed_samples`] renders.
    pub fn count_unknown_samples(&self, target: f64) -> usize {
        let scenes = self.scenes.iter();
        let unknown = scenes.filter(|scene| self.look_up_samples(scene, target).is_none());
        unknown.count()
    }

    fn look_up_samples(&self, scene: &Scene, target: f64) -> Option<u32> {
        let record = self.samples_record(scene, target);
        look_up(&record.path, &record.inputs)
    }

    fn measure_samples(&self, scene: &Scene, target: f64) -> Result<u32, Error> {
        let settings = self.pilot();
        let render = MemoryRender {
            scene,
            settings,
            alignment: self.alignments()[0],
            noise: Some(target),
            subframes: 0,
            monitor: self.monitor,
        };
        let [truth, frame] = render.predict_samples(target)?;
        let samples = round_up(truth.max(frame), settings.replicates)
            .ok_or_else(|| too_many(&scene.id.to_string(), target))?;
        let record = self.samples_record(scene, target);
        put(&record.path, record.inputs, &[], &samples)?;
        Ok(samples)
    }

    fn samples_record(&self, scene: &Scene, target: f64) -> Record {
        let truth = RenderFile::Truth(self.alignments()[0]);
        Record {
            path: self.out.join(scene.id.folder()).join(RECORD),
            inputs: hash_inputs(&Inputs {
                truth: RunScene::from(scene).content_hash(truth, &self.pilot()),
                noise: target,
            }),
        }
    }

    /// Returns the settings of the renders that [`RunPlan::find_needed_samples`] makes of a scene.
    pub fn pilots(&self) -> [RenderSettings; 2] {
        small_settings(self.pilot())
    }

    /// The samples of the renders that measure the noise, at the picture's size.
    fn pilot(&self) -> RenderSettings {
        RenderSettings {
            samples_per_pixel: PILOT,
            replicates: RenderSettings::default().replicates,
            ..self.render
        }
        .with_replicates(self.render.replicates)
    }
}

/// Rounds up to samples that every replicate has as many of, no fewer than the small render had;
/// none if they are too many.
fn round_up(needed: f64, replicates: u32) -> Option<u32> {
    let needed = needed.max(f64::from(PILOT.max(replicates)));
    let each = (needed / f64::from(replicates)).ceil();
    (each * f64::from(replicates) <= f64::from(MAX_SAMPLES)).then(|| each as u32 * replicates)
}

fn too_many(scene: &str, target: f64) -> Error {
    Error::TooNoisy(format!(
        "{scene}: a noise of {target:e} takes more than {MAX_SAMPLES} samples per pixel; allow more noise with --noise, or \
         remove what makes the scene noisy: small bright lights, and glossy surfaces that reflect them"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replicates_have_equal_numbers() {
        assert_eq!(round_up(3.0, 8), Some(PILOT));
        assert_eq!(round_up(64.0, 8), Some(64));
        assert_eq!(round_up(64.1, 8), Some(72));
        assert_eq!(round_up(81.0, 10), Some(90));
        assert_eq!(round_up(f64::from(MAX_SAMPLES), 8), Some(MAX_SAMPLES));
        assert_eq!(round_up(f64::from(MAX_SAMPLES) + 1.0, 8), None);
    }
}
