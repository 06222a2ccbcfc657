//! Golan 2024 in 64-bit floats, from its description: UV coordinates, the velocity V that points to
//! the previous frame, reverse depth. The code is plain loops and shares nothing with the kernels.
//!
//! If a decision is too close for 32-bit floats, every result is kept: a pixel has all sources that
//! a correct run may choose.

use tests::vector::{Vec2, dot};

use crate::fields::Field;
use crate::reference::{read_clamped, sample_linear};

/// Parameters, with the paper's meaning.
pub struct Paper {
    /// The paper's motion_blur_intensity, in frames.
    pub m: f64,
    pub passes: u32,
    pub step_multiplier: i64,
    pub perpendicular_tolerance: f64,
    pub probes: i64,
    pub match_threshold: f64,
    pub parallel_sensitivity: f64,
    pub perpendicular_sensitivity: f64,
    pub foreground_extent: f64,
    pub mismatch_exponent: f64,
    pub samples: u32,
    /// True if paths are measured in pixels instead of UV.
    pub pixel_metric: bool,
    /// Factor on the paper's cut of trails in the gather; infinite for no cut, on the way back too.
    pub reach_factor: f64,
    pub jitter: Jitter,
    /// Difference of reverse depth, in the demo of two days later, over which a pixel changes from
    /// level with its source to behind it. None if taps are weighted.
    pub behind_extent: Option<f64>,
    /// Difference of reverse depth, two days later, below which a probe matches; three matches end
    /// the way back. None if the first match of velocities ends it.
    pub third_match: Option<f64>,
    /// True if the map has 16 bits, as two days later.
    pub half_map: bool,
    pub with_centre: bool,
    /// True if velocity and depth are read without filtering.
    pub nearest: bool,
}

#[derive(Clone, Copy, PartialEq)]
pub enum Jitter {
    StepScale,
    StartOffset,
    StepOffset,
    None,
}

/// 64 rounding steps of a 32-bit float: no quantity below goes through more.
pub const ROUNDING: f64 = 64.0 * 6e-8;
/// Error of 32-bit floats in positions of up to 1000 pixels after a product and a sum, in pixels,
/// with room.
pub const POSITION: f64 = 2e-4;

#[derive(Clone, Copy, PartialEq)]
pub enum Answer {
    Yes,
    No,
    Either,
}

/// Returns whether `value <= limit`, or none if they are closer than `margin`.
pub fn at_most(value: f64, limit: f64, margin: f64) -> Answer {
    if (value - limit).abs() <= margin {
        Answer::Either
    } else if value < limit {
        Answer::Yes
    } else {
        Answer::No
    }
}

pub fn both(a: Answer, b: Answer) -> Answer {
    match (a, b) {
        (Answer::No, _) | (_, Answer::No) => Answer::No,
        (Answer::Yes, Answer::Yes) => Answer::Yes,
        _ => Answer::Either,
    }
}

pub struct Reference<'f> {
    pub paper: Paper,
    pub field: &'f Field,
    pub size: [i64; 2],
}

impl<'f> Reference<'f> {
    pub fn new(paper: Paper, field: &'f Field) -> Self {
        let size = [field.depth.width.into(), field.depth.height.into()];
        Self { paper, field, size }
    }

    pub fn uv(&self, pixel: [i64; 2]) -> Vec2 {
        [0, 1].map(|axis| (pixel[axis] as f64 + 0.5) / self.size[axis] as f64)
    }

    pub fn on_image(&self, pixel: [i64; 2]) -> bool {
        (0..2).all(|axis| (0..self.size[axis]).contains(&pixel[axis]))
    }

    /// Samples like a linear, clamp-to-edge sampler, or reads the nearest texel.
    pub fn sample(&self, uv: Vec2, nearest: bool, texel: impl Fn(i64, i64) -> f64) -> f64 {
        let place = self.pixels(uv);
        if nearest {
            texel(place[0].floor() as i64, place[1].floor() as i64)
        } else {
            sample_linear(place, texel)
        }
    }

    /// Returns V: the vector from here to the surface's position in the previous frame, in UV.
    pub fn velocity(&self, uv: Vec2) -> Vec2 {
        [0, 1].map(|axis| {
            let motion = self.sample(uv, self.paper.nearest, |x, y| {
                f64::from(read_clamped(&self.field.velocity, x, y)[axis])
            });
            -motion / self.size[axis] as f64
        })
    }

    /// Computes z = near plane / reverse depth, with the demo's near plane of 0.05 m.
    pub fn depth(&self, uv: Vec2) -> f64 {
        let reverse = self.sample(uv, self.paper.nearest, |x, y| {
            0.05 / f64::from(read_clamped(&self.field.depth, x, y))
        });
        0.05 / reverse
    }

    /// Converts UV to the space in which paths are measured.
    pub fn to_path_space(&self, uv: Vec2) -> Vec2 {
        if self.paper.pixel_metric {
            self.pixels(uv)
        } else {
            uv
        }
    }

    /// Rounds a UV like the map: 11 binary digits, towards zero.
    pub fn round_as_stored(&self, uv: Vec2) -> Vec2 {
        if self.paper.half_map {
            uv.map(|c| f64::from_bits(c.to_bits() & !((1 << 42) - 1)))
        } else {
            uv
        }
    }

    /// Computes `factor` R / (|V| m), the time at which a trail is cut.
    pub fn cut(&self, v: Vec2, factor: f64) -> f64 {
        if factor.is_infinite() {
            return f64::INFINITY;
        }
        let largest = (1 << (self.paper.passes - 1)) * self.paper.step_multiplier;
        let side = if self.paper.pixel_metric {
            1
        } else {
            self.size[0].max(self.size[1])
        };
        let r = factor * largest as f64 / side as f64;
        let v = self.to_path_space(v);
        r / (dot(v, v).sqrt() * self.paper.m)
    }

    pub fn pixels(&self, uv: Vec2) -> Vec2 {
        [0, 1].map(|axis| uv[axis] * self.size[axis] as f64)
    }
}
