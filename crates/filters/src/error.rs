//! Errors of loading and running filters.

use std::path::Path;

use shader_import::{FileFault, ImportError};

/// Error of a filter. Every message names the place, what was found, what is allowed, and the way
/// out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FilterError {
    /// The machine offers no adapter at all.
    #[error(
        "no GPU adapter was found: filters need Vulkan, Metal or DirectX 12. Without a graphics card, a software \
         Vulkan driver serves: on Debian and Ubuntu `apt-get install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter,
    /// A name that is unknown, an adapter that cannot be opened, or failures of a filter with
    /// values that its filter.toml allows.
    #[error("{0}")]
    Refused(
        /// What was asked for, and what there is.
        String,
    ),
    /// A fault in a filter folder.
    #[error(transparent)]
    Folder(#[from] FileFault),
    /// A parameter that the filter does not have, or a value that it does not allow.
    #[error("{filter}.{parameter}: {reason}")]
    Parameter {
        /// The filter.
        filter: String,
        /// The name as it was given.
        parameter: String,
        /// Fault, and what is allowed.
        reason: String,
    },
    /// The image is too large, or empty.
    #[error("filter {filter}: an image of {width}x{height} pixels cannot be blurred; {reason}")]
    Size {
        /// The filter.
        filter: String,
        /// Pixels per row.
        width: u32,
        /// Rows.
        height: u32,
        /// Allowed sizes.
        reason: String,
    },
    /// A frame that cannot be blurred.
    #[error("filter {filter}: {reason}")]
    Input {
        /// The filter.
        filter: String,
        /// Fault, and what is allowed.
        reason: String,
    },
    /// A program failed.
    #[error("filter {filter}: {reason}")]
    Command {
        /// The filter.
        filter: String,
        /// Fault, what is needed, and the last lines that the program printed.
        reason: String,
    },
    /// A command was stopped on request.
    #[error("interrupted")]
    Interrupted,
    /// A pass took too long and was given up. The adapter may still be at work on it, so nothing
    /// else is run there.
    #[error(
        "filter {filter}, pass {pass}: took longer than {time_limit} s and was given up; make it faster, or raise \
         time_limit in filter.toml"
    )]
    TooSlow {
        /// The filter.
        filter: String,
        /// Entry point of the pass.
        pass: String,
        /// Time limit in seconds.
        time_limit: f64,
    },
    /// The driver gave up the device while it compiled or ran a pass. The next filter gets a new
    /// one.
    #[error(
        "filter {filter}, pass {pass}: adapter \"{adapter}\" lost its device ({reason}); its driver cannot run this shader; \
         write it otherwise, or choose another adapter"
    )]
    Lost {
        /// The filter.
        filter: String,
        /// Entry point of the pass, or a step around the passes.
        pass: String,
        /// Name of the adapter.
        adapter: String,
        /// Message of the driver.
        reason: String,
    },
    /// wgpu or the driver refused a pass.
    #[error("filter {filter}, pass {pass}: {reason}")]
    Gpu {
        /// The filter.
        filter: String,
        /// Entry point of the pass, or a step around the passes: `upload`, `read back`.
        pass: String,
        /// Message of wgpu.
        reason: String,
    },
}

impl FilterError {
    /// Makes an error of a file in a filter folder, and of a line in it if it has one.
    pub(crate) fn in_file(
        path: &Path,
        line: impl Into<Option<usize>>,
        reason: impl Into<String>,
    ) -> Self {
        FileFault::new(path, line, reason).into()
    }
}

impl From<ImportError> for FilterError {
    fn from(error: ImportError) -> Self {
        match error {
            ImportError::File(fault) => Self::Folder(fault),
            ImportError::Interrupted => Self::Interrupted,
        }
    }
}
