//! Errors of loading and running filters.

use std::path::PathBuf;

/// Error of a filter. Every message names the place, what was found, what is allowed, and the way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FilterError {
    /// The machine offers no adapter at all.
    #[error(
        "no GPU adapter was found: filters need Vulkan, Metal or DirectX 12. Without a graphics card, a software \
         Vulkan driver serves: on Debian and Ubuntu `apt-get install mesa-vulkan-drivers libvulkan1`"
    )]
    NoAdapter,
    /// The adapter asked for is not there.
    #[error("no adapter is called \"{wanted}\"; found: {}", found.join("; "))]
    UnknownAdapter {
        /// Index or part of the name that was asked for.
        wanted: String,
        /// `index: name` of every adapter there is.
        found: Vec<String>,
    },
    /// The adapter gives no device.
    #[error("adapter \"{adapter}\" cannot be used: {reason}; choose another adapter")]
    Device {
        /// Name of the adapter.
        adapter: String,
        /// What the driver said.
        reason: String,
    },
    /// A filter folder that says something wrong.
    #[error("{}{}: {reason}", path.display(), line.map(|line| format!(":{line}")).unwrap_or_default())]
    Folder {
        /// The file at fault, or the folder.
        path: PathBuf,
        /// Line in that file, from 1.
        line: Option<usize>,
        /// What was found and what is allowed.
        reason: String,
    },
    /// Kernels that do not compile.
    #[error("{}:{line}:{column}: {reason}", path.display())]
    Kernels {
        /// The WGSL file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What naga said, with the line itself and a mark below.
        reason: String,
    },
    /// No built-in filter has that name.
    #[error("no built-in filter is called \"{name}\"; allowed: {}; a folder of your own is given by its path, such as ./{name}", known.join(", "))]
    UnknownFilter {
        /// The name asked for.
        name: String,
        /// Every built-in filter.
        known: Vec<String>,
    },
    /// The filter has no preset of that name.
    #[error("filter {filter} has no preset \"{preset}\"; allowed: {}", known.join(", "))]
    UnknownPreset {
        /// The filter.
        filter: String,
        /// The name asked for.
        preset: String,
        /// Every preset of the filter.
        known: Vec<String>,
    },
    /// A parameter that the filter does not have, or a value that it does not allow.
    #[error("{filter}.{parameter}: {reason}")]
    Parameter {
        /// The filter.
        filter: String,
        /// The name as it was given.
        parameter: String,
        /// What was found and what is allowed.
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
        /// What is allowed.
        reason: String,
    },
    /// A frame that cannot be blurred.
    #[error("filter {filter}: {reason}")]
    Input {
        /// The filter.
        filter: String,
        /// What was found and what is allowed.
        reason: String,
    },
    /// A filter that is a command did not do what it was asked to.
    #[error("filter {filter}: {reason}")]
    Command {
        /// The filter.
        filter: String,
        /// What happened, what is needed, and the last lines that the program printed.
        reason: String,
    },
    /// A command was stopped on request.
    #[error("interrupted")]
    Interrupted,
    /// A filter fails with values that its filter.toml allows.
    #[error("{}", .0.join("\n"))]
    TriedOut(
        /// What fails and where, a line each.
        Vec<String>,
    ),
    /// A pass was given up. The adapter may still be at work on it, so nothing else is run there.
    #[error(
        "filter {filter}, pass {pass}: took longer than {time_limit} s and was given up; make it faster, or raise \
         time_limit in filter.toml"
    )]
    TooSlow {
        /// The filter.
        filter: String,
        /// Entry point of the pass.
        pass: String,
        /// Seconds that it was given.
        time_limit: f64,
    },
    /// wgpu or the driver refused a pass.
    #[error("filter {filter}, pass {pass}: {reason}")]
    Gpu {
        /// The filter.
        filter: String,
        /// Entry point of the pass, or what was done around the passes: `upload`, `read back`.
        pass: String,
        /// What wgpu said.
        reason: String,
    },
}
