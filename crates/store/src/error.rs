//! Errors of stored files.

/// A folder or a file that is not as it must be. Its text names the place, what was found, what is
/// allowed and the way out.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] frame::FileError),
    /// A folder or a file that is not allowed.
    #[error("{0}")]
    Refused(String),
    /// The caller interrupted the work.
    #[error(transparent)]
    Cancelled(#[from] tracer::TraceError),
}
