//! Settings of renders, and their check.

use frame::{Alignment, FrameOptions, Shutter, Size};
use scene::{Scene, check_size};
use serde::{Deserialize, Serialize};

use crate::error::TraceError;
use crate::limits::MAX_SAMPLES;
use crate::motion::velocity::earliest_time;

/// Settings of a scene's frame and truths, stored in run.json.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RenderSettings {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Mean samples per pixel of a frame or of a truth over all its replicates, a multiple of their
    /// number; each takes up to 65536. Time grows with them, noise falls faster than their square
    /// root: a pilot shares them out.
    pub samples_per_pixel: u32,
    /// Independent, complete renders; an even number for a truth. More of them measure the noise
    /// better and stratify worse.
    pub replicates: u32,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Options of the frame.
    #[serde(flatten)]
    pub options: FrameOptions,
    /// Pixels by which the frame's rasters extend beyond the picture on every side.
    pub guard_band: u32,
    /// Length of the shutter interval in frames; none means the scene's. Not in run.json, where
    /// every case has its own.
    #[serde(skip)]
    pub exposure: Option<f64>,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self {
            width: 320,
            height: 180,
            samples_per_pixel: 256,
            replicates: 8,
            seed: 1,
            options: FrameOptions::default(),
            guard_band: 0,
            exposure: None,
        }
    }
}

impl RenderSettings {
    /// Returns the size of the picture.
    pub fn size(&self) -> Size {
        Size::new(self.width, self.height)
    }

    /// Returns the same settings for a picture of another size.
    pub fn with_size(&self, Size { width, height }: Size) -> Self {
        Self {
            width,
            height,
            ..*self
        }
    }

    /// Samples per pixel of each replicate.
    pub fn samples_per_replicate(&self) -> u32 {
        self.samples_per_pixel / self.replicates
    }

    /// Changes the number of replicates, each with as many samples as before.
    pub fn with_replicates(&self, replicates: u32) -> Self {
        Self {
            samples_per_pixel: self.samples_per_replicate().saturating_mul(replicates),
            replicates,
            ..*self
        }
    }

    /// Returns the length of the shutter interval, in frames.
    pub fn exposure(&self, scene: &Scene) -> f64 {
        self.exposure.unwrap_or(scene.exposure)
    }

    /// Refuses settings with which the scene's frame cannot be rendered.
    pub fn check_frame(&self, scene: &Scene) -> Result<(), TraceError> {
        check_samples(self.samples_per_pixel, self.replicates)?;
        self.check_instant(scene)
    }

    /// Refuses settings with which the motion at the instant cannot be sampled.
    pub(crate) fn check_instant(&self, scene: &Scene) -> Result<(), TraceError> {
        self.check_sizes()?;
        Alignment::Trailing.shutter(self.exposure(scene))?;
        let earliest = earliest_time(self.options.velocity);
        scene.check_defined(earliest, 0.0)?;
        check_field_of_view(scene, earliest, 0.0)
    }

    /// Refuses a frame of an impossible size, with its guard band or without.
    pub(crate) fn check_sizes(&self) -> Result<(), TraceError> {
        let band = self.guard_band.saturating_mul(2);
        check_size(self.width, self.height)?;
        check_size(
            self.width.saturating_add(band),
            self.height.saturating_add(band),
        )?;
        Ok(())
    }

    /// Refuses settings with which the scene's truth cannot be rendered; returns the shutter.
    pub fn check_truth(&self, scene: &Scene, alignment: Alignment) -> Result<Shutter, TraceError> {
        check_size(self.width, self.height)?;
        if self.replicates < 2 || !self.replicates.is_multiple_of(2) {
            return Err(TraceError::Replicates(self.replicates));
        }
        check_samples(self.samples_per_pixel, self.replicates)?;
        let shutter = alignment.shutter(self.exposure(scene))?;
        scene.shutter_profile.check()?;
        let whole = scene.shutter_profile.whole(shutter);
        scene.check_defined(whole.open, whole.close)?;
        check_field_of_view(scene, whole.open, whole.close)?;
        Ok(shutter)
    }
}

/// Refuses a scene that is not defined up to the next frame, so that its points cannot be followed
/// there.
pub fn check_next_frame(scene: &Scene) -> Result<(), TraceError> {
    scene.check_defined(0.0, 1.0)?;
    check_field_of_view(scene, 0.0, 1.0)
}

fn check_samples(samples_per_pixel: u32, replicates: u32) -> Result<(), TraceError> {
    if replicates == 0 {
        return Err(TraceError::Replicates(replicates));
    }
    let each = samples_per_pixel / replicates;
    if each * replicates == samples_per_pixel && (1..=MAX_SAMPLES).contains(&each) {
        return Ok(());
    }
    Err(TraceError::Samples {
        samples_per_pixel,
        replicates,
        nearest: each.clamp(1, MAX_SAMPLES).saturating_mul(replicates),
    })
}

fn check_field_of_view(scene: &Scene, from: f64, to: f64) -> Result<(), TraceError> {
    for time in scene.camera.vertical_fov_extremes(from, to) {
        let fov = scene.camera.vertical_fov_at(time);
        if !(fov > 0.0 && fov < std::f64::consts::PI) {
            return Err(TraceError::FieldOfView {
                scene: scene.id.to_string(),
                degrees: fov.to_degrees(),
                time,
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use glam::DVec3;
    use scene::{Key, Motion, list_scenes, load_scene};

    use super::*;
    use crate::content_hash::truth_hash;
    use crate::test_scene::{load_test_scene, scenes};

    #[test]
    fn frame_0_is_the_scene_itself() {
        let scene = load_test_scene("fan");
        let settings = RenderSettings::default();
        let hash = |scene: &Scene| truth_hash(scene, &settings, Alignment::Trailing);
        let first = scene.at_frame(0);
        assert_eq!(hash(&first), hash(&scene));
        assert_eq!(first.id, scene.id);
        assert_ne!(hash(&scene.at_frame(1)), hash(&scene));
        assert_ne!(hash(&scene.at_frame(1)), hash(&scene.at_frame(2)));
    }

    #[test]
    fn a_scale_does_not_pass_zero() {
        let mut scene = load_test_scene("fan");
        let shrink = |time: f64, scale: f64| Key {
            time,
            scale: DVec3::splat(scale),
            ..Key::REST
        };
        scene.objects[0].motion = Motion {
            keys: vec![shrink(0.0, 1.0), shrink(1.0, 0.75)],
            ..Motion::default()
        };
        let check = |frame: u32| {
            RenderSettings::default().check_truth(&scene.at_frame(frame), Alignment::Trailing)
        };
        assert_eq!(check(3).err(), None);
        assert!(
            check(4)
                .unwrap_err()
                .to_string()
                .contains("the scale of object")
        );
    }

    #[test]
    fn most_shipped_scenes_go_on_and_the_others_say_where_they_end() {
        let folder = scenes();
        let mut ending = Vec::new();
        for listing in list_scenes(folder.as_path()).unwrap() {
            let scene = load_scene(folder.join(&listing.name), None).unwrap();
            let settings = RenderSettings::default();
            if settings
                .check_truth(&scene.at_frame(24), Alignment::Centred)
                .is_err()
            {
                ending.push(scene.id.name);
            }
        }
        assert_eq!(ending, ["flag", "reversal"]);
    }
}
