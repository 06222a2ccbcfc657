//! A texture of a filter as a person can look at it: `engine blur --show`.

use std::path::Path;
use terminal::refuse;

use filters::{EXCLUSION, Filter, Format};
use frame::{ExrFile, Raster, write_exr, write_png};
use measure::{Error, Runner, printable_path};

use terminal::output::print;

/// Inputs and the output, which every filter has, as its shaders see them.
const BUILT_IN: [&str; 4] = ["color", "velocity", "depth", "output"];

/// Refuses names that are no texture of a filter.
pub fn check_shown(filter: &Filter, names: &[String]) -> Result<(), Error> {
    if let (Some(_), [name, ..]) = (&filter.command, names) {
        refuse!(
            "--show {name}: {} is a program, whose textures cannot be read; leave --show out",
            filter.name
        );
    }
    let declared = filter.textures.iter().map(|texture| &texture.name[..]);
    let further = filter.further_inputs();
    let further = further.into_iter().map(|layer| layer.name());
    let known: Vec<&str> = declared.chain(BUILT_IN).chain(further).collect();
    match names.iter().find(|name| !known.contains(&&name[..])) {
        None => Ok(()),
        Some(name) => refuse!(
            "--show {name}: {} has no such texture; allowed: {}",
            filter.name,
            known.join(", ")
        ),
    }
}

/// Writes what the last run left in a texture next to `picture`: `<picture>_<name>.exr` with its
/// numbers, and a PNG from its least number (black) to its greatest (white). Prints both, with the
/// range of each component.
pub fn show_texture(
    runner: &Runner,
    filter: &Filter,
    name: &str,
    picture: &Path,
) -> Result<(), Error> {
    let Runner::Kernels(blur) = runner else {
        return Ok(());
    };
    let declared = filter.textures.iter().find(|texture| texture.name == name);
    let format = declared.map_or(Format::Rgba32Float, |texture| texture.format);
    let components = match name {
        "depth" | "velocity_z" | EXCLUSION => 1,
        "velocity" | "velocity_next" => 2,
        "color" | "output" => 3,
        _ => format.components(),
    };
    let texels = blur.read_texture(name)?;
    let texels = match format {
        Format::R32Uint => texels.map(|texel| texel.map(|value| value.to_bits() as f32)),
        _ => texels,
    };
    let stem = picture.file_stem().unwrap_or_default().to_string_lossy();
    let path = picture.with_file_name(format!("{stem}_{name}.exr"));
    let mut file = ExrFile::new(texels.width, texels.height);
    file.set("kind", "texture");
    let mut words = Vec::new();
    for (index, channel) in ["R", "G", "B", "A"]
        .into_iter()
        .take(components)
        .enumerate()
    {
        let plane = texels.map(|texel| texel[index]);
        let (least, most) = range(plane.pixels.iter().copied());
        words.push(format!("{channel} {least} to {most}"));
        file.push_plane(channel, &plane);
    }
    write_exr(&path, &file)?;
    let png = path.with_extension("png");
    write_png(&png, &display(&texels, components))?;
    for path in [&path, &png] {
        print(format!("{}\n", printable_path(path)))?;
    }
    let (width, height) = (texels.width, texels.height);
    print(format!(
        "  {name}: {width}x{height}, {}\n",
        words.join(", ")
    ))
}

/// Maps the first three components from their common range to black and white. One component is
/// grey; missing ones are black.
fn display(texels: &Raster<[f32; 4]>, components: usize) -> Raster<[f32; 3]> {
    let shown = components.min(3);
    let (least, most) = range(
        texels
            .pixels
            .iter()
            .flat_map(|texel| texel[..shown].iter().copied()),
    );
    let scale = if most > least {
        (most - least).recip()
    } else {
        0.0
    };
    texels.map(|texel| {
        let value = |index: usize| {
            if index < shown && texel[index].is_finite() {
                ((texel[index] - least) * scale).clamp(0.0, 1.0)
            } else {
                0.0
            }
        };
        match shown {
            1 => [value(0); 3],
            _ => [0, 1, 2].map(value),
        }
    })
}

/// Returns the least and the greatest finite number; zeros if there is none.
fn range(values: impl Iterator<Item = f32>) -> (f32, f32) {
    let finite = values.filter(|value| value.is_finite());
    let both = finite.map(|value| (value, value));
    let range = both.reduce(|(least, most), (value, _)| (least.min(value), most.max(value)));
    range.unwrap_or_default()
}
