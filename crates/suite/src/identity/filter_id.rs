//! Identity of a filter apart from scenes: what a row of every table stands for.

use std::fmt;

use frame::Alignment;
use serde::{Deserialize, Serialize};

/// A filter preset with one form of its input, or a reference with one shutter. As a text: `jump_flood:paper`, and of a reference, which
/// every alignment has of its own, `identity (trailing)`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct FilterId {
    /// `jump_flood:paper`, followed by what is not as usual.
    #[serde(rename = "filter")]
    pub name: String,
    /// True of a reference: `identity`, `scatter_oracle`, `accumulate:N`.
    #[serde(rename = "bar")]
    pub is_reference: bool,
    /// Shutter alignment that it is scored against.
    pub alignment: Alignment,
}

impl fmt::Display for FilterId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.is_reference {
            true => write!(f, "{} ({})", self.name, self.alignment),
            false => f.write_str(&self.name),
        }
    }
}
