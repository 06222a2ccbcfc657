//! Baseline: accepted scores in a reviewed file.

mod accept;
mod comparison;
mod loss;

use std::collections::BTreeMap;
use std::path::Path;

use filters::AdapterDescription;
use frame::Alignment;
use frame::write_atomically;
use metrics::Metric;
use scene::SceneId;
use serde::{Deserialize, Serialize};

use measure::{Error, read_text};

pub use accept::{Acceptance, accept_scores};
pub use comparison::{BaselineComparison, ComparisonKind, DecidedBy, compare_with_baseline};

/// Version of the layout of a baseline.
const BASELINE_FORMAT: u32 = 1;

/// Accepted scores and their origin. The file has one number per line under sorted keys.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Baseline {
    /// Version of the layout.
    pub format: u32,
    /// Program name and version of the last run.
    pub program: String,
    /// Adapter of that run; none if every filter was a program.
    pub adapter: Option<AdapterDescription>,
    /// Reasons for accepting the scores: when all were last accepted, and each time some were
    /// since.
    pub reasons: Vec<String>,
    /// Hash of the truth's inputs, per scene and alignment.
    pub truths: BTreeMap<SceneId, BTreeMap<Alignment, String>>,
    /// Score to six digits, per scene, filter (`jump_flood:paper`) and metric.
    pub scores: BTreeMap<SceneId, BTreeMap<String, BTreeMap<Metric, f64>>>,
}

impl Baseline {
    /// Reads a file that [`Baseline::write`] wrote.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = read_text(path)?;
        let baseline: Self = serde_json::from_str(&text).map_err(|error| {
            Error::Refused(format!(
                "{}: no baseline: {error}; `shuttertruth limits accept` writes one",
                path.display()
            ))
        })?;
        match baseline.format {
            BASELINE_FORMAT => Ok(baseline),
            other => Err(Error::Refused(format!(
                "{}: has format {other}; allowed: {BASELINE_FORMAT}; accept it anew",
                path.display()
            ))),
        }
    }

    /// Returns true if an adapter has the same class (software, integrated, discrete ..) as the
    /// baseline's.
    pub fn is_of_class(&self, adapter: &Option<AdapterDescription>) -> bool {
        let [baseline, other] = [&self.adapter, adapter].map(Option::as_ref);
        baseline.map(|baseline| &baseline.kind) == other.map(|other| &other.kind)
    }

    /// Writes the baseline as JSON.
    pub fn write(&self, path: &Path) -> Result<(), Error> {
        let json = serde_json::to_string_pretty(self).expect("a baseline is plain data");
        Ok(write_atomically(path, (json + "\n").as_bytes())?)
    }
}
