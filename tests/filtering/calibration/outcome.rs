//! Every shot, blurred by every filter.

use std::sync::LazyLock;

use filters::{Blur, Input};
use frame::Plane;
use tests::open_gpu;
use tests::presets::{every_preset, gain};

use super::panel::{EXPOSURE, HEIGHT, Shot, WIDTH};

pub const SPEEDS: [f64; 5] = [3.0, 8.0, 16.0, 24.0, 48.0];
pub const ANGLES: [f64; 4] = [0.0, 30.0, 90.0, 135.0];

pub struct Outcome {
    pub filter: String,
    pub preset: String,
    /// Index into [`SHOTS`].
    pub shot: usize,
    /// Blur of [`Shot::painted`], without the gain of the preset.
    pub painted: Plane,
    /// Blur of [`Shot::matte`], without the gain of the preset.
    pub matte: Plane,
}

/// A shot for every angle at every speed.
pub static SHOTS: LazyLock<Vec<Shot>> = LazyLock::new(|| {
    let speeds = SPEEDS.into_iter();
    speeds
        .flat_map(|speed| ANGLES.map(|degrees| Shot::new(speed, degrees)))
        .collect()
});

/// Blurs by every preset, in the order of the shots.
pub static OUTCOMES: LazyLock<Vec<Outcome>> = LazyLock::new(|| {
    let gpu = open_gpu();
    let mut outcomes = Vec::new();
    for (filter, settings) in every_preset() {
        let mut blur = Blur::new(&gpu, &filter, &settings, WIDTH, HEIGHT).unwrap();
        for (index, shot) in SHOTS.iter().enumerate() {
            // Colours get the same weights, so that one run blurs both.
            let color = shot.painted().zip(shot.matte(), |a, b| [*a, *b, 0.0]);
            let input = Input {
                color: &[&color],
                velocity: &shot.frame.velocity,
                depth: &shot.frame.depth,
                reprojection: Some(shot.frame.reprojection),
                camera: shot.frame.camera,
                exposure: EXPOSURE,
                frames_per_second: None,
                frame_index: 0,
            };
            let gain = gain(&filter, &settings);
            let blurred = blur.run(&input).unwrap().remove(0);
            outcomes.push(Outcome {
                filter: filter.name.clone(),
                preset: settings.preset.clone(),
                shot: index,
                painted: blurred.map(|[painted, ..]| painted / gain),
                matte: blurred.map(|[_, matte, _]| matte / gain),
            });
        }
    }
    outcomes
});

impl Outcome {
    pub fn shot(&self) -> &'static Shot {
        &SHOTS[self.shot]
    }

    pub fn describe(&self) -> String {
        let shot = self.shot();
        format!(
            "{} {} at {} px and {} degrees",
            self.filter, self.preset, shot.speed, shot.degrees
        )
    }
}
