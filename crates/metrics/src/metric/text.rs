//! Names of scores as texts: in files, on the command line and in sorted lists.

use std::cmp::Ordering;
use std::collections::HashMap;
use std::fmt;
use std::str::FromStr;
use std::sync::LazyLock;

use super::Metric;
use crate::SequenceMetric;

impl fmt::Display for Metric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.name())
    }
}

impl FromStr for Metric {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        static BY_NAME: LazyLock<HashMap<String, Metric>> = LazyLock::new(|| {
            let more = SequenceMetric::ALL.into_iter().map(Metric::Sequence);
            let more = more.chain([Metric::Bleed, Metric::CommonFlip]);
            let all = Metric::all().into_iter().chain(more);
            all.map(|metric| (metric.name(), metric)).collect()
        });
        BY_NAME.get(text).copied().ok_or_else(|| {
            let names: Vec<String> = Metric::all().into_iter().map(Metric::name).collect();
            format!(
                "metric \"{text}\" is unknown; allowed: {}; of sequences: {}",
                names.join(", "),
                SequenceMetric::ALL
                    .map(|metric| metric.row().name)
                    .join(", ")
            )
        })
    }
}

impl TryFrom<String> for Metric {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl From<Metric> for String {
    fn from(metric: Metric) -> String {
        metric.name()
    }
}

impl Ord for Metric {
    fn cmp(&self, other: &Self) -> Ordering {
        self.name().cmp(&other.name())
    }
}

impl PartialOrd for Metric {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
