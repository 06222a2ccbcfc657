//! `[[texture]]` and `[[pass]]` of filter.toml.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::Spanned;

use super::bindings::{BindingEntry, Names, NumberEntry};
use super::divisors::{DivisorEntry, read_divisors};
use super::file::{File, IDENTIFIER, is_identifier};
use super::parameters::check_count;
use super::pass_shader::{ShaderKeys, read_shader};
use crate::filter::{PassShader, Stage};
use crate::{
    Convention, FilterError, Format, Holds, Kind, Parameter, Pass, Repeat, Rounding, Texture,
};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TextureEntry {
    name: String,
    format: Format,
    divided_by: Option<DivisorEntry>,
    #[serde(default)]
    rounding: Rounding,
    mips: Option<u32>,
    holds: Option<Holds>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PassEntry {
    entry: Option<String>,
    over: Option<String>,
    #[serde(default)]
    workgroup_per_texel: bool,
    repeat: Option<RepeatEntry>,
    shader: Option<Spanned<String>>,
    stage: Option<Stage>,
    targets: Option<Vec<String>>,
    level: Option<NumberEntry>,
    vertex: Option<String>,
    vertex_shader: Option<Spanned<String>>,
    #[serde(default)]
    binding: Vec<Spanned<BindingEntry>>,
    #[serde(default)]
    constants: BTreeMap<String, NumberEntry>,
    #[serde(default)]
    conditions: Vec<String>,
    compiler: Option<String>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "repeat is a count from 1 or the name of an integer parameter"
)]
enum RepeatEntry {
    Times(u32),
    Parameter(String),
}

/// Upper limit on the dispatches of a filter, with the largest value that each `repeat` may have. A GPU takes no more timestamps in
/// one go.
pub const MAX_DISPATCHES: u32 = 4095;

/// Upper limit on the mip levels of a texture: the largest has 16,384 texels on a side.
pub const MAX_MIPS: u32 = 15;

/// Variables of kernels that every filter has, or may have by its `history`.
const BUILTIN_VARIABLES: [&str; 9] = [
    "color",
    "velocity",
    "depth",
    "color_before",
    "velocity_before",
    "depth_before",
    "output",
    "parameters",
    "frame",
];

/// Reads every texture.
pub(super) fn read_textures(
    file: &File,
    entries: &[Spanned<TextureEntry>],
    parameters: &[Parameter],
) -> Result<Vec<Texture>, FilterError> {
    let mut textures = Vec::<Texture>::new();
    for spanned in entries {
        let TextureEntry {
            name,
            format,
            divided_by,
            rounding,
            mips,
            holds,
        } = spanned.get_ref();
        if !is_identifier(name) || BUILTIN_VARIABLES.contains(&name.as_str()) {
            let reason = format!(
                "texture \"{name}\": {IDENTIFIER}, and none of {}",
                BUILTIN_VARIABLES.join(", ")
            );
            return Err(file.at(spanned, reason));
        }
        if textures.iter().any(|known| known.name == *name) {
            return Err(file.at(spanned, format!("texture \"{name}\" is declared twice")));
        }
        let divided_by = divided_by
            .as_ref()
            .map(|entry| read_divisors(parameters, entry))
            .transpose()
            .map_err(|reason| {
                file.at(
                    spanned,
                    format!("texture \"{name}\": divided_by = {reason}"),
                )
            })?;
        let mips = mips.unwrap_or(1);
        if !(1..=MAX_MIPS).contains(&mips) {
            let reason =
                format!("texture \"{name}\": mips = {mips}; allowed: from 1 to {MAX_MIPS}");
            return Err(file.at(spanned, reason));
        }
        let two_numbers = matches!(format, Format::Rg32Float | Format::Rgba32Float);
        if holds.is_some() && (divided_by.is_some() || !two_numbers) {
            let reason = format!(
                "texture \"{name}\": holds = \"places\" is an x and a y per pixel; allowed with it: format rg32float or \
                 rgba32float, and no divided_by"
            );
            return Err(file.at(spanned, reason));
        }
        textures.push(Texture {
            name: name.clone(),
            format: *format,
            divided_by,
            rounding: *rounding,
            mips,
            holds: *holds,
        });
    }
    Ok(textures)
}

/// Reads every pass.
pub(super) fn read_passes(
    file: &File,
    entries: &[Spanned<PassEntry>],
    textures: &[Texture],
    parameters: &[Parameter],
    convention: &Convention,
) -> Result<Vec<Pass>, FilterError> {
    let mut passes = Vec::new();
    let mut dispatches = 0u32;
    for spanned in entries {
        let PassEntry {
            entry,
            over,
            workgroup_per_texel,
            repeat,
            shader,
            stage,
            targets,
            level,
            vertex,
            vertex_shader,
            binding,
            constants,
            conditions,
            compiler,
        } = spanned.get_ref();
        if let Some(entry) = entry {
            file.check_line(spanned, "entry", entry)?;
        }
        let keys = ShaderKeys {
            file: shader.as_ref(),
            entry: entry.as_deref(),
            stage: *stage,
            targets: targets.as_ref(),
            level: level.as_ref(),
            vertex: vertex.as_deref(),
            vertex_shader: vertex_shader.as_ref(),
            bindings: binding,
            constants,
            conditions,
            compiler: compiler.as_deref(),
        };
        let names = Names {
            textures,
            parameters,
            convention,
        };
        let shader = read_shader(file, spanned, &keys, names)?;
        let draws = (shader.iter()).any(|shader| shader.stage == Stage::Fragment);
        if draws && (over.is_some() || *workgroup_per_texel) {
            let reason = "pass: over and workgroup_per_texel are for kernels; a fragment shader runs over its `targets`";
            return Err(file.at(spanned, reason.into()));
        }
        let entry = match (entry, &shader) {
            (None, None) => return Err(file.at(spanned, "missing field `entry`".into())),
            (Some(entry), None) => entry.clone(),
            (_, Some(shader)) => name_pass(shader),
        };
        let named = |reason: String| file.at(spanned, format!("pass \"{entry}\": {reason}"));
        if let Some(over) = over
            && !textures.iter().any(|texture| texture.name == *over)
        {
            return Err(named(format!(
                "over = \"{over}\" names no declared texture; leave it out to run over the image"
            )));
        }
        if *workgroup_per_texel && over.is_none() {
            return Err(named(
                "workgroup_per_texel = true without over; name the texture whose texels get a workgroup each"
                    .into(),
            ));
        }
        let repeat = match repeat {
            None => Repeat::Times(1),
            Some(RepeatEntry::Times(0)) => {
                return Err(named("repeat = 0; allowed: 1 or more".into()));
            }
            Some(RepeatEntry::Times(times)) => Repeat::Times(*times),
            Some(RepeatEntry::Parameter(parameter)) => {
                check_count(parameters, parameter)
                    .map_err(|reason| named(format!("repeat = {reason}")))?;
                Repeat::Parameter(parameter.clone())
            }
        };
        let times = most_runs(&repeat, parameters);
        dispatches = dispatches.saturating_add(times);
        if dispatches > MAX_DISPATCHES {
            return Err(named(format!(
                "runs up to {times} times, and all passes to here {dispatches} times in sum; allowed: at most \
                 {MAX_DISPATCHES}; lower repeat, or the range of its parameter"
            )));
        }
        passes.push(Pass {
            entry,
            shader_index: 0,
            vertex_index: None,
            shader,
            over: over.clone(),
            workgroup_per_texel: *workgroup_per_texel,
            repeat,
        });
    }
    Ok(passes)
}

/// Names a pass with a shader of its own: after its entry point, or after its file where that is called `main` as all are.
fn name_pass(shader: &PassShader) -> String {
    let stem = shader.file.file_stem().and_then(|stem| stem.to_str());
    match (&shader.entry[..], stem) {
        ("main", Some(stem)) => stem.to_owned(),
        (entry, _) => entry.to_owned(),
    }
}

/// Returns how often a pass runs with the largest value that is allowed.
fn most_runs(repeat: &Repeat, parameters: &[Parameter]) -> u32 {
    match repeat {
        Repeat::Times(times) => *times,
        Repeat::Parameter(name) => {
            let mut known = parameters.iter().filter(|known| known.name == *name);
            match known.next().map(|known| &known.kind) {
                Some(Kind::Integer { max, .. }) => u32::try_from(*max).unwrap_or(0),
                _ => unreachable!("the parameter was found to be an integer"),
            }
        }
    }
}
