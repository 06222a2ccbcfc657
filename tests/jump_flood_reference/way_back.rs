//! Rejection and back-tracking.

use crate::flood::Chosen;
use crate::paper::{Answer, POSITION, ROUNDING, Reference, Vec2, at_most, both, cross, dot, minus};

/// Where a pixel's velocity comes from after the way back, in pixels, and the paper's flag.
#[derive(Clone, Copy, Debug)]
pub struct Source {
    pub position: Vec2,
    pub flag: f64,
}

impl Reference<'_> {
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
        for (position, side) in q.into_iter().zip(self.size) {
            let margin = POSITION / side as f64;
            answer = both(answer, at_most(position, 1.0, margin));
            answer = both(answer, at_most(-position, 0.0, margin));
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
}
