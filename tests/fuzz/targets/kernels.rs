//! Kernels, which are run if they load.

use filters::{Blur, Filter, Gpu, Input};
use frame::{Image, Plane, Raster, Vectors};

use super::filter::{sources, write};
use crate::seeds::Seed;
use crate::target::{Shape, Target};
use crate::tokens;

/// WGSL on the adapter, over a few pixels.
pub static TARGET: Target = Target {
    name: "kernels",
    share: 150,
    batch: 50,
    shape: Shape::Text,
    tokens: tokens::WGSL,
    seeds: |_| -> Vec<Seed> { sources() },
    run: |place, input| {
        let Ok(filter) = Filter::load(&write(place, input)) else {
            return;
        };
        let gpu = (place.gpu).get_or_insert_with(|| Gpu::new(None).expect("an adapter"));
        let settings = filter.settings(None).expect("a filter has a preset");
        if let Ok(mut blur) = Blur::new(gpu, &filter, &settings, WIDTH, HEIGHT) {
            drop(blur.run(&Input {
                color: &[&color()],
                velocity: &velocity(),
                depth: &depth(),
                reprojection: None,
                camera: None,
                exposure: 0.5,
                frames_per_second: None,
                frame_index: 0,
            }));
        }
    },
};

const WIDTH: u32 = 16;
const HEIGHT: u32 = 16;

fn raster<T>(pixel: impl Fn(f32, f32) -> T) -> Raster<T> {
    let pixels = (0..WIDTH * HEIGHT)
        .map(|index| pixel((index % WIDTH) as f32, (index / WIDTH) as f32))
        .collect();
    Raster {
        width: WIDTH,
        height: HEIGHT,
        pixels,
    }
}

fn color() -> Image {
    raster(|x, y| [x / 16.0, y / 16.0, 0.5])
}

fn velocity() -> Vectors {
    raster(|x, _| [x - 8.0, 2.0])
}

fn depth() -> Plane {
    raster(|x, y| 1.0 + x + y)
}
