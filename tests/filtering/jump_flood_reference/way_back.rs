//! Rejection and back-tracking.

use tests::vector::{Vec2, cross, dot, minus};

use super::flood::Chosen;
use super::paper::{Answer, POSITION, ROUNDING, Reference, at_most, both};

/// Source position of a pixel's velocity after the way back, in pixels, and the paper's flag.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    pub position: Vec2,
    pub flag: f64,
}

/// Error of 32-bit floats in positions of up to 100 pixels after a product and a sum, in pixels.
const STORED: f64 = 3e-5;

/// A row of matching probes that a correct run may be in.
#[derive(Clone, Copy, PartialEq)]
struct Row {
    hits: usize,
    /// UV of the last of them.
    last: Vec2,
}

impl Reference<'_> {
    /// Applies rejection and the way back to a pixel with a certain dilated source. Returns every
    /// result that a correct run may store.
    pub fn backtrack(&self, pixel: [i64; 2], chosen: Chosen) -> Vec<Source> {
        let p = self.uv(pixel);
        let source_here = |flag| Source {
            position: self.pixels(self.round_as_stored(p)),
            flag,
        };
        if !chosen.valid {
            return vec![source_here(0.0)];
        }
        let s = self.place(chosen.pixel, self.paper.passes - 1);
        let mut outcomes = Vec::new();
        let (z, z_best) = (self.depth(p), self.depth(s));
        if z != z_best {
            match at_most(z, z_best, ROUNDING * z) {
                Answer::Yes => return vec![source_here(0.0)],
                Answer::Either => outcomes.push(source_here(0.0)),
                Answer::No => {}
            }
        }
        let v = self.velocity(s);
        let tau = self.fitness(p, s).0;
        // Only the gather has the doubled reach.
        let factor = if self.paper.reach_factor.is_infinite() {
            f64::INFINITY
        } else {
            1.0
        };
        let g = tau.min(self.cut(v, factor));
        let enough = match self.paper.third_match {
            Some(_) => 3,
            None => 1,
        };
        let mut rows = vec![Row { hits: 0, last: p }];
        for j in -self.paper.probes..=self.paper.probes {
            let k = g * (1.0 + j as f64 / self.paper.probes as f64);
            let q = [p[0] - v[0] * k, p[1] - v[1] * k];
            let looks = self.looks(k, q);
            let matches = self.matches(v, z_best, q);
            let mut next: Vec<Row> = Vec::new();
            for row in rows {
                let mut goes_on = |row: Row| {
                    if !next.contains(&row) {
                        next.push(row);
                    }
                };
                if looks != Answer::Yes {
                    goes_on(row);
                }
                if looks == Answer::No {
                    continue;
                }
                if matches != Answer::No && row.hits + 1 == enough {
                    outcomes.extend(self.ends(q));
                } else if matches != Answer::No {
                    goes_on(Row {
                        hits: row.hits + 1,
                        last: q,
                    });
                }
                if matches != Answer::Yes && row.hits > 0 {
                    outcomes.extend(self.ends(row.last));
                } else if matches != Answer::Yes {
                    goes_on(row);
                }
            }
            rows = next;
        }
        // Rows that the last probe cuts short do not count.
        if !rows.is_empty() {
            outcomes.push(source_here(1.0));
        }
        outcomes
    }

    /// Returns the possible map values for a UV that 32-bit floats round to either side.
    fn ends(&self, uv: Vec2) -> Vec<Source> {
        let mut sources: Vec<Source> = Vec::new();
        for (right, down) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
            let [width, height] = self.size.map(|side| side as f64);
            let near = if self.paper.half_map {
                [
                    uv[0] + right * STORED / width,
                    uv[1] + down * STORED / height,
                ]
            } else {
                uv
            };
            let position = self.pixels(self.round_as_stored(near));
            if sources.iter().all(|source| source.position != position) {
                sources.push(Source {
                    position,
                    flag: 0.0,
                });
            }
        }
        sources
    }

    /// Returns whether probe q at k frames is read.
    fn looks(&self, k: f64, q: Vec2) -> Answer {
        if k < f64::from(f32::MIN_POSITIVE) {
            return Answer::No;
        }
        let mut answer = at_most(k, self.paper.m + 0.2, ROUNDING);
        for (position, side) in q.into_iter().zip(self.size) {
            let margin = POSITION / side as f64;
            answer = both(answer, at_most(position, 1.0, margin));
            answer = both(answer, at_most(-position, 0.0, margin));
        }
        answer
    }

    /// Returns whether probe q matches a source of velocity v and distance z.
    fn matches(&self, v: Vec2, z: f64, q: Vec2) -> Answer {
        // The probe may round to either side of a texel's edge.
        let at = |dx: f64, dy: f64| {
            let [width, height] = self.size.map(|side| side as f64);
            let q = [q[0] + dx * POSITION / width, q[1] + dy * POSITION / height];
            let difference = self.difference(v, self.velocity(q));
            // The difference is a sum of ratios, and each may be far above 1 before the clamp.
            let alike = at_most(
                difference,
                self.paper.match_threshold,
                ROUNDING * (1.0 + difference),
            );
            match self.paper.third_match {
                Some(threshold) => {
                    let reverse = [self.depth(q), z].map(|depth| 0.05 / depth);
                    let apart = (reverse[0] - reverse[1]).abs();
                    let level = at_most(apart, threshold, ROUNDING * (reverse[0] + reverse[1]));
                    both(alike, level)
                }
                None => alike,
            }
        };
        let corners = [at(-1.0, -1.0), at(1.0, -1.0), at(-1.0, 1.0), at(1.0, 1.0)];
        if corners.iter().all(|corner| *corner == corners[0]) {
            corners[0]
        } else {
            Answer::Either
        }
    }

    fn difference(&self, v: Vec2, w: Vec2) -> f64 {
        let (v, w) = (self.to_path_space(v), self.to_path_space(w));
        let parallel = dot(minus(v, w), v).abs() / dot(v, v);
        let perpendicular = cross(minus(v, w), v).abs() / dot(v, v);
        let weighted = self.paper.parallel_sensitivity * parallel
            + self.paper.perpendicular_sensitivity * perpendicular;
        weighted.clamp(0.0, 1.0)
    }
}
