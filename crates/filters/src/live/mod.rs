//! A filter as data for a program that runs it elsewhere, such as a page in a browser: all that `gpu` binds and dispatches.

mod bindings;
mod inputs;
mod modules;
mod passes;

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::filter::{Kind, Rounding};
use crate::gpu::{FrameValues, output_format};
use crate::load::read_text;
use crate::shader::FRAME_PREFIX;
use crate::{Expression, Filter, Format, Input, Scale, Unit, Value};
use bindings::LiveBinding;
use inputs::{LiveInput, list_inputs};
use modules::{LiveModule, list_modules};
use passes::{LivePass, find_features};

/// A filter with everything that a WebGPU device needs to run it. Places, sizes and values are those of [`Blur`](crate::Blur).
#[derive(Clone, Debug, Serialize)]
pub struct LiveFilter {
    name: String,
    /// Its WGSL file; none if its passes name their own.
    file: Option<String>,
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
    /// Divisor of the output.
    output_scale: f64,
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

impl LiveFilter {
    /// Describes a filter for pictures of a width, without their guard band; `as_written` leaves the presets' values in pixels unscaled.
    ///
    /// # Errors
    /// It is a program, WGSL cannot say what its shaders do, or its files cannot be read again: a sentence for the page's reader.
    pub fn new(filter: &Filter, width: u32, as_written: bool) -> Result<Self, String> {
        if filter.command.is_some() {
            return Err("A browser cannot run this filter: it is a program.".into());
        }
        let in_pixels = |parameter: &crate::Parameter| parameter.unit == Some(Unit::Pixels);
        let toml = read_text(filter, &filter.lines.path);
        let mut modules = list_modules(filter)?;
        let passes = (filter.passes.iter())
            .map(|pass| LivePass::new(filter, pass, &mut modules))
            .collect();
        Ok(Self {
            name: filter.name.clone(),
            file: (filter.passes.iter().any(|pass| pass.shader.is_none()))
                .then(|| format!("{}.wgsl", filter.name)),
            toml: toml.map_err(|error| error.to_string())?,
            reference_width: filter.parameters.iter().any(in_pixels).then_some(width),
            parameters: filter.parameters.iter().map(LiveParameter::new).collect(),
            presets: list_presets(filter, width, as_written),
            features: find_features(filter),
            inputs: list_inputs(filter),
            output: output_format(filter),
            output_scale: filter.convention.color_scale.unwrap_or(1.0),
            textures: list_textures(filter),
            passes,
            modules,
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
        let inputs = list_inputs(self);
        let entries = self.passes.iter().flat_map(|pass| self.stages(pass));
        let variables = entries
            .flat_map(|(shader, entry)| entry.variables.iter().map(move |it| (shader, *it)))
            .flat_map(|(shader, index)| shader.list_expressions(index));
        let levels = self.passes.iter().filter_map(|pass| pass.shader.as_ref());
        let levels = levels.filter_map(|shader| shader.level.as_ref());
        let converted = inputs.iter().flat_map(LiveInput::list_expressions);
        let divisors = self.textures.iter().flat_map(|it| &it.divided_by).flatten();
        let names = variables
            .chain(divisors)
            .chain(levels)
            .chain(converted)
            .flat_map(Expression::list_names);
        let is_parameter = |name: &str| self.parameters.iter().any(|it| it.name == name);
        let is_of_run = |name: &str| {
            let name = name.strip_prefix(FRAME_PREFIX).unwrap_or(name);
            ["iteration", "iterations", "value"].contains(&name)
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
