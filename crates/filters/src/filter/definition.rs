//! Definition of a filter: everything that `filter.toml` and its kernels declare.

use frame::Alignment;

use super::command::Command;
use super::lines::Lines;
use super::parameter::Parameter;
use super::pass::{Pass, Texture};
use super::preset::Preset;
use super::reach::ReachBy;
use crate::shader::{EntryPoint, Shader};

/// Seconds that one run of a program, or one dispatch of a pass, may take where filter.toml does not say.
pub(crate) const DEFAULT_TIME_LIMIT: f64 = 60.0;

/// A filter folder, read and checked: everything but the adapter is known to fit.
#[derive(Clone, Debug)]
pub struct Filter {
    /// Name of its WGSL file, and its word on the command line.
    pub name: String,
    /// Description in one sentence.
    pub summary: String,
    /// Publication that it comes from.
    pub source: String,
    /// Greatest length of its smear, in pixels or in frames of motion.
    pub reach: String,
    /// The parameter that bounds the reach; `None` where the smear reaches as far as anything moves.
    pub reach_by: Option<ReachBy>,
    /// Known shortcomings.
    pub cannot: String,
    /// The shutter interval that its smear stands for.
    pub alignment: Alignment,
    /// True if a mirrored frame gives the mirrored output with every preset.
    pub mirror_symmetric: bool,
    /// Parameters, in the order of the WGSL struct `Parameters`.
    pub parameters: Vec<Parameter>,
    /// At least one; the first is the default.
    pub presets: Vec<Preset>,
    /// The program to run; `None` for a filter with kernels and passes.
    pub command: Option<Command>,
    /// Seconds that one run of the program, or one dispatch of a pass, may take.
    pub time_limit: f64,
    /// Textures between its passes.
    pub textures: Vec<Texture>,
    /// Passes, in the order in which they run.
    pub passes: Vec<Pass>,
    pub(crate) shader: Shader,
    /// Lines of filter.toml that declare it all.
    pub(crate) lines: Lines,
}

impl Filter {
    /// Finds the kernel of a pass, which exists once the filter has been checked.
    pub(crate) fn entry_point(&self, pass: &Pass) -> &EntryPoint {
        let entry = self.shader.entry_point(&pass.entry);
        entry.expect("a checked filter has the entry points of its passes")
    }
}
