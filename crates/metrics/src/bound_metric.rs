//! Metrics that bounds may name: those of single frames and those of sequences.

use std::fmt;
use std::str::FromStr;

use crate::{Ideal, Metric, Row, SequenceMetric};

/// A metric of single frames or of sequences. No two share a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BoundMetric {
    /// A metric of a single frame: `flip_moving`.
    Frame(Metric),
    /// A metric of a sequence: `flicker`.
    Sequence(SequenceMetric),
}

impl BoundMetric {
    /// Returns the row of the metric.
    pub fn row(self) -> Row {
        match self {
            Self::Frame(metric) => metric.row(),
            Self::Sequence(metric) => metric.row(),
        }
    }

    /// Returns the word used in bounds, tables and files.
    pub fn name(self) -> String {
        match self {
            Self::Frame(metric) => metric.name(),
            Self::Sequence(metric) => metric.row().name.to_owned(),
        }
    }

    /// Returns the unit, empty for a pure number.
    pub fn unit(self) -> &'static str {
        self.row().unit
    }

    /// Returns its ideal value.
    pub fn ideal(self) -> Ideal {
        self.row().ideal
    }

    /// Explains the metric in one line.
    pub fn meaning(self) -> String {
        match self {
            Self::Frame(metric) => metric.meaning(),
            Self::Sequence(metric) => metric.row().meaning.to_owned(),
        }
    }

    /// Computes the strictest bound that a truth with this noise floor can carry: three floors from perfect.
    pub fn strictest_bound(self, floor: f64) -> f64 {
        match self {
            Self::Frame(metric) => metric.strictest_bound(floor),
            Self::Sequence(metric) => metric.strictest_bound(floor),
        }
    }
}

impl fmt::Display for BoundMetric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.name())
    }
}

impl FromStr for BoundMetric {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut of_sequences = SequenceMetric::ALL.into_iter();
        if let Some(metric) = of_sequences.find(|metric| metric.row().name == text) {
            return Ok(Self::Sequence(metric));
        }
        Metric::from_str(text).map(Self::Frame).map_err(|reason| {
            let names = SequenceMetric::ALL.map(|metric| metric.row().name);
            format!("{reason}; of sequences: {}", names.join(", "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_stands_for_one_metric() {
        let frames = Metric::all().into_iter().map(BoundMetric::Frame);
        let sequences = SequenceMetric::ALL.map(BoundMetric::Sequence);
        for metric in frames.chain(sequences) {
            assert_eq!(metric.name().parse(), Ok(metric));
        }
    }

    #[test]
    fn a_truth_carries_no_limit_within_three_floors() {
        let strictest = |metric: SequenceMetric, floor: f64| {
            BoundMetric::Sequence(metric).strictest_bound(floor)
        };
        assert_eq!(strictest(SequenceMetric::Flicker, 0.5), 1.5);
        // Half a JOD below the perfect 10.
        assert_eq!(strictest(SequenceMetric::Jod, 9.5), 8.5);
    }
}
