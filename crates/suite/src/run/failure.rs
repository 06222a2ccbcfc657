//! A case without scores, because its filter made no picture that can be measured.

use filters::FilterError;
use serde::{Deserialize, Serialize};
use tracer::Scene;

use crate::Error;
use crate::run::subject::Subject;

/// One filter preset that failed on one scene.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failure {
    /// Scene, with its variant.
    pub scene: String,
    /// `filter:preset`, and behind that the form of its input where that is not as usual.
    pub filter: String,
    /// The shutter alignment that the filter declares.
    pub alignment: String,
    /// What went wrong, and where.
    pub reason: String,
}

impl Failure {
    /// Takes an error that concerns one case for its failure. Any other error ends the run and comes back.
    pub(crate) fn of(error: Error, subject: &Subject, scene: &Scene) -> Result<Self, Error> {
        match &error {
            Error::Filter(FilterError::Gpu { .. } | FilterError::Command { .. })
            | Error::Measure(_) => Ok(Self {
                scene: scene.name.clone(),
                filter: subject.name(),
                alignment: subject.alignment.name().to_owned(),
                reason: error.to_string(),
            }),
            _ => Err(error),
        }
    }
}

/// The error that ends a command whose run has failures; none where it has none.
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
