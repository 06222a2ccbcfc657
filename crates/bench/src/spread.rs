//! Spread of repeated measurements.

use serde::{Deserialize, Serialize};
use statrs::statistics::{Data, OrderStatistics};

/// Median and quartiles: a quarter of the rounds is below the lower one, and a quarter above the
/// upper one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Half of the rounds took longer, half took less.
    pub median: f64,
    /// A quarter of the rounds took less.
    pub lower_quartile: f64,
    /// A quarter of the rounds took longer.
    pub upper_quartile: f64,
}

impl Spread {
    /// Computes median and quartiles of one value per round. Panics without rounds.
    pub fn of(rounds: impl IntoIterator<Item = f64>) -> Self {
        let values: Vec<f64> = rounds.into_iter().collect();
        assert!(!values.is_empty(), "a spread is of at least one round");
        let mut values = Data::new(values);
        Self {
            median: values.median(),
            lower_quartile: values.lower_quartile(),
            upper_quartile: values.upper_quartile(),
        }
    }
}
