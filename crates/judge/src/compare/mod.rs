//! Comparison of two finished runs: changes, beyond noise or not.

mod change;
mod margin;
mod mean;
mod noise;
mod pairing;
mod settings;
mod sizes;

use std::collections::BTreeMap;

use measure::{Error, PROGRAM, StoredRun};
use metrics::Metric;
use serde::Serialize;
use tracer::Watch;

use crate::bounds::Margin;

pub use change::{Basis, Change, ChangeKind, rank_changes, score_change};
pub use mean::MeanChange;
pub use pairing::{Pair, pair_cases};
pub use settings::SettingChange;
pub use sizes::{Agreement, FilterAtSizes, Reversal, SizeComparison, compare_sizes};

use margin::apply_margins;
use mean::average_changes;
use noise::measure_changes;
use pairing::{cases_missing_from, check_comparable};
use settings::compare_settings;

/// Version of the layout of a comparison as JSON.
const COMPARE_FORMAT: u32 = 1;

/// Differences between two runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunComparison {
    /// Version of the layout.
    pub format: u32,
    /// Program name and version.
    pub program: &'static str,
    /// Paths of the first run.json and of the second one.
    pub runs: [String; 2],
    /// Settings that differ between the runs.
    pub settings: Vec<SettingChange>,
    /// Cases of the first run that the second one lacks: `fan / jump_flood:paper`.
    pub only_in_first: Vec<String>,
    /// Cases of the second run that the first one lacks.
    pub only_in_second: Vec<String>,
    /// Mean over scenes per metric and per filter that both have, without references.
    pub means: Vec<MeanChange>,
    /// Change per metric and per case that both have, in the order of the first run.
    pub changes: Vec<Change>,
}

/// Compares two runs. Separates changes from noise by the truths' replicates and the pictures, if
/// their files exist, and counts none below its margin; writes nothing. Reports every pair of cases
/// to `watch`.
pub fn compare_runs(
    first: &StoredRun,
    second: &StoredRun,
    margins: &BTreeMap<Metric, Margin>,
    watch: Watch,
) -> Result<RunComparison, Error> {
    let pairs = pair_cases(&first.run, &second.run);
    check_comparable(first, second, &pairs)?;
    let mut changes = measure_changes([first, second], &pairs, watch)?;
    let mut means = average_changes(&changes);
    apply_margins(&mut changes, &mut means, margins);
    Ok(RunComparison {
        format: COMPARE_FORMAT,
        program: PROGRAM,
        runs: [first, second].map(|side| side.path.display().to_string()),
        settings: compare_settings(&first.run, &second.run, &pairs),
        only_in_first: cases_missing_from(&second.run, &first.run),
        only_in_second: cases_missing_from(&first.run, &second.run),
        means,
        changes,
    })
}
