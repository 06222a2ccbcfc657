//! Errors that end the work.

/// An error that ends the work. Its text names the place, what was found, what is allowed and the
/// way out.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A scene cannot be loaded.
    #[error(transparent)]
    Scene(#[from] scene::SceneError),
    /// A scene cannot be rendered as asked, or the render was interrupted.
    #[error(transparent)]
    Trace(#[from] tracer::TraceError),
    /// A filter cannot be loaded or run, or there is no adapter.
    #[error(transparent)]
    Filter(#[from] filters::FilterError),
    /// A picture cannot be measured.
    #[error(transparent)]
    Measure(#[from] metrics::MeasureError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] frame::FileError),
    /// Replicates that make no truth.
    #[error(transparent)]
    Truth(#[from] frame::TruthError),
    /// A truth with more noise than requested; its files are written all the same.
    #[error("{0}")]
    TooNoisy(String),
    /// Required bounds are broken, scores are worse than the baseline's, or cases failed; the
    /// report lists them.
    #[error("{0}")]
    Broken(String),
    /// The truth is too noisy to decide whether required bounds are met.
    #[error("{0}")]
    Inconclusive(String),
    /// A setting, or a file that a user wrote, is not allowed.
    #[error("{0}")]
    Refused(String),
}

impl Error {
    /// Returns whether the caller interrupted the work.
    pub fn is_interruption(&self) -> bool {
        matches!(
            self,
            Self::Trace(tracer::TraceError::Cancelled)
                | Self::Filter(filters::FilterError::Interrupted)
        )
    }
}
