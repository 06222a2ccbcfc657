//! Small frames of surfaces that move to one side each, and their blurs.

use filters::{Blur, Filter, Gpu, Input, Settings};
use frame::{Image, Plane, Raster, Vectors};

use crate::ramp::Ramp;

/// A surface, as a pixel sees it.
#[derive(Clone, Copy)]
pub struct Surface {
    /// Grey value.
    pub gray: f32,
    /// Pixels per frame, +x right, +y down.
    pub velocity: [f32; 2],
    /// Metres.
    pub depth: f32,
}

/// Still, and behind all else.
pub const BLACK_WALL: Surface = Surface {
    gray: 0.0,
    velocity: [0.0, 0.0],
    depth: 20.0,
};

/// A white surface in front of the wall that moves right by so many pixels per frame.
pub const fn white(speed: f32) -> Surface {
    Surface {
        gray: 1.0,
        velocity: [speed, 0.0],
        depth: 2.0,
    }
}

/// Input of a filter.
pub struct Picture {
    /// Scene-linear.
    pub color: Image,
    /// Pixels per frame, +x right, +y down.
    pub velocity: Vectors,
    /// Metres.
    pub depth: Plane,
    /// Frames that the shutter is open.
    pub exposure: f64,
}

impl Picture {
    /// The surface at every pixel (column, row); the exposure is one frame.
    pub fn new(width: u32, height: u32, surface: impl Fn(u32, u32) -> Surface) -> Self {
        Self {
            color: Raster::from_fn(width, height, |x, y| [surface(x, y).gray; 3]),
            velocity: Raster::from_fn(width, height, |x, y| surface(x, y).velocity),
            depth: Raster::from_fn(width, height, |x, y| surface(x, y).depth),
            exposure: 1.0,
        }
    }

    /// Makes the input of a filter with these colours instead of its own.
    pub fn input<'a>(&'a self, color: &'a [&'a Image]) -> Input<'a> {
        Input {
            color,
            velocity: &self.velocity,
            depth: &self.depth,
            exposure: self.exposure,
            frame_index: 0,
            reprojection: None,
        }
    }

    /// A filter's output with parameters set as on the command line.
    pub fn blurred(&self, filter: &str, preset: &str, overrides: &[(&str, &str)]) -> Image {
        let (filter, settings) = settings(filter, preset, overrides);
        let (width, height) = (self.color.width, self.color.height);
        let gpu = Gpu::new(None).expect("these tests run filters");
        let mut blur = Blur::new(&gpu, &filter, &settings, width, height).unwrap();
        blur.run(&self.input(&[&self.color])).unwrap().remove(0)
    }

    /// Runs a filter; returns one of its textures.
    pub fn texture(
        &self,
        filter: &str,
        overrides: &[(&str, &str)],
        texture: &str,
    ) -> Raster<[f32; 4]> {
        let (filter, settings) = settings(
            filter,
            &Filter::builtin(filter).unwrap().presets[0].name,
            overrides,
        );
        let (width, height) = (self.color.width, self.color.height);
        let gpu = Gpu::new(None).expect("these tests run filters");
        let mut blur = Blur::new(&gpu, &filter, &settings, width, height).unwrap();
        blur.run(&self.input(&[&self.color])).unwrap();
        blur.read_texture(texture).unwrap()
    }
}

fn settings(filter: &str, preset: &str, overrides: &[(&str, &str)]) -> (Filter, Settings) {
    let filter = Filter::builtin(filter).unwrap();
    let mut settings = filter.settings(Some(preset)).unwrap();
    for (parameter, value) in overrides {
        settings.set(&filter, parameter, value).unwrap();
    }
    (filter, settings)
}

/// Grey value of a column, over all rows: noise becomes the distribution that it is drawn from.
pub fn column(image: &Image, x: u32) -> f64 {
    let sum: f64 = (0..image.height)
        .map(|y| f64::from(image.at(x, y)[0]))
        .sum();
    sum / f64::from(image.height)
}

/// Length in pixels of the even ramp that spreads as far as what became of an edge.
pub fn ramp_length(image: &Image) -> f64 {
    let profile: Vec<(f64, f64)> = (0..image.width)
        .map(|x| (f64::from(x), column(image, x)))
        .collect();
    Ramp::of(&profile).length
}

/// Black on the left and white on the right of the middle, all in one motion at one depth.
pub fn moving_edge(width: u32, height: u32, velocity: [f32; 2]) -> Picture {
    Picture::new(width, height, |x, _| Surface {
        gray: if x < width / 2 { 0.0 } else { 1.0 },
        velocity,
        depth: 2.0,
    })
}

/// A black picture whose lower half moves fast in front, and in its upper half something white that moves less.
pub fn slow_above_fast(slow: f32, fast: f32) -> Picture {
    Picture::new(320, 64, |x, y| match (x, y) {
        (_, 32..) => Surface {
            gray: 0.0,
            ..white(fast)
        },
        (160.., _) => white(slow),
        _ => BLACK_WALL,
    })
}

/// Light in the rows just above the fast half, so many pixels left of the slow thing.
pub fn light_above(output: &Image, distances: std::ops::Range<u32>) -> f32 {
    let pixels = distances.flat_map(|distance| (24..32).map(move |y| (159 - distance, y)));
    pixels.map(|(x, y)| output.at(x, y)[0]).sum()
}

/// Sum of the columns.
pub fn light(image: &Image, columns: std::ops::Range<u32>) -> f64 {
    columns.map(|x| column(image, x)).sum()
}
