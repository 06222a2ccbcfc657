//! The demo's blur with a given map of sources.

use tests::vector::{Vec2, dot, minus};

use super::paper::{Jitter, POSITION, ROUNDING, Reference};
use crate::reference::{noise, read_clamped};

/// Error of the gradient noise in 32-bit floats: 53 times the rounding of a number up to 32, twice.
const NOISE: f64 = 2e-4;

struct Share {
    value: f64,
    error: f64,
}

impl Reference<'_> {
    /// Blurs one pixel with a given map of sources, in pixels. Returns the colour and its error
    /// from 32-bit noise; none if a tap is too near an edge to determine its texel.
    pub fn blur(
        &self,
        pixel: [i64; 2],
        sources: &dyn Fn([i64; 2]) -> Vec2,
    ) -> Option<([f64; 3], f64)> {
        let p = self.uv(pixel);
        let source_uv = |pixel: [i64; 2]| {
            let position = sources(pixel);
            [0, 1].map(|axis| position[axis] / self.size[axis] as f64)
        };
        let source = source_uv(pixel);
        let v = self.velocity(source).map(|component| -component);
        if v == [0.0, 0.0] {
            return Some((self.color(p), 0.0));
        }
        let length = self.paper.m.min(self.cut(v, self.paper.reach_factor));
        let n = f64::from(self.paper.samples);
        let start_offset = self.paper.jitter == Jitter::StartOffset;
        let (noise, noise_error) = match self.paper.jitter {
            Jitter::None => (0.5, 0.0),
            _ => (noise(pixel, 0.0, NOISE)?, NOISE),
        };
        let [trail_x, trail_y] = self.pixels(v);
        let misplaced = POSITION + noise_error * length * trail_x.hypot(trail_y);
        // A share moves only the read of colours, not the tap.
        let mut misread = misplaced;
        let (mut sum, mut weights) = if start_offset {
            ([0.0; 3], 0.0)
        } else {
            (self.color(p), 1.0)
        };
        for i in u32::from(!start_offset)..self.paper.samples {
            let even = f64::from(i) / (n - 1.0).max(1.0);
            let along = match self.paper.jitter {
                Jitter::StepScale => even * (1.0 + (noise - 0.5)),
                Jitter::StartOffset => (f64::from(i) + noise) / n,
                Jitter::StepOffset => even + (noise - 1.0) / (n - 1.0).max(1.0),
                Jitter::None => even,
            };
            let x = [0, 1].map(|axis| p[axis] + along * length * v[axis]);
            let position = self.pixels(x);
            if position.iter().any(|c| (c - c.round()).abs() < misplaced) {
                return None;
            }
            if x.iter().any(|c| !(0.0..=1.0).contains(c)) {
                break;
            }
            let other = source_uv(position.map(|c| c.floor() as i64));
            let weight = self.weight(source, other)?;
            let tap = match self.paper.behind_extent {
                None => self.color(x),
                Some(extent) => {
                    let share = self.share(p, source, x, extent);
                    misread += share.error * length * trail_x.hypot(trail_y);
                    let place = [0, 1].map(|axis| p[axis] + share.value * (x[axis] - p[axis]));
                    self.color(place)
                }
            };
            sum = [0, 1, 2].map(|c| sum[c] + tap[c] * weight);
            weights += weight;
        }
        (weights > 0.0).then(|| (sum.map(|component| component / weights), misread))
    }

    fn color(&self, uv: Vec2) -> [f64; 3] {
        [0, 1, 2].map(|c| {
            self.sample(uv, false, |x, y| {
                f64::from(read_clamped(&self.field.color, x, y)[c])
            })
        })
    }

    /// Returns how far from p towards x the colour is taken: max(nb, nf), and the error of 32-bit
    /// floats.
    fn share(&self, p: Vec2, source_place: Vec2, x: Vec2, extent: f64) -> Share {
        let [source, here, tap] = [source_place, p, x].map(|uv| self.depth(uv));
        let [source_reverse, here_reverse] = [source, here].map(|depth| 0.05 / depth);
        let nb = 1.0 - (source_reverse - here_reverse) / extent;
        let nf = 1.0 - ((tap - 0.1) - source) / 0.1;
        let [nb, nf] = [nb, nf].map(|part| part.clamp(0.0, 1.0));
        let between = |part: f64| part > 0.0 && part < 1.0;
        let error = if between(nb) && between(nf) {
            ROUNDING * (source_reverse / extent + (tap + source) / 0.1)
        } else if between(nb) {
            ROUNDING * source_reverse / extent
        } else if between(nf) && nb == 0.0 {
            ROUNDING * (tap + source) / 0.1
        } else {
            0.0
        };
        Share {
            value: nb.max(nf),
            error,
        }
    }

    /// Computes w = 1 - fg * D^0.1; none if the root would amplify rounding noise in D and the
    /// weight matters.
    fn weight(&self, source: Vec2, other: Vec2) -> Option<f64> {
        let v = self.to_path_space(self.velocity(source));
        let w = self.to_path_space(self.velocity(other));
        let d = dot(minus(v, w), v) / dot(v, v);
        let ahead = (self.depth(other) - self.depth(source)) / self.paper.foreground_extent;
        let fg = (1.0 - ahead).clamp(0.0, 1.0);
        // Motion is known to 1e-4 of itself.
        if fg > 0.0 && d != 0.0 && d > -1e-4 && d < 1e-3 {
            return None;
        }
        Some(1.0 - fg * d.clamp(0.0, 1.0).powf(self.paper.mismatch_exponent))
    }
}
