//! Definition of a filter: everything that `filter.toml` and its kernels declare.

use std::path::PathBuf;

use frame::Alignment;

use super::command::Command;
use super::convention::Convention;
use super::history::{History, find_layer};
use super::layer::Layer;
use super::parameter::Parameter;
use super::pass::{Pass, Texture};
use super::preset::Preset;
use super::reach::ReachBy;
use crate::Format;
use crate::shader::{EntryPoint, Shader};

/// Seconds that one run of a program, or one dispatch of a pass, may take if filter.toml does not
/// say.
pub(crate) const DEFAULT_TIME_LIMIT: f64 = 60.0;

/// A filter folder, read and checked: everything but the adapter is known to fit.
#[derive(Clone, Debug)]
pub struct Filter {
    /// Name of its WGSL file, and its word on the command line.
    pub name: String,
    /// Folder that it was loaded from; none for a built-in one.
    pub folder: Option<PathBuf>,
    /// Description in one sentence.
    pub summary: String,
    /// Publication that it comes from.
    pub source: String,
    /// Greatest length of its smear, in pixels or in frames of motion.
    pub reach: String,
    /// The parameter that bounds the reach; `None` if the smear reaches as far as anything moves.
    pub reach_by: Option<ReachBy>,
    /// Known shortcomings.
    pub cannot: String,
    /// The shutter interval that its smear represents.
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
    /// Inputs of the frame before that its kernels read, each once.
    pub history: Vec<History>,
    /// Passes, in the order in which they run.
    pub(crate) passes: Vec<Pass>,
    /// Form in which its shaders expect the frame.
    pub convention: Convention,
    /// Kernels: those of its WGSL file, and one shader for each pass that names its own.
    pub(crate) shaders: Vec<Shader>,
    /// Hash of filter.toml and of its kernels, as their compilers left them: equal hashes mean equal
    /// pictures on one adapter.
    pub content_hash: String,
    /// Lines of filter.toml that declare it all.
    pub(crate) lines: Lines,
}

/// Lines of declarations in `filter.toml`, from 1, for messages.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lines {
    pub path: PathBuf,
    pub parameters: Vec<usize>,
    pub presets: Vec<usize>,
    pub textures: Vec<usize>,
    pub passes: Vec<usize>,
}

impl Filter {
    /// Finds the kernel of a pass, which exists once the filter has been checked.
    pub(crate) fn entry_point(&self, pass: &Pass) -> &EntryPoint {
        let entry = self.shader(pass).entry_point(pass.kernel());
        entry.expect("a checked filter has the entry points of its passes")
    }

    /// Finds the shader that a pass runs.
    pub(crate) fn shader(&self, pass: &Pass) -> &Shader {
        &self.shaders[pass.shaders[0]]
    }

    /// Says which compiler made the shader of each pass that needs one, and why others failed:
    /// `blur.hlsl compiled by slangc`.
    pub fn list_compilers(&self) -> Vec<String> {
        let mut listed = Vec::new();
        for pass in &self.passes {
            if let (Some(shader), Some(by)) = (&pass.shader, &self.shader(pass).compiled_by) {
                let line = format!("{} compiled by {by}", shader.file.path.display());
                if !listed.contains(&line) {
                    listed.push(line);
                }
            }
        }
        listed
    }

    /// Lists the stages of a pass: its kernel or fragment shader, then the vertex stage if the pass
    /// names one.
    pub(crate) fn stages(&self, pass: &Pass) -> Vec<(&Shader, &EntryPoint)> {
        let corners = pass.shaders[1..].iter().map(|index| &self.shaders[*index]);
        let corners = corners.map(|shader| (shader, &shader.entry_points[0]));
        let main = (self.shader(pass), self.entry_point(pass));
        [main].into_iter().chain(corners).collect()
    }

    /// Returns whether its shaders read a layer, by its name. A command may read all of them.
    pub fn reads(&self, layer: &str) -> bool {
        let stages = self.passes.iter().flat_map(|pass| self.stages(pass));
        let mut reads = stages.map(|(_, entry)| entry.reads.contains(layer));
        self.command.is_some() || reads.any(|reads| reads)
    }

    /// Lists the layers that its shaders read and few frames have: `velocity_next`, `velocity_z`
    /// and `exclusion`.
    pub fn further_inputs(&self) -> Vec<Layer> {
        let is_read = |layer: &Layer| self.command.is_none() && self.reads(layer.name());
        Layer::FURTHER.into_iter().filter(is_read).collect()
    }

    /// Returns true if the first pass that writes the output reads it, too: it begins as a copy of
    /// the colours.
    pub(crate) fn is_in_place(&self) -> bool {
        let entries = self.passes.iter().map(|pass| self.entry_point(pass));
        let mut writers = entries.filter(|entry| entry.writes.contains("output"));
        (writers.next()).is_some_and(|entry| entry.reads.contains("output"))
    }

    /// Counts the copies of a texture: two if a pass both reads and writes it.
    pub(crate) fn count_copies(&self, texture: &str) -> usize {
        let is_exchanged = self.passes.iter().any(|pass| {
            let mut names = self.entry_point(pass).exchanged_textures();
            names.any(|name| name == texture)
        });
        if is_exchanged { 2 } else { 1 }
    }

    /// Tells whether its shaders read one of the velocities that few frames have.
    pub fn reads_further_velocities(&self) -> bool {
        (self.further_inputs().iter()).any(|layer| *layer != Layer::Exclusion)
    }

    /// Finds a declared texture.
    pub(crate) fn texture(&self, name: &str) -> Option<&Texture> {
        self.textures.iter().find(|texture| texture.name == name)
    }

    /// Returns the format of a texture that shaders can read.
    pub(crate) fn read_format(&self, name: &str) -> Format {
        let declared = self.texture(name);
        declared.map_or_else(
            || match find_layer(name) {
                Some(layer) => self.convention.format_of(layer),
                None => self.convention.output_format(),
            },
            |texture| texture.format,
        )
    }

    /// Returns true for a texture that shaders can name.
    pub(crate) fn has_texture(&self, name: &str) -> bool {
        self.texture_names().any(|known| known == name)
    }

    /// Lists the textures that shaders can name.
    pub(crate) fn list_textures(&self) -> String {
        self.texture_names().collect::<Vec<_>>().join(", ")
    }

    fn texture_names(&self) -> impl Iterator<Item = &str> {
        let declared = self.textures.iter().map(|texture| &texture.name[..]);
        let before = self.history.iter().map(|history| history.texture());
        let inputs = Layer::OF_EVERY_FRAME.map(Layer::name).into_iter();
        let all = inputs.chain(before).chain(["output"]).chain(declared);
        all.chain(Layer::FURTHER.map(Layer::name))
    }
}
