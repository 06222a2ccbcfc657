//! Means over the scenes, as a run records them.

use frame::Alignment;
use metrics::Metric;
use serde::{Deserialize, Serialize};
use tracer::FrameRate;

use crate::identity::FilterId;

/// One metric of one filter preset, or of one reference picture, over the scenes that it applies to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Overall {
    /// `jump_flood:paper`, and behind that the form of the input where that is not the default.
    pub filter: String,
    /// True for a reference picture, false for a filter.
    #[serde(rename = "bar")]
    pub is_reference: bool,
    /// The shutter alignment that it is scored against.
    pub alignment: Alignment,
    /// Frame rate of the scenes; none for that of their files.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rate: Option<FrameRate>,
    /// One of [`Metric::OF_MEANS`].
    pub metric: Metric,
    /// Number of scenes, each variant of one counted.
    pub scenes: usize,
    /// Mean over the scenes, in the metric's unit; of a skill the ratio of means.
    pub mean: f64,
    /// Lower and upper end of the mean's 95 % confidence interval over scenes.
    pub interval: [f64; 2],
}

impl Overall {
    /// Tells whether both are of one filter preset or reference picture, at one frame rate.
    pub fn is_of_same(&self, other: &Self) -> bool {
        self.filter_id() == other.filter_id() && self.rate == other.rate
    }

    /// Returns the identity of the filter or reference.
    pub fn filter_id(&self) -> FilterId {
        FilterId {
            is_reference: self.is_reference,
            name: self.filter.clone(),
            alignment: self.alignment,
        }
    }
}
