//! Search: the point of the unit cube to try next.

use std::cell::{Cell, RefCell};

use cmaes::{CMAESOptions, DVector};

/// Standard deviation of the first generation, in lengths of the cube.
const STEP: f64 = 0.2;
/// Points of the design per axis, beside the presets.
const DESIGN_PER_AXIS: usize = 2;
/// Losses are told apart down to this: less is below what any truth's noise can tell.
const LOSS_STEP: f64 = 1e-5;
/// Coordinates are told apart down to this.
const COORDINATE_STEP: f64 = 1e-3;

/// Ask and tell: the presets, then a Sobol design that fills the cube, then CMA-ES from the best of them; where that has
/// settled, again from another place with twice the population (Auger and Hansen, "A Restart CMA Evolution Strategy with
/// Increasing Population Size", CEC 2005).
#[derive(Clone, Debug)]
pub struct Search {
    /// Of the randomness.
    pub seed: u64,
    /// The points to begin with.
    pub design: Vec<Vec<f64>>,
    /// Coordinates of a point.
    pub axes: usize,
}

impl Search {
    /// A search over `axes` coordinates that begins with the presets' points.
    pub fn new(presets: Vec<Vec<f64>>, axes: usize, seed: u64) -> Self {
        assert!(axes > 0, "a search has at least one axis");
        let mut design = presets;
        let sobol = (0..(DESIGN_PER_AXIS * axes) as u32).map(|index| sobol(index, axes, seed));
        design.extend(sobol);
        Self { seed, design, axes }
    }

    /// The point that follows when the points so far had the losses `told`: the same for the same losses, since the whole
    /// search is gone through again. That takes some milliseconds after hundreds of losses.
    pub fn ask(&self, told: &[f64]) -> Vec<f64> {
        if let Some(point) = self.design.get(told.len()) {
            return point.clone();
        }
        let (designed, told) = told.split_at(self.design.len());
        let best = (0..designed.len())
            .min_by(|a, b| designed[*a].total_cmp(&designed[*b]))
            .expect("a design has points");
        let mut mean = self.design[best].clone();
        let used = Cell::new(0);
        for restart in 0.. {
            if let Some(point) = self.climb(mean, restart, told, &used) {
                return point;
            }
            let beyond = self.design.len() as u32 + restart;
            mean = sobol(beyond, self.axes, self.seed);
        }
        unreachable!("a climb that asks for nothing new has used up losses")
    }

    /// One run of CMA-ES over the losses from `used` on; none where they end it.
    fn climb(
        &self,
        mean: Vec<f64>,
        restart: u32,
        told: &[f64],
        used: &Cell<usize>,
    ) -> Option<Vec<f64>> {
        let asked = RefCell::new(None);
        let objective = |point: &DVector<f64>| match told.get(used.get()) {
            Some(loss) => {
                used.set(used.get() + 1);
                *loss
            }
            None => {
                let mut asked = asked.borrow_mut();
                asked.get_or_insert_with(|| point.iter().map(|it| mirrored(*it)).collect());
                // Never used: the search is left before it could go on with it.
                0.0
            }
        };
        let options = CMAESOptions::new(mean, STEP);
        let population = options.population_size << restart.min(5);
        let mut climb = options
            .population_size(population)
            .seed(self.seed.wrapping_add(u64::from(restart)))
            .tol_fun(LOSS_STEP)
            .tol_fun_hist(LOSS_STEP)
            .tol_x(COORDINATE_STEP)
            .build(objective)
            .expect("a search has axes and a population");
        loop {
            let settled = climb.next().is_some();
            if asked.borrow().is_some() {
                return asked.take();
            }
            if settled {
                return None;
            }
        }
    }
}

/// Point `index` of an Owen-scrambled Sobol sequence.
pub fn sobol(index: u32, axes: usize, seed: u64) -> Vec<f64> {
    let seed = (seed ^ (seed >> 32)) as u32;
    (0..axes as u32)
        .map(|axis| f64::from(sobol_burley::sample(index, axis, seed)))
        .collect()
}

/// A coordinate outside of the cube, reflected at its sides until it lies inside.
fn mirrored(coordinate: f64) -> f64 {
    let folded = coordinate.rem_euclid(2.0);
    if folded > 1.0 { 2.0 - folded } else { folded }
}
