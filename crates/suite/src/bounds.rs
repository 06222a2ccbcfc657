//! Limits on scores, and what a score is worth against its limit.

use std::collections::BTreeMap;
use std::path::Path;
use std::str::FromStr;

use metrics::{Ideal, Measured, Metric, Scores};
use serde::{Deserialize, Serialize};

use crate::Error;

/// A limit per metric name.
pub type Bounds = BTreeMap<String, f64>;

/// How one score stands to its bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Name of the metric.
    pub metric: String,
    /// What is allowed.
    pub limit: f64,
    /// How it turned out.
    pub outcome: Outcome,
}

/// Whether a score keeps its bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "is", rename_all = "snake_case")]
pub enum Outcome {
    /// On the right side of the limit.
    Kept {
        /// The score.
        value: f64,
    },
    /// On the wrong side.
    Broken {
        /// The score.
        value: f64,
    },
    /// The limit is stricter than the truth's noise can carry, three floors: neither kept nor broken.
    TooNoisy {
        /// The score's noise floor.
        floor: f64,
        /// The strictest limit that this floor can carry.
        strictest: f64,
    },
    /// The metric does not apply to this scene.
    NotApplicable {
        /// Why not.
        reason: String,
    },
}

/// Reads `bounds.toml` beside the scenes and, over it, beside the scene: a table of metric names and limits.
pub fn read_bounds(root: &Path, scene_folder: &Path) -> Result<Bounds, Error> {
    let mut bounds = Bounds::new();
    for path in [root.join("bounds.toml"), scene_folder.join("bounds.toml")] {
        if !path.exists() {
            continue;
        }
        let text = std::fs::read_to_string(&path)
            .map_err(|error| Error::Usage(format!("{}: cannot read: {error}", path.display())))?;
        let own: Bounds = toml::from_str(&text)
            .map_err(|error| Error::Usage(format!("{}: {error}", path.display())))?;
        for (name, limit) in own {
            check(&name, limit)
                .map_err(|reason| Error::Usage(format!("{}: {reason}", path.display())))?;
            bounds.insert(name, limit);
        }
    }
    Ok(bounds)
}

fn check(name: &str, limit: f64) -> Result<(), String> {
    let metric = Metric::from_str(name)?;
    if let Some(reason) = metric.report_only() {
        return Err(format!("{name} is for reports and no bound: it {reason}"));
    }
    if !limit.is_finite() {
        return Err(format!("{name} = {limit}; allowed: a finite number"));
    }
    Ok(())
}

/// Compares every bounded score with its limit. Pure: reads nothing, prints nothing.
pub fn judge(scores: &Scores, bounds: &Bounds) -> Vec<Verdict> {
    bounds
        .iter()
        .map(|(name, limit)| {
            let metric = Metric::from_str(name).expect("bounds were checked when they were read");
            Verdict {
                metric: name.clone(),
                limit: *limit,
                outcome: outcome(metric, &scores.get(metric), *limit),
            }
        })
        .collect()
}

fn outcome(metric: Metric, measured: &Measured, limit: f64) -> Outcome {
    let score = match measured {
        Measured::Score(score) => score,
        Measured::NotApplicable { reason } => {
            return Outcome::NotApplicable {
                reason: reason.clone(),
            };
        }
    };
    let (value, floor) = (score.value, score.floor);
    let strictest = metric.strictest_bound(floor);
    let (kept, too_strict) = match metric.ideal() {
        Ideal::Highest => (value >= limit, limit > strictest),
        ideal => (ideal.badness(value) <= limit, limit < strictest),
    };
    if too_strict {
        Outcome::TooNoisy { floor, strictest }
    } else if kept {
        Outcome::Kept { value }
    } else {
        Outcome::Broken { value }
    }
}
