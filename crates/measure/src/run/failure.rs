//! Cases without scores: their filter made no measurable picture.

use frame::Alignment;
use scene::SceneId;
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::identity::FilterId;

/// One filter preset that failed on one scene.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failure {
    /// Scene.
    pub scene: SceneId,
    /// `filter:preset`, followed by the form of its input if not the default.
    pub filter: String,
    /// Shutter alignment that the filter declares.
    pub alignment: Alignment,
    /// The error, and its place.
    pub reason: String,
}

impl Failure {
    /// Returns the identity of the filter.
    pub fn filter_id(&self) -> FilterId {
        FilterId {
            is_reference: false,
            name: self.filter.clone(),
            alignment: self.alignment,
        }
    }
}

/// Returns the error that ends the command of a run with failures.
pub fn refuse_failures(failures: &[Failure]) -> Result<(), Error> {
    let cases = match failures.len() {
        0 => return Ok(()),
        1 => "1 case".to_owned(),
        count => format!("{count} cases"),
    };
    Err(Error::Broken(format!(
        "{cases} failed, the first one {} on {}: {}",
        failures[0].filter, failures[0].scene, failures[0].reason
    )))
}
