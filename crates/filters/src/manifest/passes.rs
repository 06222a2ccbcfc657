//! `[[texture]]` and `[[pass]]` of filter.toml.

use serde::Deserialize;
use shader_import::Stage;
use toml::Spanned;

use super::file::File;
use super::number::{IDENTIFIER, NumberEntry, NumbersEntry, is_identifier};
use super::pass_shader::{PassEntry, read_shader};
use crate::filter::{EXCLUSION, PassShader};
use crate::{Count, Expression, Filter, FilterError, Format, Holds, Pass, Rounding, Texture};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct TextureEntry {
    name: String,
    format: Format,
    divided_by: Option<NumbersEntry>,
    #[serde(default)]
    rounding: Rounding,
    #[serde(default = "one")]
    mips: u32,
    holds: Option<Holds>,
}

fn one() -> u32 {
    1
}

/// Upper limit on the dispatches of a filter, with the largest value that each `repeat` may have. A
/// GPU takes no more timestamps at once.
pub const MAX_DISPATCHES: u32 = 4095;

/// Upper limit on the mip levels of a texture: the largest has 16,384 texels on a side.
pub const MAX_MIPS: u32 = 15;

/// Variables of kernels that every filter has, or may have.
const BUILTIN_VARIABLES: [&str; 12] = [
    "color",
    "velocity",
    "depth",
    "velocity_next",
    "velocity_z",
    EXCLUSION,
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
    filter: &Filter,
) -> Result<Vec<Texture>, FilterError> {
    let mut textures = Vec::<Texture>::new();
    for spanned in entries {
        let name = &spanned.get_ref().name;
        let texture = read_texture(spanned.get_ref(), filter).and_then(|texture| {
            if textures.iter().any(|known| known.name == *name) {
                Err(" is declared twice".into())
            } else {
                Ok(texture)
            }
        });
        let refuse = |reason| file.at(spanned, format!("texture \"{name}\"{reason}"));
        textures.push(texture.map_err(refuse)?);
    }
    Ok(textures)
}

fn read_texture(entry: &TextureEntry, filter: &Filter) -> Result<Texture, String> {
    let TextureEntry {
        name, format, mips, ..
    } = entry;
    if !is_identifier(name) || BUILTIN_VARIABLES.contains(&name.as_str()) {
        let builtin = BUILTIN_VARIABLES.join(", ");
        return Err(format!(": {IDENTIFIER}, and none of {builtin}"));
    }
    if !(1..=MAX_MIPS).contains(mips) {
        return Err(format!(": mips = {mips}; allowed: from 1 to {MAX_MIPS}"));
    }
    let two_numbers = matches!(format, Format::Rg32Float | Format::Rgba32Float);
    if entry.holds.is_some() && (entry.divided_by.is_some() || !two_numbers) {
        return Err(
            ": holds = \"places\" is an x and a y per pixel; allowed with it: format rg32float or rgba32float, and no \
             divided_by"
                .into(),
        );
    }
    if entry.divided_by.is_none() && entry.rounding == Rounding::Down {
        return Err(
            ": rounding = \"down\" is for sides with a divided_by; add one, or leave it out".into(),
        );
    }
    let divided_by = entry.divided_by.as_ref();
    let divided_by = divided_by.map(|entry| read_divisors(entry.as_slice(), filter));
    Ok(Texture {
        name: name.clone(),
        format: *format,
        divided_by: (divided_by.transpose())
            .map_err(|reason| format!(": divided_by = {reason}"))?,
        rounding: entry.rounding,
        mips: *mips,
        holds: entry.holds,
    })
}

/// Reads the divisors of the image's width and height: one for both, or one each.
fn read_divisors(entries: &[NumberEntry], filter: &Filter) -> Result<[Expression; 2], String> {
    let divisors = entries.iter().map(|entry| filter.read_divisor(entry));
    match &divisors.collect::<Result<Vec<_>, _>>()?[..] {
        [both] => Ok([both.clone(), both.clone()]),
        [width, height] => Ok([width.clone(), height.clone()]),
        divisors => Err(format!(
            "a list of {}; allowed: one divisor, or two for width and height",
            divisors.len()
        )),
    }
}

/// Reads every pass.
pub(super) fn read_passes(
    file: &File,
    entries: &[Spanned<PassEntry>],
    filter: &Filter,
) -> Result<Vec<Pass>, FilterError> {
    let mut passes = Vec::new();
    let mut dispatches = 0u32;
    for spanned in entries {
        let (pass, times) = read_pass(file, spanned, filter)?;
        dispatches = dispatches.saturating_add(times);
        if dispatches > MAX_DISPATCHES {
            let reason = format!(
                "pass \"{}\": runs up to {times} times, and all passes to here {dispatches} times in sum; allowed: at most \
                 {MAX_DISPATCHES}; lower repeat, or the range of its parameter",
                pass.entry
            );
            return Err(file.at(spanned, reason));
        }
        passes.push(pass);
    }
    Ok(passes)
}

/// Reads a pass; returns its largest allowed number of runs, too.
fn read_pass(
    file: &File,
    spanned: &Spanned<PassEntry>,
    filter: &Filter,
) -> Result<(Pass, u32), FilterError> {
    let PassEntry {
        entry,
        over,
        workgroup_per_texel,
        repeat,
        ..
    } = spanned.get_ref();
    if let Some(entry) = entry {
        file.check_line(spanned, "entry", entry)?;
    }
    let shader = read_shader(file, spanned, filter)?;
    let draws = (shader.iter()).any(|shader| shader.file.stage == Stage::Fragment);
    if draws && (over.is_some() || *workgroup_per_texel) {
        let reason = "pass: over and workgroup_per_texel are for kernels; a fragment shader runs over its `targets`";
        return Err(file.at(spanned, reason.into()));
    }
    let entry = match (entry, &shader) {
        (None, None) => return Err(file.at(spanned, "missing field `entry`".into())),
        (Some(entry), None) => entry.clone(),
        (_, Some(shader)) => name_pass(shader),
    };
    let refuse = |reason: String| file.at(spanned, format!("pass \"{entry}\": {reason}"));
    match over {
        Some(over) if filter.texture(over).is_none() => {
            return Err(refuse(format!(
                "over = \"{over}\" names no declared texture; leave it out to run over the image"
            )));
        }
        None if *workgroup_per_texel => {
            return Err(refuse(
                "workgroup_per_texel = true without over; name the texture that gets one workgroup per texel".into(),
            ));
        }
        _ => {}
    }
    let repeat = repeat.clone().unwrap_or(Count::Number(1));
    let times = filter.find_largest(&repeat);
    let times = times.map_err(|reason| refuse(format!("repeat = {reason}")))?;
    let pass = Pass {
        entry,
        shaders: vec![0],
        shader,
        over: over.clone(),
        workgroup_per_texel: *workgroup_per_texel,
        repeat,
    };
    Ok((pass, times))
}

/// Names a pass with a shader of its own: after its entry point, or after its file if the entry
/// point is just `main`.
fn name_pass(shader: &PassShader) -> String {
    let stem = shader.file.path.file_stem().and_then(|stem| stem.to_str());
    match (&shader.file.entry[..], stem) {
        ("main", Some(stem)) => stem.to_owned(),
        (entry, _) => entry.to_owned(),
    }
}
