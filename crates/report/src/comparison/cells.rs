//! Words and numbers of a change, the same on the page and in the terminal.

use judge::{Change, ChangeKind, MeanChange, number, score_change};
use metrics::Metric;

use crate::numbers::signed;

/// A change as text, one per column.
pub struct ChangeCells {
    /// Score of the first run.
    pub first: String,
    /// Score of the second run.
    pub second: String,
    /// Change with its sign and its verdict: `+0.0123 worse`.
    pub change: String,
    /// 95 % confidence interval of the change, lower end first.
    pub interval: String,
}

impl From<&Change> for ChangeCells {
    fn from(change: &Change) -> Self {
        let [first, second] = change.estimates.map(number);
        Self {
            first,
            second,
            change: change_text(change.metric, change.estimate(), change.kind.label()),
            interval: match change.interval {
                _ if change.kind == ChangeKind::Same => String::new(),
                Some(interval) => interval_text(change.metric, interval),
                None => "by the noise floor".to_owned(),
            },
        }
    }
}

impl From<&MeanChange> for ChangeCells {
    fn from(mean: &MeanChange) -> Self {
        let [first, second] = [mean.first, mean.second].map(number);
        Self {
            first,
            second,
            change: change_text(mean.metric, mean.worse, mean.kind.label()),
            interval: interval_text(mean.metric, mean.interval),
        }
    }
}

fn change_text(metric: Metric, worse: f64, verdict: &str) -> String {
    format!("{} {verdict}", signed(score_change(metric, worse)))
}

fn interval_text(metric: Metric, worse: [f64; 2]) -> String {
    let [a, b] = worse.map(|end| score_change(metric, end));
    format!("{} to {}", signed(a.min(b)), signed(a.max(b)))
}
