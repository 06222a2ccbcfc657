//! Velocity and depth fields by formula: the same on every machine.

use filters::{Blur, Input};
use frame::{FAR_DEPTH, Image, Plane, Raster, Vectors};
use tests::random::Random;

/// Content of a frame without its provenance.
pub struct Field {
    pub color: Image,
    /// Motion, in pixels per frame.
    pub velocity: Vectors,
    /// Distance, in metres.
    pub depth: Plane,
}

impl Field {
    /// Runs a filter on the field; returns its picture.
    pub fn blur(&self, blur: &mut Blur, exposure: f64, frame_index: u32) -> Image {
        let input = Input {
            color: &[&self.color],
            velocity: &self.velocity,
            depth: &self.depth,
            reprojection: None,
            camera: None,
            exposure,
            frames_per_second: None,
            frame_index,
        };
        blur.run(&input).unwrap().remove(0)
    }
}

/// Makes a field in which every pixel moves on its own, at its own depth; a sixth stands still, a tenth is far
/// background.
pub fn noise(width: u32, height: u32, seed: u64) -> Field {
    let mut random = Random::new(seed);
    let color = Raster::from_fn(width, height, |_, _| {
        std::array::from_fn(|_| random.real(0.0, 2.0))
    });
    let velocity = Raster::from_fn(width, height, |_, _| {
        let still = random.real(0.0, 6.0) < 1.0;
        let motion = [random.real(-40.0, 40.0), random.real(-40.0, 40.0)];
        if still { [0.0, 0.0] } else { motion }
    });
    let depth = Raster::from_fn(width, height, |_, _| {
        let far = random.real(0.0, 10.0) < 1.0;
        let near = random.real(0.5, 20.0);
        if far { FAR_DEPTH } else { near }
    });
    Field {
        color,
        velocity,
        depth,
    }
}

/// Makes rectangles of one motion and one depth each over a panning background, so that many sources lie equally deep.
pub fn rectangles(width: u32, height: u32, seed: u64) -> Field {
    let mut random = Random::new(seed);
    let mut field = noise(width, height, seed);
    field.velocity = Raster::filled(
        width,
        height,
        [random.real(-9.0, 9.0), random.real(-4.0, 4.0)],
    );
    field.depth = Raster::filled(width, height, FAR_DEPTH);
    for index in 0..9 {
        let [left, top] = [width, height].map(|side| random.real(-0.1, 0.9) * side as f32);
        let [right, bottom] = [left + random.real(3.0, 35.0), top + random.real(3.0, 25.0)];
        let still = index % 3 == 0;
        let motion = [random.real(-40.0, 40.0), random.real(-30.0, 30.0)];
        let motion = if still { [0.0, 0.0] } else { motion };
        let depth = random.real(1.0, 30.0);
        for y in 0..height {
            for x in 0..width {
                let (column, row) = (x as f32, y as f32);
                let pixel = (y * width + x) as usize;
                let covers = column >= left && column < right && row >= top && row < bottom;
                if covers && depth < field.depth.pixels[pixel] {
                    field.velocity.pixels[pixel] = motion;
                    field.depth.pixels[pixel] = depth;
                }
            }
        }
    }
    field
}
