//! Small frames of surfaces, each with its own motion, and their blurs.

use filters::{Blur, Filter, Input, Settings};
use frame::{Frame, Image, Plane, Raster, Reprojection, Size, Vectors};

use crate::ramp::Ramp;
use crate::random::Random;
use crate::ready_blur;

/// A surface as one pixel sees it.
#[derive(Clone, Copy)]
pub struct Surface {
    /// Grey value.
    pub gray: f32,
    /// Motion, in pixels per frame, +x right, +y down.
    pub velocity: [f32; 2],
    /// Depth, in metres.
    pub depth: f32,
}

impl Surface {
    /// Paints the surface in this grey.
    pub const fn gray(self, gray: f32) -> Self {
        Self { gray, ..self }
    }

    /// Gives the surface this motion, in pixels per frame.
    pub const fn moving(self, right: f32, down: f32) -> Self {
        Self {
            velocity: [right, down],
            ..self
        }
    }

    /// Puts the surface at this depth, in metres.
    pub const fn at(self, depth: f32) -> Self {
        Self { depth, ..self }
    }
}

/// Still surface behind all others.
pub const BLACK_WALL: Surface = Surface {
    gray: 0.0,
    velocity: [0.0, 0.0],
    depth: 20.0,
};

/// Makes a white surface in front of the wall that moves right by `speed` pixels per frame.
pub const fn white(speed: f32) -> Surface {
    Surface {
        gray: 1.0,
        velocity: [speed, 0.0],
        depth: 2.0,
    }
}

/// Input of a filter.
pub struct Picture {
    /// Colours, scene-linear.
    pub color: Image,
    /// Motion, in pixels per frame, +x right, +y down.
    pub velocity: Vectors,
    /// Depth, in metres.
    pub depth: Plane,
    /// Exposure, in frames.
    pub exposure: f64,
}

impl Picture {
    /// Makes a picture from the surface at every (column, row); the exposure is one frame.
    pub fn new(width: u32, height: u32, surface: impl Fn(u32, u32) -> Surface) -> Self {
        Self {
            color: Raster::from_fn(width, height, |x, y| [surface(x, y).gray; 3]),
            velocity: Raster::from_fn(width, height, |x, y| surface(x, y).velocity),
            depth: Raster::from_fn(width, height, |x, y| surface(x, y).depth),
            exposure: 1.0,
        }
    }

    /// Makes a picture of one surface everywhere.
    pub fn uniform(width: u32, height: u32, surface: Surface) -> Self {
        Self::new(width, height, |_, _| surface)
    }

    /// Makes a picture of one surface left of the middle, and of another one right of it.
    pub fn halves(width: u32, height: u32, left: Surface, right: Surface) -> Self {
        let side = |x: u32| if x < width / 2 { left } else { right };
        Self::new(width, height, |x, _| side(x))
    }

    /// Gives the pixels of these columns and rows their own greys, from 0 to 1.
    pub fn speckled(mut self, seed: u64, is_speckled: impl Fn(u32, u32) -> bool) -> Self {
        let mut random = Random::new(seed);
        self.color = Raster::from_fn(self.color.width, self.color.height, |x, y| {
            let gray = random.real(0.0, 1.0);
            if is_speckled(x, y) {
                [gray; 3]
            } else {
                *self.color.at(x, y)
            }
        });
        self
    }

    /// Makes the input of a filter with these colours in place of its own, from a still camera.
    pub fn input<'a>(&'a self, color: &'a [&'a Image]) -> Input<'a> {
        Input {
            color,
            velocity: &self.velocity,
            velocity_next: Some(&self.velocity),
            velocity_z: None,
            exclusion: None,
            depth: &self.depth,
            exposure: self.exposure,
            frames_per_second: None,
            frame_index: 0,
            reprojection: Some(Reprojection::STILL),
            camera: None,
        }
    }

    /// Runs a filter with overridden parameters, such as `samples=9`, and returns its output.
    pub fn blur(&self, filter: &str, preset: &str, overrides: &str) -> Image {
        self.run(filter, Some(preset), overrides).1
    }

    /// Runs a filter with its first preset; returns one of its textures.
    pub fn texture(&self, filter: &str, overrides: &str, texture: &str) -> Raster<[f32; 4]> {
        let (blur, _) = self.run(filter, None, overrides);
        blur.read_texture(texture).unwrap()
    }

    fn run(&self, filter: &str, preset: Option<&str>, overrides: &str) -> (Blur<'static>, Image) {
        let size = (self.color.width, self.color.height);
        let mut blur = make_blur(filter, preset, overrides, size);
        let mut outputs = blur.run(&self.input(&[&self.color])).unwrap();
        (blur, outputs.remove(0))
    }
}

/// Prepares a built-in filter with overridden parameters: `samples=9 jitter=none`.
pub fn make_blur(
    filter: &str,
    preset: Option<&str>,
    overrides: &str,
    size: impl Into<Size>,
) -> Blur<'static> {
    let filter = Filter::builtin(filter).unwrap();
    let settings = change_preset(&filter, preset, overrides);
    ready_blur(&filter, &settings, size)
}

/// Makes the settings of a preset, or of the first one, with overrides: `samples=9 jitter=none`.
pub fn change_preset(filter: &Filter, preset: Option<&str>, overrides: &str) -> Settings {
    let mut settings = filter.settings(preset).unwrap();
    for change in overrides.split_whitespace() {
        let (parameter, value) = change.split_once('=').unwrap();
        settings.set(filter, parameter, value).unwrap();
    }
    settings
}

/// Makes the input of a filter from a rendered frame, with these colours in place of its own.
pub fn frame_input<'a>(frame: &'a Frame, color: &'a [&'a Image]) -> Input<'a> {
    Input {
        color,
        velocity: &frame.velocity,
        velocity_next: frame.velocity_next.as_ref().or(Some(&frame.velocity)),
        velocity_z: frame.velocity_z.as_ref(),
        exclusion: None,
        depth: &frame.depth,
        reprojection: Some(frame.reprojection.moved(f64::from(frame.guard_band))),
        camera: frame.camera,
        exposure: frame.exposure,
        frames_per_second: frame.frames_per_second,
        frame_index: 0,
    }
}

/// Returns the mean grey value of a column over all rows, which averages noise.
pub fn column(image: &Image, x: u32) -> f64 {
    let sum: f64 = (0..image.height)
        .map(|y| f64::from(image.at(x, y)[0]))
        .sum();
    sum / f64::from(image.height)
}

/// Returns the length in pixels of the even ramp with the same spread as a blurred edge.
pub fn ramp_length(image: &Image) -> f64 {
    let profile = (0..image.width).map(|x| (f64::from(x), column(image, x)));
    Ramp::of(&profile.collect::<Vec<_>>()).length
}

/// Makes a picture that is black left of the middle and white right of it, all in one motion at one
/// depth.
pub fn moving_edge(width: u32, height: u32, velocity: [f32; 2]) -> Picture {
    let mut ahead = white(0.0);
    ahead.velocity = velocity;
    Picture::halves(width, height, ahead.gray(0.0), ahead)
}

/// Makes a black picture. Its lower half moves fast in front, and its upper half has a white object
/// that moves slower.
pub fn slow_above_fast(slow: f32, fast: f32) -> Picture {
    Picture::new(320, 64, |x, y| match (x, y) {
        (_, 32..) => white(fast).gray(0.0),
        (160.., _) => white(slow),
        _ => BLACK_WALL,
    })
}

/// Measures the light in the rows just above the fast half, at these distances in pixels left of
/// the slow object.
pub fn light_above(output: &Image, distances: std::ops::Range<u32>) -> f32 {
    let pixels = distances.flat_map(|distance| (24..32).map(move |y| (159 - distance, y)));
    pixels.map(|(x, y)| output.at(x, y)[0]).sum()
}

/// Sums the columns.
pub fn light(image: &Image, columns: std::ops::Range<u32>) -> f64 {
    columns.map(|x| column(image, x)).sum()
}
