//! Identity of a filter without a scene: the key of a table row.

use std::fmt;

use frame::Alignment;
use serde::{Deserialize, Serialize};

/// A filter preset with one form of its input, or a reference with one shutter. As a text:
/// `jump_flood:paper`, or for a reference, which exists once per alignment, `identity (trailing)`.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct FilterId {
    /// `jump_flood:paper`, followed by everything unusual.
    #[serde(rename = "filter")]
    pub name: String,
    /// True for a reference: `identity`, `scatter_oracle`, `accumulate:N`.
    #[serde(rename = "bar")]
    pub is_reference: bool,
    /// Shutter alignment that it is scored against.
    pub alignment: Alignment,
}

impl fmt::Display for FilterId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_reference {
            write!(f, "{} ({})", self.name, self.alignment)
        } else {
            f.write_str(&self.name)
        }
    }
}
