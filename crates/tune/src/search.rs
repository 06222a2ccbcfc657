//! Search for the next point of the unit cube to try.

use std::cell::{Cell, RefCell};

use cmaes::{CMAESOptions, DVector};

/// Standard deviation of the first generation, in lengths of the cube.
const STEP: f64 = 0.2;
/// Points of the initial design per axis, added to the presets.
const DESIGN_PER_AXIS: usize = 2;
/// Difference between losses that counts as none: less than any truth's noise.
const LOSS_STEP: f64 = 1e-5;
/// Difference between coordinates that counts as none.
const COORDINATE_STEP: f64 = 1e-3;

/// Ask-and-tell search: the presets, then a Sobol design that fills the cube, then CMA-ES from the
/// best of them; once that has settled, again from another point with twice the population (Auger
/// and Hansen, "A Restart CMA Evolution Strategy with Increasing Population Size", CEC 2005).
#[derive(Clone, Debug)]
pub struct Search {
    /// Seed of all randomness.
    pub seed: u64,
    /// Initial points.
    pub design: Vec<Vec<f64>>,
    /// Number of coordinates of a point.
    pub axes: usize,
}

impl Search {
    /// Makes a search over `axes` coordinates that begins with the presets' points.
    pub fn new(presets: Vec<Vec<f64>>, axes: usize, seed: u64) -> Self {
        assert!(axes > 0, "a search has at least one axis");
        let mut design = presets;
        let filling =
            (0..(DESIGN_PER_AXIS * axes) as u32).map(|index| sobol_point(index, axes, seed));
        design.extend(filling);
        Self { seed, design, axes }
    }

    /// Returns the next point, given the losses of the points so far. It depends on nothing else:
    /// the whole search is repeated, which takes some milliseconds after hundreds of losses.
    pub fn ask(&self, losses: &[f64]) -> Vec<f64> {
        if let Some(point) = self.design.get(losses.len()) {
            return point.clone();
        }
        let (designed, searched) = losses.split_at(self.design.len());
        let best = (0..designed.len())
            .min_by(|a, b| designed[*a].total_cmp(&designed[*b]))
            .expect("a design has points");
        let mut mean = self.design[best].clone();
        let used = Cell::new(0);
        for restart in 0.. {
            if let Some(point) = self.run_cma_es(mean, restart, searched, &used) {
                return point;
            }
            let beyond = self.design.len() as u32 + restart;
            mean = sobol_point(beyond, self.axes, self.seed);
        }
        unreachable!("a run that asks for nothing new has used up losses")
    }

    /// Runs CMA-ES over the losses from `used` on, and returns the first point without a loss; none
    /// if it settles before.
    fn run_cma_es(
        &self,
        mean: Vec<f64>,
        restart: u32,
        losses: &[f64],
        used: &Cell<usize>,
    ) -> Option<Vec<f64>> {
        let asked = RefCell::new(None);
        let objective = |point: &DVector<f64>| match losses.get(used.get()) {
            Some(loss) => {
                used.set(used.get() + 1);
                *loss
            }
            None => {
                let mut asked = asked.borrow_mut();
                asked.get_or_insert_with(|| {
                    point.iter().map(|coordinate| mirror(*coordinate)).collect()
                });
                // Never used: this run ends before it could continue with it.
                0.0
            }
        };
        let options = CMAESOptions::new(mean, STEP);
        let population = options.population_size << restart.min(5);
        let mut search = options
            .population_size(population)
            .seed(self.seed.wrapping_add(u64::from(restart)))
            .tol_fun(LOSS_STEP)
            .tol_fun_hist(LOSS_STEP)
            .tol_x(COORDINATE_STEP)
            .build(objective)
            .expect("a search has axes and a population");
        loop {
            let settled = search.next().is_some();
            if asked.borrow().is_some() {
                return asked.take();
            }
            if settled {
                return None;
            }
        }
    }
}

/// Returns point `index` of an Owen-scrambled Sobol sequence.
pub fn sobol_point(index: u32, axes: usize, seed: u64) -> Vec<f64> {
    let seed = (seed ^ (seed >> 32)) as u32;
    (0..axes as u32)
        .map(|axis| f64::from(sobol_burley::sample(index, axis, seed)))
        .collect()
}

/// Reflects a coordinate at the sides of the cube until it is inside.
fn mirror(coordinate: f64) -> f64 {
    let folded = coordinate.rem_euclid(2.0);
    if folded > 1.0 { 2.0 - folded } else { folded }
}
