//! A shot blurred by a filter.

use filters::Input;
use frame::Plane;
use tests::kernels::{Steady, expected_ramp};
use tests::panel::{SMALL, Shot};
use tests::picture::frame_input;
use tests::presets::{every_preset, gain};
use tests::ramp::Ramp;
use tests::ready_blur;

pub struct Outcome<'s> {
    pub filter: String,
    pub preset: String,
    pub shot: &'s Shot,
    pub steady: Steady,
    /// Ramp that the taps make of an edge that moves with everything.
    pub ramp: Ramp,
    /// Blur of [`Shot::painted`], without the gain of the preset.
    pub painted: Plane,
    /// Blur of [`Shot::matte`], without the gain of the preset.
    pub matte: Plane,
}

/// Blurs every shot by every preset.
pub fn blur_shots(shots: &[Shot]) -> Vec<Outcome<'_>> {
    let mut outcomes = Vec::new();
    for (filter, settings) in every_preset() {
        let mut blur = ready_blur(&filter, &settings, SMALL);
        for shot in shots {
            // Colours get the same weights, so that one run blurs both.
            let color = shot.painted.zip(shot.matte(), |a, b| [*a, *b, 0.0]);
            let colors = [&color];
            let input = Input {
                frames_per_second: None,
                ..frame_input(&shot.frame, &colors)
            };
            let gain = gain(&filter, &settings);
            let blurred = blur.run(&input).unwrap().remove(0);
            outcomes.push(Outcome {
                filter: filter.name.clone(),
                preset: settings.preset.clone(),
                shot,
                steady: shot.steady(),
                ramp: expected_ramp(&filter.name, &settings.preset, &shot.steady()),
                painted: blurred.map(|[painted, ..]| painted / gain),
                matte: blurred.map(|[_, matte, _]| matte / gain),
            });
        }
    }
    outcomes
}

impl Outcome<'_> {
    pub fn describe(&self) -> String {
        let Shot {
            speed,
            degrees,
            exposure,
            ..
        } = self.shot;
        let Self { filter, preset, .. } = self;
        format!("{filter} {preset} at {speed} px, {degrees} degrees and {exposure} frames")
    }
}
