//! A filter: what `filter.toml` and its kernels say, checked.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use frame::{Alignment, FileError, read_bounded};
use include_dir::{Dir, include_dir};

use crate::gpu::{EntryPoint, Shader};
use crate::manifest::Lines;
use crate::{
    Command, FilterError, Length, Parameter, ReachBy, Settings, Source, Tuned, Value, manifest,
    wiring,
};

static BUILTIN: Dir = include_dir!("$CARGO_MANIFEST_DIR/../../shaders");

/// Seconds that one run of a program, or one dispatch of a pass, may take where filter.toml does not say.
pub(crate) const DEFAULT_TIME_LIMIT: f64 = 60.0;

/// The largest filter.toml that is read, in bytes.
pub const MAX_MANIFEST_BYTES: u64 = 1 << 20;

/// The largest WGSL file that is read, in bytes. The largest one that is built in has a tenth of it.
pub const MAX_KERNEL_BYTES: u64 = 256 << 10;

/// A filter folder, read and checked: everything but the adapter is known to fit.
#[derive(Clone, Debug)]
pub struct Filter {
    /// Also the name of its WGSL file and its word on the command line.
    pub name: String,
    /// What it is, in one sentence.
    pub summary: String,
    /// Where it was published.
    pub source: String,
    /// How far its smear reaches, in pixels or in frames of motion.
    pub reach: String,
    /// The parameter that bounds it; `None` where the smear reaches as far as anything moves.
    pub reach_by: Option<ReachBy>,
    /// What it is known not to do.
    pub cannot: String,
    /// The shutter interval that its smear stands for.
    pub alignment: Alignment,
    /// Whether a mirrored frame gives the mirrored output with every preset.
    pub mirror_symmetric: bool,
    /// In the order of the WGSL struct `Parameters`.
    pub parameters: Vec<Parameter>,
    /// At least one; the first is the default.
    pub presets: Vec<Preset>,
    /// The program that it is; one that is none has kernels, and passes that run them.
    pub command: Option<Command>,
    /// Seconds that one run of the program, or one dispatch of a pass, may take.
    pub time_limit: f64,
    /// Textures between its passes.
    pub textures: Vec<Texture>,
    /// In the order in which they run.
    pub passes: Vec<Pass>,
    pub(crate) shader: Shader,
    /// Where filter.toml declares it all.
    pub(crate) lines: Lines,
}

/// Named values for a filter's parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Preset {
    /// What it is called on the command line.
    pub name: String,
    /// What it stands for.
    pub doc: String,
    /// Whose work it follows, where it is somebody's.
    pub source: Option<Source>,
    /// Width in pixels of the pictures that its author made it for; `None` where no parameter depends on that, or nobody
    /// knows.
    pub reference_width: Option<u32>,
    /// The values that differ from the parameters' defaults.
    pub values: BTreeMap<String, Value>,
    /// How the values were found, where tuning found them.
    pub tuned: Option<Tuned>,
}

/// What one pass leaves for another.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// WGSL variable that reads it; `<name>_out` writes it.
    pub name: String,
    /// Numbers per texel.
    pub format: Format,
    /// By what the image's size is divided, rounded up; `None` for the image's own size.
    pub divided_by: Option<Length>,
    /// What its numbers are, where a person may want to see them.
    pub holds: Option<Holds>,
}

/// What a texture between the passes says of a pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Holds {
    /// As x and y, in pixels from the image's top left corner, the place that gives the pixel its velocity.
    Places,
}

/// Texel format: numbers of 32 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// One whole number from 0.
    R32Uint,
    /// One number.
    R32Float,
    /// Two.
    Rg32Float,
    /// Four.
    Rgba32Float,
}

/// One kernel, run over a whole texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Pass {
    /// Entry point of the kernel; the pass's name in messages.
    pub entry: String,
    /// Texture whose texels it runs over; `None` for the image's pixels.
    pub over: Option<String>,
    /// Whether a whole workgroup runs for each of those texels, instead of one invocation.
    pub workgroup_per_texel: bool,
    /// How often it runs.
    pub repeat: Repeat,
}

/// How often a pass runs.
#[derive(Clone, Debug, PartialEq)]
pub enum Repeat {
    /// A fixed number of times.
    Times(u32),
    /// As often as this integer parameter says.
    Parameter(String),
}

impl Filter {
    /// Reads and checks a filter folder: `filter.toml` and, unless it is a command, the WGSL file that it names. Both are
    /// regular files of at most [`MAX_MANIFEST_BYTES`] and [`MAX_KERNEL_BYTES`].
    pub fn load(folder: &Path) -> Result<Self, FilterError> {
        let manifest = read_text(&folder.join("filter.toml"), MAX_MANIFEST_BYTES)?;
        Self::parse(folder, &manifest, |path| read_text(&path, MAX_KERNEL_BYTES))
    }

    /// A filter that the program brings along.
    pub fn builtin(name: &str) -> Result<Self, FilterError> {
        let folder = BUILTIN
            .get_dir(name)
            .ok_or_else(|| FilterError::UnknownFilter {
                name: name.to_owned(),
                known: Self::builtin_names(),
            })?;
        let text = |path: &Path| {
            let file = BUILTIN.get_file(path);
            file.and_then(|file| file.contents_utf8())
                .unwrap_or_else(|| panic!("{} is embedded as text", path.display()))
                .to_owned()
        };
        let manifest = text(&folder.path().join("filter.toml"));
        Self::parse(folder.path(), &manifest, |path| Ok(text(&path)))
    }

    /// Every built-in filter, in alphabetical order.
    pub fn builtin_names() -> Vec<String> {
        let mut names: Vec<String> = BUILTIN
            .dirs()
            .map(|folder| folder.path().display().to_string())
            .collect();
        names.sort();
        names
    }

    /// The values of a preset, or of the first one.
    pub fn settings(&self, preset: Option<&str>) -> Result<Settings, FilterError> {
        let preset = match preset {
            None => &self.presets[0],
            Some(name) => self
                .presets
                .iter()
                .find(|preset| preset.name == name)
                .ok_or_else(|| FilterError::UnknownPreset {
                    filter: self.name.clone(),
                    preset: name.to_owned(),
                    known: self.presets.iter().map(|p| p.name.clone()).collect(),
                })?,
        };
        let mut values: BTreeMap<String, Value> = self
            .parameters
            .iter()
            .map(|parameter| (parameter.name.clone(), parameter.default.clone()))
            .collect();
        values.extend(preset.values.clone());
        Ok(Settings {
            preset: preset.name.clone(),
            values,
            reference_width: preset.reference_width,
            fixed: BTreeSet::new(),
        })
    }

    /// The kernel of a pass; checked when the filter was read.
    pub(crate) fn entry_point(&self, pass: &Pass) -> &EntryPoint {
        let entry = self.shader.entry_point(&pass.entry);
        entry.expect("a checked filter has the entry points of its passes")
    }

    fn parse(
        folder: &Path,
        manifest: &str,
        read: impl Fn(PathBuf) -> Result<String, FilterError>,
    ) -> Result<Self, FilterError> {
        let mut filter = manifest::read(&folder.join("filter.toml"), manifest)?;
        if filter.command.is_some() {
            return Ok(filter);
        }
        let kernels = folder.join(format!("{}.wgsl", filter.name));
        filter.shader = Shader::parse(&kernels, &read(kernels.clone())?, COMMON)?;
        wiring::check(&filter)?;
        Ok(filter)
    }
}

/// Reads a file of a filter folder, which is to be UTF-8.
fn read_text(path: &Path, limit: u64) -> Result<String, FilterError> {
    let refuse = |reason: String| FilterError::Folder {
        path: path.to_owned(),
        line: None,
        reason,
    };
    let bytes = read_bounded(path, limit).map_err(|error| {
        let holds = "a filter folder holds filter.toml and <name>.wgsl";
        refuse(match error {
            FileError::Io { source, .. } => format!("cannot be read: {source}; {holds}"),
            FileError::Broken { reason, .. } | FileError::Foreign { reason, .. } => reason,
        })
    })?;
    String::from_utf8(bytes).map_err(|error| {
        let place = error.utf8_error().valid_up_to();
        refuse(format!(
            "is not UTF-8 from byte {place} on; save it as UTF-8"
        ))
    })
}

/// Appended to every filter's kernels.
pub(crate) const COMMON: &str = include_str!("../../../shaders/common.wgsl");
