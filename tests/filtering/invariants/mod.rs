//! Properties of every built-in filter with every preset.

mod colours;
mod repeated;
mod smear;
mod symmetry;

use filters::{Blur, Filter, Settings};
use frame::{Image, Reprojection};
use tests::presets::{every_preset, preset_name};
use tests::random::Random;
use tests::ready_blur;

use crate::fields::{Field, noise};

const WIDTH: u32 = 71;
const HEIGHT: u32 = 43;
const FRAME_INDEX: u32 = 3;

/// Makes highlights of up to 10000, still pixels, motion of up to 60 pixels, near surfaces and far
/// background.
fn random(seed: u64) -> Field {
    let field = noise(WIDTH, HEIGHT, seed);
    let mut random = Random::new(seed);
    let color = field.color.map(|pixel| {
        let highlight = random.real(0.0, 20.0) < 1.0;
        pixel.map(|value| value * if highlight { 5e3 } else { 0.5 })
    });
    // A pan, a zoom and a step aside.
    let rows = [
        [1.02, 0.0, 9.0, 15.0],
        [0.0, 1.02, -5.0, 3.0],
        [0.0, 0.0, 1.0, 0.1],
    ];
    Field {
        color,
        velocity: field
            .velocity
            .map(|motion| motion.map(|pixels| 1.5 * pixels)),
        reprojection: Some(Reprojection { rows }),
        exposure: 0.8,
        ..field
    }
}

/// A preset ready for pictures of [`WIDTH`] x [`HEIGHT`].
struct Subject {
    filter: Filter,
    settings: Settings,
    /// Name for messages.
    name: String,
    blur: Blur<'static>,
}

impl Subject {
    fn new(filter: Filter, settings: Settings) -> Self {
        Self {
            name: preset_name(&filter, &settings),
            blur: ready_blur(&filter, &settings, (WIDTH, HEIGHT)),
            filter,
            settings,
        }
    }

    /// Blurs colours over the motion and depth of a field.
    fn run(&mut self, field: &Field, colors: &[&Image]) -> Vec<Image> {
        self.blur.run(&field.input(colors, FRAME_INDEX)).unwrap()
    }
}

/// Checks of a preset, one after another with the same kernels and textures.
const CHECKS: [fn(&mut Subject); 6] = [
    colours::a_still_frame_comes_out_unchanged,
    colours::a_constant_colour_comes_out_constant,
    colours::output_stays_finite_and_within_the_colours_of_the_frame,
    colours::a_mixture_of_images_comes_out_as_the_mixture_of_their_blurs,
    repeated::kept_textures_give_the_same_bytes_after_any_other_run,
    repeated::kept_kernels_give_the_bytes_of_fresh_ones,
];

#[test]
fn every_preset_keeps_the_invariants_of_colours_and_repeated_runs() {
    let mut noisy = 0;
    for (filter, settings) in every_preset() {
        let mut subject = Subject::new(filter, settings);
        for check in CHECKS {
            check(&mut subject);
        }
        noisy += usize::from(repeated::compare_batches_of_noise(&mut subject));
    }
    assert!(noisy > 10, "only {noisy} presets draw noise");
}
