//! The dilation passes, with every result that rounding allows.

use tests::vector::{Vec2, cross, dot, minus};

use super::paper::{Answer, ROUNDING, Reference, at_most, both};

/// A source pixel, and whether it is valid (otherwise it is the pixel itself).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chosen {
    pub pixel: [i64; 2],
    pub valid: bool,
}

#[rustfmt::skip]
const KERNEL: [[i64; 2]; 9] =
    [[0, 0], [1, 1], [0, 1], [-1, 1], [1, 0], [1, -1], [-1, 0], [-1, -1], [0, -1]];

fn pixel_itself(pixel: [i64; 2]) -> Chosen {
    Chosen {
        pixel,
        valid: false,
    }
}

impl Reference<'_> {
    /// Returns tau, and whether the candidate is valid, for pixel p and source s.
    pub fn fitness(&self, p: Vec2, s: Vec2) -> (f64, Answer) {
        let v = self.velocity(s);
        if v == [0.0, 0.0] {
            return (0.0, Answer::No);
        }
        let u = self.to_path_space([-v[0], -v[1]]);
        let o = self.to_path_space(minus(s, p));
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

    /// Computes the dilated map: per pixel, every source that a correct run may have after the last
    /// pass.
    pub fn dilate(&self) -> Vec<Vec<Chosen>> {
        let [width, height] = self.size;
        let pixels = || (0..height).flat_map(move |y| (0..width).map(move |x| [x, y]));
        let mut map: Vec<Vec<Chosen>> = pixels().map(|pixel| vec![pixel_itself(pixel)]).collect();
        let last = self.paper.passes - 1;
        for iteration in 0..=last {
            let step = (1 << (last - iteration)) * self.paper.step_multiplier;
            map = pixels()
                .map(|pixel| self.outcomes(pixel, step, iteration, &map))
                .collect();
        }
        map
    }

    /// Returns the position of a pixel as a source in an iteration, as an earlier iteration stored
    /// it in the map.
    pub fn place(&self, pixel: [i64; 2], iteration: u32) -> Vec2 {
        match iteration {
            0 => self.uv(pixel),
            _ => self.round_as_stored(self.uv(pixel)),
        }
    }

    fn outcomes(
        &self,
        pixel: [i64; 2],
        step: i64,
        iteration: u32,
        map: &[Vec<Chosen>],
    ) -> Vec<Chosen> {
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
                let s = self.place(source.pixel, iteration);
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
        // Only a neighbour with a single, certainly valid source certainly competes.
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
            outcomes.push(pixel_itself(pixel));
        }
        outcomes
    }
}
