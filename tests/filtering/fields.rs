//! Synthetic velocity and depth fields, the same on every machine.

use filters::{Blur, Input};
use frame::{FAR_DEPTH, Image, Plane, Raster, Reprojection, Vectors};
use tests::random::Random;

/// Content of a frame without its provenance.
#[derive(Clone)]
pub struct Field {
    pub color: Image,
    pub velocity: Vectors,
    pub depth: Plane,
    pub reprojection: Option<Reprojection>,
    pub exposure: f64,
}

impl Field {
    pub fn input<'a>(&'a self, color: &'a [&'a Image], frame_index: u32) -> Input<'a> {
        Input {
            color,
            velocity: &self.velocity,
            velocity_next: Some(&self.velocity),
            velocity_z: None,
            exclusion: None,
            depth: &self.depth,
            reprojection: self.reprojection,
            camera: None,
            exposure: self.exposure,
            frames_per_second: None,
            frame_index,
        }
    }

    pub fn blur(&self, blur: &mut Blur, frame_index: u32) -> Image {
        let mut outputs = blur.run(&self.input(&[&self.color], frame_index)).unwrap();
        outputs.remove(0)
    }
}

/// Makes a field in which every pixel moves on its own, at its own depth; a sixth is still, a tenth
/// is far background.
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
        reprojection: None,
        exposure: 1.0,
    }
}

/// Makes rectangles of one motion and one depth each over a panning background, so that many
/// sources are equally deep.
pub fn rectangles(width: u32, height: u32, seed: u64) -> Field {
    let mut random = Random::new(seed);
    let mut field = noise(width, height, seed);
    let pan = [random.real(-9.0, 9.0), random.real(-4.0, 4.0)];
    field.velocity = Raster::filled(width, height, pan);
    field.depth = Raster::filled(width, height, FAR_DEPTH);
    for index in 0..9 {
        let [left, top] = [width, height].map(|side| random.real(-0.1, 0.9) * side as f32);
        let [right, bottom] = [left + random.real(3.0, 35.0), top + random.real(3.0, 25.0)];
        let still = index % 3 == 0;
        let motion = [random.real(-40.0, 40.0), random.real(-30.0, 30.0)];
        let motion = if still { [0.0, 0.0] } else { motion };
        let depth = random.real(1.0, 30.0);
        for (pixel, (x, y)) in (0..height)
            .flat_map(|y| (0..width).map(move |x| (x, y)))
            .enumerate()
        {
            let (column, row) = (x as f32, y as f32);
            let covers = column >= left && column < right && row >= top && row < bottom;
            if covers && depth < field.depth.pixels[pixel] {
                field.velocity.pixels[pixel] = motion;
                field.depth.pixels[pixel] = depth;
            }
        }
    }
    field
}
