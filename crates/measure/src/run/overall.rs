//! Means over the scenes, as recorded in a run.

use std::ops::Deref;

use metrics::Metric;
use scene::FrameRate;
use serde::{Deserialize, Serialize};

use crate::identity::FilterId;

/// One metric of one filter preset or reference picture, over the scenes that it applies to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Overall {
    /// Filter or reference.
    #[serde(flatten)]
    pub filter: FilterId,
    /// Frame rate of the scenes; none for their files' own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate: Option<FrameRate>,
    /// One of [`Metric::OF_MEANS`].
    pub metric: Metric,
    /// Number of scenes, each variant counted.
    pub scenes: usize,
    /// Mean over the scenes, in the metric's unit; for a skill the ratio of means.
    pub mean: f64,
    /// Lower and upper end of the mean's 95 % confidence interval over scenes.
    pub interval: [f64; 2],
}

impl Overall {
    /// Returns whether both belong to one filter preset or reference picture, at one frame rate.
    pub fn is_of_same(&self, other: &Self) -> bool {
        self.filter == other.filter && self.rate == other.rate
    }
}

/// A mean is a filter's, with numbers.
impl Deref for Overall {
    type Target = FilterId;

    fn deref(&self) -> &FilterId {
        &self.filter
    }
}
