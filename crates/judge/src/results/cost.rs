//! Costs of filters, as results keep them.

use serde::{Deserialize, Serialize};
use suite::{Bench, Error, Spread};

use crate::results::{Results, rounded};

/// Time of a filter preset, divided by that of [`suite::BASELINE`] in the same round of a bench.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ResultCost {
    /// Median of all rounds.
    pub median: f64,
    /// Lower quartile.
    pub low: f64,
    /// Upper quartile.
    pub high: f64,
}

impl ResultCost {
    fn of(ratio: &Spread) -> Self {
        let [median, low, high] =
            [ratio.median, ratio.lower_quartile, ratio.upper_quartile].map(rounded);
        Self { median, low, high }
    }
}

impl Results {
    /// Takes the costs of all filters that have scores here from a bench.
    ///
    /// # Errors
    /// The bench was made with pictures of another size, or on another adapter.
    pub fn add_costs(&mut self, bench: &Bench) -> Result<(), Error> {
        let name = |size: [u32; 2], adapter: Option<&str>| {
            let adapter = adapter.unwrap_or("no adapter");
            format!("{}x{} on {adapter}", size[0], size[1])
        };
        let own = name(self.size, self.adapter.as_deref());
        let other = name([bench.width, bench.height], Some(&bench.adapter.name));
        if own != other {
            return Err(Error::Usage(format!(
                "the bench timed {other}, and the results are of {own}; allowed: a bench of the same size on the same adapter"
            )));
        }
        for cost in &bench.cases {
            let name = format!("{}:{}", cost.filter, cost.preset);
            if self.scores.iter().any(|own| own.name == name) {
                self.costs.insert(name, ResultCost::of(&cost.ratio));
            }
        }
        Ok(())
    }
}
