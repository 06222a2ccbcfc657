//! Golan 2024 in 64-bit floats, from its description: UV coordinates, the velocity V that leads back to the previous
//! frame, reverse depth. Plain loops; nothing is shared with the kernels.
//!
//! Where a decision hangs on less than what 32-bit floats resolve, every outcome is kept: a pixel holds the set of
//! sources that a correct run may choose.

use crate::fields::Field;

/// The parameters, by the paper's meaning.
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
    /// Measure paths in pixels instead of UV.
    pub pixel_metric: bool,
    /// Factor on the paper's cut of trails; infinite for none.
    pub reach_factor: f64,
    pub jitter: Jitter,
    pub with_centre: bool,
    /// Read velocity and depth without filtering.
    pub nearest: bool,
    pub frame_index: u32,
}

#[derive(Clone, Copy, PartialEq)]
pub enum Jitter {
    StepScale,
    StartOffset,
    None,
}

type Vec2 = [f64; 2];

/// A source pixel, and whether it is a valid one (else the pixel's own).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chosen {
    pub pixel: [i64; 2],
    pub valid: bool,
}

/// Where a pixel's velocity comes from after the way back, in pixels, and the paper's flag.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    pub position: Vec2,
    pub flag: f64,
}

/// 64 rounding steps of a 32-bit float: no quantity below goes through more.
const ROUNDING: f64 = 64.0 * 6e-8;
/// In pixels: what 32-bit floats make of positions up to 1000 after a product and a sum, with room.
const POSITION: f64 = 2e-4;

/// What 32-bit floats make of the gradient noise: 53 times the rounding of a number up to 32, twice.
const NOISE: f64 = 2e-4;

const KERNEL: [[i64; 2]; 9] = [
    [0, 0],
    [1, 1],
    [0, 1],
    [-1, 1],
    [1, 0],
    [1, -1],
    [-1, 0],
    [-1, -1],
    [0, -1],
];

fn dot(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Vec2, b: Vec2) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn minus(a: Vec2, b: Vec2) -> Vec2 {
    [a[0] - b[0], a[1] - b[1]]
}

#[derive(Clone, Copy, PartialEq)]
enum Answer {
    Yes,
    No,
    Either,
}

/// Whether `value <= limit`, unless they are nearer than `margin`.
fn at_most(value: f64, limit: f64, margin: f64) -> Answer {
    if (value - limit).abs() <= margin {
        Answer::Either
    } else if value < limit {
        Answer::Yes
    } else {
        Answer::No
    }
}

fn both(a: Answer, b: Answer) -> Answer {
    match (a, b) {
        (Answer::No, _) | (_, Answer::No) => Answer::No,
        (Answer::Yes, Answer::Yes) => Answer::Yes,
        _ => Answer::Either,
    }
}

pub struct Reference<'f> {
    pub paper: Paper,
    field: &'f Field,
    size: [i64; 2],
}

impl<'f> Reference<'f> {
    pub fn new(paper: Paper, field: &'f Field) -> Self {
        let size = [field.depth.width.into(), field.depth.height.into()];
        Self { paper, field, size }
    }

    fn uv(&self, pixel: [i64; 2]) -> Vec2 {
        [0, 1].map(|axis| (pixel[axis] as f64 + 0.5) / self.size[axis] as f64)
    }

    fn on_image(&self, pixel: [i64; 2]) -> bool {
        (0..2).all(|axis| (0..self.size[axis]).contains(&pixel[axis]))
    }

    fn clamped<T: Copy>(&self, raster: &frame::Raster<T>, x: i64, y: i64) -> T {
        let x = x.clamp(0, self.size[0] - 1);
        let y = y.clamp(0, self.size[1] - 1);
        *raster.at(x as u32, y as u32)
    }

    /// A linear, clamp-to-edge sampler, or the nearest texel.
    fn sample(&self, uv: Vec2, nearest: bool, texel: impl Fn(i64, i64) -> f64) -> f64 {
        let [x, y] = self.pixels(uv);
        if nearest {
            return texel(x.floor() as i64, y.floor() as i64);
        }
        // A texel's centre is meant where only the last bits of a 64-bit float miss it.
        let snap = |c: f64| {
            if (c - c.round()).abs() < 1e-9 {
                c.round()
            } else {
                c
            }
        };
        let (x, y) = (snap(x - 0.5), snap(y - 0.5));
        let (left, top) = (x.floor() as i64, y.floor() as i64);
        let (right_part, bottom_part) = (x - x.floor(), y - y.floor());
        let mix = |a: f64, b: f64, part: f64| a + part * (b - a);
        let row = |y: i64| mix(texel(left, y), texel(left + 1, y), right_part);
        mix(row(top), row(top + 1), bottom_part)
    }

    /// V: from here to where the surface was one frame before, in UV.
    fn velocity(&self, uv: Vec2) -> Vec2 {
        [0, 1].map(|axis| {
            let motion = self.sample(uv, self.paper.nearest, |x, y| {
                f64::from(self.clamped(&self.field.velocity, x, y)[axis])
            });
            -motion / self.size[axis] as f64
        })
    }

    /// z = near plane / reverse depth, with the demo's near plane of 0.05 m.
    fn depth(&self, uv: Vec2) -> f64 {
        let reverse = self.sample(uv, self.paper.nearest, |x, y| {
            0.05 / f64::from(self.clamped(&self.field.depth, x, y))
        });
        0.05 / reverse
    }

    /// From UV to the space in which paths are measured.
    fn measured(&self, uv: Vec2) -> Vec2 {
        match self.paper.pixel_metric {
            true => self.pixels(uv),
            false => uv,
        }
    }

    /// (tau, whether the candidate is valid) for pixel p and source s.
    fn fitness(&self, p: Vec2, s: Vec2) -> (f64, Answer) {
        let v = self.velocity(s);
        if v == [0.0, 0.0] {
            return (0.0, Answer::No);
        }
        let u = self.measured([-v[0], -v[1]]);
        let o = self.measured(minus(s, p));
        let tau = dot(u, o) / dot(u, u);
        let half = self.paper.m / 2.0;
        if o == [0.0, 0.0] {
            // The pixel itself: a = m/2 exactly, in any precision.
            return (tau, Answer::Yes);
        }
        let sigma = cross(o, u).abs() / dot(u, u);
        let margin = ROUNDING * (self.paper.m + (dot(o, o) / dot(u, u)).sqrt());
        let within = at_most((tau - half).abs(), half, margin);
        let beside = at_most(
            sigma,
            self.paper.perpendicular_tolerance * self.paper.m,
            margin,
        );
        (tau, both(within, beside))
    }

    /// The dilated map: per pixel, every source that a correct run may hold after the last pass.
    pub fn dilated(&self) -> Vec<Vec<Chosen>> {
        let [width, height] = self.size;
        let pixels = || (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]));
        let mut map: Vec<Vec<Chosen>> = pixels()
            .map(|pixel| {
                vec![Chosen {
                    pixel,
                    valid: false,
                }]
            })
            .collect();
        let last = self.paper.passes - 1;
        for iteration in 0..=last {
            let step = (1 << (last - iteration)) * self.paper.step_multiplier;
            map = pixels()
                .map(|pixel| self.outcomes(pixel, step, &map))
                .collect();
        }
        map
    }

    fn outcomes(&self, pixel: [i64; 2], step: i64, map: &[Vec<Chosen>]) -> Vec<Chosen> {
        struct Candidate {
            order: usize,
            pixel: [i64; 2],
            z: f64,
            valid: Answer,
        }
        let first = usize::from(!self.paper.with_centre);
        let mut candidates = Vec::new();
        for (order, offset) in KERNEL.iter().enumerate().skip(first) {
            let neighbour = [pixel[0] + step * offset[0], pixel[1] + step * offset[1]];
            if !self.on_image(neighbour) {
                continue;
            }
            let held = &map[(neighbour[1] * self.size[0] + neighbour[0]) as usize];
            for source in held {
                let s = self.uv(source.pixel);
                candidates.push(Candidate {
                    order,
                    pixel: source.pixel,
                    z: self.depth(s),
                    valid: self.fitness(self.uv(pixel), s).1,
                });
            }
        }
        // Smaller z wins; of equal ones the first in kernel order.
        let beats = |a: &Candidate, b: &Candidate| {
            if a.z == b.z {
                a.order < b.order
            } else {
                a.z < b.z - ROUNDING * b.z
            }
        };
        // Only a neighbour with a single, certainly valid source is sure to compete.
        let certain = |order: usize| {
            let mut of = candidates.iter().filter(|c| c.order == order);
            let only = of.next().filter(|c| c.valid == Answer::Yes);
            only.filter(|_| of.next().is_none())
        };
        let sure: Vec<&Candidate> = (0..9).filter_map(certain).collect();
        let mut outcomes: Vec<Chosen> = Vec::new();
        for candidate in candidates.iter().filter(|c| c.valid != Answer::No) {
            let chosen = Chosen {
                pixel: candidate.pixel,
                valid: true,
            };
            let beaten =
                |other: &&Candidate| other.order != candidate.order && beats(other, candidate);
            if !sure.iter().any(beaten) && !outcomes.contains(&chosen) {
                outcomes.push(chosen);
            }
        }
        if sure.is_empty() {
            outcomes.push(Chosen {
                pixel,
                valid: false,
            });
        }
        outcomes
    }

    /// Rejection and the way back for a pixel whose dilated source is certain: every outcome that a correct run may
    /// store.
    pub fn backtracked(&self, pixel: [i64; 2], chosen: Chosen) -> Vec<Source> {
        let p = self.uv(pixel);
        let own = |flag| Source {
            position: self.pixels(p),
            flag,
        };
        if !chosen.valid {
            return vec![own(0.0)];
        }
        let s = self.uv(chosen.pixel);
        let mut outcomes = Vec::new();
        let (z, z_best) = (self.depth(p), self.depth(s));
        if z != z_best {
            match at_most(z, z_best, ROUNDING * z) {
                Answer::Yes => return vec![own(0.0)],
                Answer::Either => outcomes.push(own(0.0)),
                Answer::No => {}
            }
        }
        let v = self.velocity(s);
        let tau = self.fitness(p, s).0;
        let g = tau.min(self.cut(v));
        for j in -self.paper.probes..=self.paper.probes {
            let k = g * (1.0 + j as f64 / self.paper.probes as f64);
            let q = [p[0] - v[0] * k, p[1] - v[1] * k];
            match self.probe(v, k, q) {
                Answer::No => {}
                answer => {
                    outcomes.push(Source {
                        position: self.pixels(q),
                        flag: 0.0,
                    });
                    if answer == Answer::Yes {
                        return outcomes;
                    }
                }
            }
        }
        outcomes.push(own(1.0));
        outcomes
    }

    /// Whether probe q at k frames is taken.
    fn probe(&self, v: Vec2, k: f64, q: Vec2) -> Answer {
        if k < f64::from(f32::MIN_POSITIVE) {
            return Answer::No;
        }
        let mut answer = at_most(k, self.paper.m + 0.2, ROUNDING);
        for axis in 0..2 {
            let margin = POSITION / self.size[axis] as f64;
            answer = both(answer, at_most(q[axis], 1.0, margin));
            answer = both(answer, at_most(-q[axis], 0.0, margin));
        }
        // The probe may round to either side of a texel's edge.
        let at = |dx: f64, dy: f64| {
            let [width, height] = self.size.map(|side| side as f64);
            let q = [q[0] + dx * POSITION / width, q[1] + dy * POSITION / height];
            let difference = self.difference(v, self.velocity(q));
            // The difference is a sum of ratios that may each be far above 1 before the clamp.
            at_most(
                difference,
                self.paper.match_threshold,
                ROUNDING * (1.0 + difference),
            )
        };
        let corners = [at(-1.0, -1.0), at(1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0)];
        let matches = if corners.iter().all(|corner| *corner == corners[0]) {
            corners[0]
        } else {
            Answer::Either
        };
        both(answer, matches)
    }

    fn difference(&self, v: Vec2, w: Vec2) -> f64 {
        let (v, w) = (self.measured(v), self.measured(w));
        let parallel = dot(minus(v, w), v).abs() / dot(v, v);
        let perpendicular = cross(minus(v, w), v).abs() / dot(v, v);
        let weighted = self.paper.parallel_sensitivity * parallel
            + self.paper.perpendicular_sensitivity * perpendicular;
        weighted.clamp(0.0, 1.0)
    }

    /// R / (|V| m), the time at which a trail is cut.
    fn cut(&self, v: Vec2) -> f64 {
        if self.paper.reach_factor.is_infinite() {
            return f64::INFINITY;
        }
        let largest = (1 << (self.paper.passes - 1)) * self.paper.step_multiplier;
        let side = match self.paper.pixel_metric {
            true => 1,
            false => self.size[0].max(self.size[1]),
        };
        let r = self.paper.reach_factor * largest as f64 / side as f64;
        let v = self.measured(v);
        r / (dot(v, v).sqrt() * self.paper.m)
    }

    fn pixels(&self, uv: Vec2) -> Vec2 {
        [0, 1].map(|axis| uv[axis] * self.size[axis] as f64)
    }

    /// The blur of one pixel over a given map of sources (in pixels), and how far off 32-bit noise may put it; nothing
    /// where a tap lies too near an edge to know which texel it falls on.
    pub fn blurred(
        &self,
        pixel: [i64; 2],
        sources: &dyn Fn([i64; 2]) -> Vec2,
    ) -> Option<([f64; 3], f64)> {
        let p = self.uv(pixel);
        let source_uv = |pixel: [i64; 2]| {
            let position = sources(pixel);
            [0, 1].map(|axis| position[axis] / self.size[axis] as f64)
        };
        let own = source_uv(pixel);
        let v = self.velocity(own).map(|component| -component);
        if v == [0.0, 0.0] {
            return Some((self.color(p), 0.0));
        }
        let length = self.paper.m.min(self.cut(v));
        let n = f64::from(self.paper.samples);
        let start_offset = self.paper.jitter == Jitter::StartOffset;
        let (noise, noise_error) = match self.paper.jitter {
            Jitter::None => (0.5, 0.0),
            _ => (self.noise(pixel)?, NOISE),
        };
        let [trail_x, trail_y] = self.pixels(v);
        let misplaced = POSITION + noise_error * length * trail_x.hypot(trail_y);
        let (mut sum, mut weights) = match start_offset {
            true => ([0.0; 3], 0.0),
            false => (self.color(p), 1.0),
        };
        for i in u32::from(!start_offset)..self.paper.samples {
            let even = f64::from(i) / (n - 1.0).max(1.0);
            let along = match self.paper.jitter {
                Jitter::StepScale => even * (1.0 + (noise - 0.5)),
                Jitter::StartOffset => (f64::from(i) + noise) / n,
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
            let weight = self.weight(own, other)?;
            let tap = self.color(x);
            sum = [0, 1, 2].map(|c| sum[c] + tap[c] * weight);
            weights += weight;
        }
        (weights > 0.0).then(|| (sum.map(|component| component / weights), misplaced))
    }

    fn color(&self, uv: Vec2) -> [f64; 3] {
        [0, 1, 2].map(|c| {
            self.sample(uv, false, |x, y| {
                f64::from(self.clamped(&self.field.color, x, y)[c])
            })
        })
    }

    /// w = 1 - fg * D^0.1, or nothing where D is rounding noise that the root would blow up.
    fn weight(&self, own: Vec2, other: Vec2) -> Option<f64> {
        let v = self.measured(self.velocity(own));
        let w = self.measured(self.velocity(other));
        let d = dot(minus(v, w), v) / dot(v, v);
        if d != 0.0 && d.abs() < 1e-3 {
            return None;
        }
        let ahead = (self.depth(other) - self.depth(own)) / self.paper.foreground_extent;
        let fg = (1.0 - ahead).clamp(0.0, 1.0);
        Some(1.0 - fg * d.clamp(0.0, 1.0).powf(self.paper.mismatch_exponent))
    }

    /// Interleaved gradient noise on a cycle of 8 frames; nothing where it may wrap around.
    fn noise(&self, pixel: [i64; 2]) -> Option<f64> {
        let frame = f64::from(self.paper.frame_index % 8);
        let x = pixel[0] as f64 + frame * 47.0 * 0.695;
        let y = pixel[1] as f64 + frame * 17.0 * 0.695;
        let inner = (0.067_110_56 * x + 0.005_837_15 * y).fract();
        let noise = (52.982_918_9 * inner).fract();
        let clear = |value: f64, margin: f64| value > margin && value < 1.0 - margin;
        (clear(inner, NOISE / 50.0) && clear(noise, NOISE)).then_some(noise)
    }
}
