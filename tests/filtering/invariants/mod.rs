//! Properties of every built-in filter with every preset.

mod colours;
mod repeated;
mod smear;
mod symmetry;

use filters::{Filter, Settings};
use frame::{Image, Reprojection};
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

fn blur(field: &Field, filter: &Filter, settings: &Settings) -> Image {
    blur_colors(field, filter, settings, &[&field.color]).remove(0)
}

fn blur_colors(
    field: &Field,
    filter: &Filter,
    settings: &Settings,
    colors: &[&Image],
) -> Vec<Image> {
    let size = (field.color.width, field.color.height);
    let mut blur = ready_blur(filter, settings, size);
    blur.run(&field.input(colors, FRAME_INDEX)).unwrap()
}
