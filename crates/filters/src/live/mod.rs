//! A filter as data for a program that runs it elsewhere, such as a page in a browser: all that `gpu` binds and dispatches.

mod bindings;
mod passes;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde::Serialize;

use crate::filter::{INPUTS, Kind, Rounding};
use crate::gpu::{FrameValues, output_format};
use crate::load::read_text;
use crate::shader::{COMMON, FRAME_PREFIX};
use crate::{Expression, Filter, Format, Input, Scale, Unit, Value};
use passes::{LivePass, find_features};

/// A filter with everything that a WebGPU device needs to run it. Places, sizes and values are those of [`Blur`](crate::Blur).
#[derive(Clone, Debug, Serialize)]
pub struct LiveFilter {
    name: String,
    /// Its WGSL file.
    file: String,
    /// Text of filter.toml.
    toml: String,
    /// `reference_width` of a new preset, so that its values in pixels stay as they are; none if no value is in pixels.
    reference_width: Option<u32>,
    parameters: Vec<LiveParameter>,
    presets: Vec<LivePreset>,
    /// Optional features of WebGPU that it needs.
    features: BTreeSet<&'static str>,
    /// Textures that the frame fills.
    inputs: Vec<LiveInput>,
    /// Format of the output.
    output: Format,
    textures: Vec<LiveTexture>,
    modules: Vec<LiveModule>,
    passes: Vec<LivePass>,
}

/// A parameter, as a page shows it.
#[derive(Clone, Debug, Serialize)]
struct LiveParameter {
    name: String,
    kind: &'static str,
    min: Option<f64>,
    max: Option<f64>,
    scale: Option<Scale>,
    choices: Option<Vec<String>>,
    default: Value,
    unit: Option<Unit>,
    doc: String,
}

/// A preset, with the value of every parameter for the picture's width.
#[derive(Clone, Debug, Serialize)]
struct LivePreset {
    name: String,
    doc: String,
    values: BTreeMap<String, Value>,
}

#[derive(Clone, Debug, Serialize)]
struct LiveInput {
    /// Name of the texture.
    name: &'static str,
    /// Input of the frame that fills it.
    from: &'static str,
    format: Format,
}

/// A texture between the passes.
#[derive(Clone, Debug, Serialize)]
struct LiveTexture {
    name: String,
    format: Format,
    divided_by: Option<[Expression; 2]>,
    rounding: Rounding,
    mips: u32,
    copies: usize,
}

/// A module: two texts, compiled as one.
#[derive(Clone, Debug, Serialize)]
struct LiveModule {
    /// Kernels of the filter.
    wgsl: String,
    /// Text that the program appends after a line break.
    appended: &'static str,
    /// True if a person may change the kernels.
    editable: bool,
}

impl LiveFilter {
    /// Describes a filter for pictures of a width, without their guard band; `as_written` leaves the presets' values in pixels unscaled.
    ///
    /// # Errors
    /// It is a program, its shaders are bound in filter.toml, or its files cannot be read again: a sentence for the page's reader.
    pub fn new(filter: &Filter, width: u32, as_written: bool) -> Result<Self, String> {
        if filter.command.is_some() || filter.passes.iter().any(|pass| pass.shader.is_some()) {
            return Err("This page cannot run the filter: filter.toml binds its shaders.".into());
        }
        let in_pixels = |parameter: &crate::Parameter| parameter.unit == Some(Unit::Pixels);
        let kernels = &filter.shaders[0].path;
        let read = |path: &Path| read_text(filter, path).map_err(|error| error.to_string());
        Ok(Self {
            name: filter.name.clone(),
            file: format!("{}.wgsl", filter.name),
            toml: read(&filter.lines.path)?,
            reference_width: filter.parameters.iter().any(in_pixels).then_some(width),
            parameters: filter.parameters.iter().map(LiveParameter::new).collect(),
            presets: list_presets(filter, width, as_written),
            features: find_features(filter),
            inputs: list_inputs(filter),
            output: output_format(filter),
            textures: list_textures(filter),
            modules: vec![LiveModule {
                wgsl: read(kernels)?.trim_end().to_owned(),
                appended: COMMON,
                editable: true,
            }],
            passes: (filter.passes.iter())
                .map(|pass| LivePass::new(filter, pass))
                .collect(),
        })
    }
}

impl LiveParameter {
    fn new(parameter: &crate::Parameter) -> Self {
        let (kind, range, scale, choices) = match &parameter.kind {
            Kind::Integer { min, max, scale } => {
                let range = [*min, *max].map(f64::from);
                ("integer", Some(range), Some(*scale), None)
            }
            Kind::Real { min, max, scale } => ("real", Some([*min, *max]), Some(*scale), None),
            Kind::Choice { choices } => ("choice", None, None, Some(choices.clone())),
        };
        Self {
            name: parameter.name.clone(),
            kind,
            min: range.map(|[min, _]| min),
            max: range.map(|[_, max]| max),
            scale,
            choices,
            default: parameter.default.clone(),
            unit: parameter.unit,
            doc: parameter.doc.clone(),
        }
    }
}

fn list_presets(filter: &Filter, width: u32, as_written: bool) -> Vec<LivePreset> {
    let describe = |preset: &crate::Preset| {
        let written = filter.settings(Some(&preset.name));
        let written = written.expect("the filter has this preset");
        let settings = match as_written {
            true => written,
            false => written.scaled_to(filter, width),
        };
        LivePreset {
            name: preset.name.clone(),
            doc: preset.doc.clone(),
            values: settings.values,
        }
    };
    filter.presets.iter().map(describe).collect()
}

/// Lists the textures that the frame fills; those of the frame before show the first frame of a sequence itself.
fn list_inputs(filter: &Filter) -> Vec<LiveInput> {
    let own = INPUTS.into_iter().chain(filter.further_inputs());
    let own = own.map(|name| (name, name));
    let before = (filter.history.iter()).map(|history| (history.texture(), history.input()));
    own.chain(before)
        .map(|(name, from)| LiveInput {
            name,
            from,
            format: filter.convention.format_of(name),
        })
        .collect()
}

fn list_textures(filter: &Filter) -> Vec<LiveTexture> {
    let describe = |texture: &crate::Texture| LiveTexture {
        name: texture.name.clone(),
        format: texture.format,
        divided_by: texture.divided_by.clone(),
        rounding: texture.rounding,
        mips: texture.mips,
        copies: filter.count_copies(&texture.name),
    };
    filter.textures.iter().map(describe).collect()
}

impl Filter {
    /// Lists the numbers of a frame that blocks, levels and divisors of the filter name, without the run of a pass. Fails for a frame
    /// that lacks one of them.
    pub fn frame_values(&self, input: &Input) -> Result<BTreeMap<String, f64>, String> {
        let frame = FrameValues::of(input, &self.convention);
        let entries = self.passes.iter().flat_map(|pass| self.stages(pass));
        let variables = entries
            .flat_map(|(shader, entry)| entry.variables.iter().map(|it| (shader, *it)))
            .flat_map(|(shader, index)| shader.list_expressions(index));
        let divisors = self.textures.iter().flat_map(|it| &it.divided_by).flatten();
        let names = variables.chain(divisors).flat_map(Expression::list_names);
        let is_parameter = |name: &str| self.parameters.iter().any(|it| it.name == name);
        let is_of_run = |name: &str| {
            let name = name.strip_prefix(FRAME_PREFIX).unwrap_or(name);
            ["iteration", "iterations"].contains(&name)
        };
        names
            .filter(|name| !is_parameter(name) && !is_of_run(name))
            .map(|name| {
                let value = frame.find(name);
                let value = value.ok_or_else(|| format!("the frame does not say {name}"));
                Ok((name.to_owned(), value?))
            })
            .collect()
    }
}
