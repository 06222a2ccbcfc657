//! Properties of every built-in filter with every preset.

mod colours;
mod repeated;
mod smear;
mod symmetry;

use filters::{Filter, Settings};
use frame::{FAR_DEPTH, Image, Raster, Reprojection};
use tests::random::Random;
use tests::ready_blur;

use crate::fields::Field;

const WIDTH: u32 = 71;
const HEIGHT: u32 = 43;
const FRAME_INDEX: u32 = 3;

/// Makes highlights of up to 10000, still pixels, motion of up to 60 pixels, near surfaces and far background.
fn random(seed: u64) -> Field {
    let mut random = Random::new(seed);
    let color = Raster::from_fn(WIDTH, HEIGHT, |_, _| {
        let highlight = random.real(0.0, 20.0) < 1.0;
        let top = if highlight { 1e4 } else { 1.0 };
        std::array::from_fn(|_| random.real(0.0, top))
    });
    let velocity = Raster::from_fn(WIDTH, HEIGHT, |_, _| {
        let still = random.real(0.0, 4.0) < 1.0;
        let top = if still { 0.0 } else { 60.0 };
        std::array::from_fn(|_| random.real(-1.0, 1.0) * top)
    });
    let depth = Raster::from_fn(WIDTH, HEIGHT, |_, _| {
        let far = random.real(0.0, 8.0) < 1.0;
        let near = random.real(0.2, 40.0);
        if far { FAR_DEPTH } else { near }
    });
    // A pan, a zoom and a step aside.
    let rows = [
        [1.02, 0.0, 9.0, 15.0],
        [0.0, 1.02, -5.0, 3.0],
        [0.0, 0.0, 1.0, 0.1],
    ];
    Field {
        color,
        velocity,
        depth,
        reprojection: Some(Reprojection { rows }),
        exposure: 0.8,
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
