//! Properties of every built-in filter with every preset.

mod colours;
mod repeated;
mod smear;
mod symmetry;

use filters::{Filter, Input, Settings};
use frame::{FAR_DEPTH, Image, Plane, Raster, Reprojection, Vectors};
use tests::random::Random;
use tests::ready_blur;

#[derive(Clone)]
struct Field {
    color: Image,
    velocity: Vectors,
    depth: Plane,
    reprojection: Reprojection,
    exposure: f64,
}

const WIDTH: u32 = 71;
const HEIGHT: u32 = 43;

impl Field {
    /// Makes highlights of up to 10000, still pixels, motion of up to 60 pixels, near surfaces and far background.
    fn random(seed: u64) -> Self {
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
        Self {
            color,
            velocity,
            depth,
            // A pan, a zoom and a step aside.
            reprojection: Reprojection {
                rows: [
                    [1.02, 0.0, 9.0, 15.0],
                    [0.0, 1.02, -5.0, 3.0],
                    [0.0, 0.0, 1.0, 0.1],
                ],
            },
            exposure: 0.8,
        }
    }

    fn blur(&self, filter: &Filter, settings: &Settings) -> Image {
        let mut outputs = self.blur_colors(filter, settings, &[&self.color]);
        outputs.remove(0)
    }

    fn blur_colors(&self, filter: &Filter, settings: &Settings, color: &[&Image]) -> Vec<Image> {
        let size = (self.color.width, self.color.height);
        let mut blur = ready_blur(filter, settings, size);
        blur.run(&self.input(color)).unwrap()
    }

    fn input<'a>(&'a self, color: &'a [&'a Image]) -> Input<'a> {
        Input {
            color,
            velocity: &self.velocity,
            depth: &self.depth,
            reprojection: Some(self.reprojection),
            camera: None,
            exposure: self.exposure,
            frames_per_second: None,
            frame_index: 3,
        }
    }
}
