//! Pictures of a capture, one file each, read and checked.

use std::path::{Path, PathBuf};

use filters::{Convention, DepthKind};
use frame::{
    ExrFile, FAR_DEPTH, Image, Plane, Raster, Samples, Vectors, read_exr, read_png, scene_linear,
};
use store::printable;
use suite::{Error, SIDES};

use crate::capture::description::{CAPTURE_FILE, CaptureDescription};
use crate::files::refuse;

/// Largest rounding of a number beyond the range of a depth buffer.
const RANGE_ROUNDING: f32 = 1e-3;
/// Id of no object, if ids are unsigned.
const NO_OBJECT: u32 = u32::MAX;
/// Upper limit on an object's id.
const LARGEST_ID: f32 = 65535.0;

/// Place of a buffer other than colour.
pub struct BufferFile {
    /// Name of its own file, without an ending.
    pub stem: &'static str,
    /// First channel of Blender's pass, in a file of several.
    pub pass: &'static str,
}

pub const VELOCITY: BufferFile = BufferFile {
    stem: "velocity",
    pass: "Vector.X",
};
pub const DEPTH: BufferFile = BufferFile {
    stem: "depth",
    pass: "Depth.Z",
};
pub const OBJECT: BufferFile = BufferFile {
    stem: "object",
    pass: "IndexOB.X",
};
/// First channel of Blender's pass of colours.
const COMBINED: &str = "Combined.R";

/// Endings of colours' files.
pub const COLOR_ENDINGS: [&str; 3] = ["exr", "png", "raw"];
/// Endings of other buffers' files.
const BUFFER_ENDINGS: [&str; 2] = ["exr", "raw"];
/// Files that may hold several passes.
const SHARED_FILES: [&str; 2] = ["buffers.exr", "color.exr"];

/// Finds the file of a picture, whatever its ending; none if there is none.
pub fn find_picture(folder: &Path, stem: &str) -> Result<Option<PathBuf>, Error> {
    find_file(folder, stem, &COLOR_ENDINGS)
}

/// Finds the file of a buffer: its own, or one with Blender's passes. None if there is neither.
pub fn find_buffer(folder: &Path, buffer: &BufferFile) -> Result<Option<PathBuf>, Error> {
    let own = find_file(folder, buffer.stem, &BUFFER_ENDINGS)?;
    if own.is_some() {
        return Ok(own);
    }
    for path in SHARED_FILES.map(|name| folder.join(name)) {
        if path.is_file() && find_pass(&read_exr(&path)?, buffer.pass)?.is_some() {
            return Ok(Some(path));
        }
    }
    Ok(None)
}

fn find_file(folder: &Path, stem: &str, endings: &[&str]) -> Result<Option<PathBuf>, Error> {
    let paths = endings.iter().map(|it| folder.join(format!("{stem}.{it}")));
    let mut found = paths.filter(|path| path.is_file());
    match (found.next(), found.next()) {
        (Some(one), Some(other)) => refuse!(
            other,
            "is in one folder with {}; remove one of them",
            one.file_name().unwrap_or_default().display()
        ),
        (one, _) => Ok(one),
    }
}

/// Returns whether a picture is a PNG, which has 8 bits or 16, and nothing above display white.
pub fn is_png(path: &Path) -> bool {
    has_ending(path, "png")
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|own| own == ending)
}

/// Reads colour as scene-linear radiance. A PNG is decoded from sRGB, and the capture's display exposure undone.
pub fn read_color(
    path: &Path,
    convention: &Convention,
    description: &CaptureDescription,
) -> Result<Image, Error> {
    let color = match is_png(path) {
        true => scene_linear(&read_png(path)?, description.stops.unwrap_or(0.0)),
        false => {
            let file = open(path, description, "color")?;
            let pass = find_pass(&file, COMBINED)?;
            let layer = pass.map_or("", |name| &name[..name.len() - ".R".len()]);
            let names = ["R", "G", "B"].map(|name| match layer {
                "" => name.to_owned(),
                layer => format!("{layer}.{name}"),
            });
            check_finite(&file, &names)?;
            file.color(layer)?
        }
    };
    check_sides(path, (color.width, color.height))?;
    Ok(convention.restore_color(&color))
}

/// Reads velocity as the engine stores it.
pub fn read_velocity(path: &Path, description: &CaptureDescription) -> Result<Vectors, Error> {
    let file = open(path, description, VELOCITY.stem)?;
    let pass = find_pass(&file, VELOCITY.pass)?;
    let pass = pass.map(|x| [x.to_owned(), format!("{}Y", &x[..x.len() - 1])]);
    let pairs = [["velocity.X", "velocity.Y"], ["X", "Y"], ["R", "G"]];
    let pairs = pairs.map(|pair| pair.map(str::to_owned));
    let has_both = |pair: &[String; 2]| pair.iter().all(|name| file.has_channel(name));
    let Some(names) = pass.into_iter().chain(pairs).find(has_both) else {
        return refuse_channels(
            &file,
            "velocity.X and velocity.Y, X and Y, R and G, or Blender's pass Vector",
        );
    };
    check_finite(&file, &names)?;
    let [x, y] = names.map(|name| file.plane(&name));
    Ok(x?.zip(&y?, |x, y| [*x, *y]))
}

/// Reads depth as the engine stores it; infinite linear depth becomes the background's.
pub fn read_depth(
    path: &Path,
    convention: &Convention,
    description: &CaptureDescription,
) -> Result<Plane, Error> {
    let file = open(path, description, DEPTH.stem)?;
    let name = find_channel(&file, DEPTH.pass, &["Z", "R", "depth"])?;
    let depth = file.plane(name)?;
    let from_0 = -RANGE_ROUNDING..=1.0 + RANGE_ROUNDING;
    let (range, allowed) = match convention.depth {
        DepthKind::Linear => (
            f32::MIN_POSITIVE..=f32::INFINITY,
            "\"linear\" allows metres above 0",
        ),
        DepthKind::Forward => (from_0, "\"forward\" allows 0 to 1"),
        DepthKind::Reversed => (from_0, "\"reversed\" allows 0 to 1"),
        DepthKind::Ndc => (
            -1.0 - RANGE_ROUNDING..=1.0 + RANGE_ROUNDING,
            "\"ndc\" allows -1 to 1",
        ),
    };
    let allowed =
        format!("depth = {allowed}: name the depth that the engine has in its convention");
    check_values(&file, name, &depth, |depth| range.contains(depth), &allowed)?;
    Ok(match convention.depth {
        DepthKind::Linear => depth.map(|metres| metres.min(FAR_DEPTH)),
        DepthKind::Ndc => depth.map(|depth| depth.clamp(-1.0, 1.0)),
        _ => depth.map(|depth| depth.clamp(0.0, 1.0)),
    })
}

/// Names of a channel of object ids, in a file with colours or alone.
const OBJECT_CHANNELS: [&str; 2] = ["object", "object.id"];

/// Reads object ids; 0 is the background, which the file may store as 0, as -1, or as the largest unsigned integer.
pub fn read_objects(path: &Path, description: &CaptureDescription) -> Result<Raster<u32>, Error> {
    let file = open(path, description, OBJECT.stem)?;
    let names = [OBJECT_CHANNELS[0], OBJECT_CHANNELS[1], "R"];
    let name = find_channel(&file, OBJECT.pass, &names)?;
    take_objects(&file, name)
}

/// Reads the object ids of a picture's file; none if it has none.
pub fn read_objects_beside_color(path: &Path) -> Result<Option<Raster<u32>>, Error> {
    if !has_ending(path, "exr") {
        return Ok(None);
    }
    let file = read_exr(path)?;
    let pass = find_pass(&file, OBJECT.pass)?;
    let own = || {
        OBJECT_CHANNELS
            .into_iter()
            .find(|name| file.has_channel(name))
    };
    let name = pass.or_else(own);
    name.map(|name| take_objects(&file, name)).transpose()
}

fn take_objects(file: &ExrFile, name: &str) -> Result<Raster<u32>, Error> {
    let is_integer = (file.channels.iter())
        .any(|channel| channel.name == name && matches!(channel.samples, Samples::U32(_)));
    if is_integer {
        let ids = file.u32s(name)?;
        return Ok(ids.map(|id| if *id == NO_OBJECT { 0 } else { *id }));
    }
    let ids = file.plane(name)?;
    let is_id = |id: &f32| (-1.0..=LARGEST_ID).contains(id) && id.fract() == 0.0;
    let allowed = "allowed: whole numbers, 0 or -1 for the background; draw ids without blending or antialiasing";
    check_values(file, name, &ids, is_id, allowed)?;
    Ok(ids.map(|id| id.max(0.0) as u32))
}

/// Refuses a picture of another size than the colour's.
pub fn check_size<T>(path: &Path, raster: &Raster<T>, color: &Image) -> Result<(), Error> {
    match raster.same_size(color) {
        true => Ok(()),
        false => refuse!(
            path,
            "has {}x{} pixels, the colour {}x{}; all pictures of a capture have one size: save them from one camera, \
                 without scaling",
            raster.width,
            raster.height,
            color.width,
            color.height
        ),
    }
}

/// Opens the file of a buffer; its name says which layout of `capture.toml` a raw dump has.
fn open(path: &Path, description: &CaptureDescription, buffer: &str) -> Result<ExrFile, Error> {
    if has_ending(path, "raw") {
        return match description.raw.get(buffer) {
            Some(layout) => layout.read(path),
            None => refuse!(
                path,
                "is a raw dump without a layout; add [raw.{buffer}] with width, height, components and type to {CAPTURE_FILE}"
            ),
        };
    }
    let file = read_exr(path)?;
    file.expect_no_padding()?;
    Ok(file)
}

/// Finds the first channel of a pass, as Blender names it: `ViewLayer.Depth.Z`.
fn find_pass<'a>(file: &'a ExrFile, pass: &str) -> Result<Option<&'a str>, Error> {
    let is_pass = |name: &&str| {
        let layer = name.strip_suffix(pass);
        layer.is_some_and(|layer| layer.is_empty() || layer.ends_with('.'))
    };
    let names = file.channels.iter().map(|channel| channel.name.as_str());
    let mut found = names.filter(is_pass);
    match (found.next(), found.next()) {
        (Some(one), Some(other)) => refuse!(
            file.path,
            "has the channels {}; allowed: one view layer; save only the one that the capture shows",
            printable(&format!("{one} and {other}"))
        ),
        (one, _) => Ok(one),
    }
}

fn check_sides(path: &Path, (width, height): (u32, u32)) -> Result<(), Error> {
    match SIDES.contains(&width) && SIDES.contains(&height) {
        true => Ok(()),
        false => refuse!(
            path,
            "has {width}x{height} pixels; allowed: {} to {} columns and rows",
            SIDES.start(),
            SIDES.end()
        ),
    }
}

/// Finds a pass, or else the first of some channels in a file.
fn find_channel<'a>(file: &'a ExrFile, pass: &str, names: &[&'a str]) -> Result<&'a str, Error> {
    let own = || (names.iter().copied()).find(|name| file.has_channel(name));
    match find_pass(file, pass)?.or_else(own) {
        Some(name) => Ok(name),
        None => refuse_channels(file, &format!("one of {}, {pass}", names.join(", "))),
    }
}

fn refuse_channels<T>(file: &ExrFile, allowed: &str) -> Result<T, Error> {
    let names: Vec<&str> = (file.channels.iter())
        .map(|channel| channel.name.as_str())
        .collect();
    refuse!(
        file.path,
        "has the channels {}; needed: {allowed}",
        printable(&names.join(", "))
    )
}

/// Refuses a channel with NaN or infinity, and names the pixel.
fn check_finite(file: &ExrFile, names: &[String]) -> Result<(), Error> {
    let allowed = "every number must be finite: look for a division by 0 in the engine, or for a half float that overflowed";
    let mut names = names.iter();
    names.try_for_each(|name| {
        check_values(file, name, &file.plane(name)?, |it| it.is_finite(), allowed)
    })
}

/// Refuses a channel with a disallowed number, and names the pixel.
fn check_values(
    file: &ExrFile,
    name: &str,
    plane: &Plane,
    is_allowed: impl Fn(&f32) -> bool,
    allowed: &str,
) -> Result<(), Error> {
    let Some(at) = plane.pixels.iter().position(|value| !is_allowed(value)) else {
        return Ok(());
    };
    let (value, width) = (plane.pixels[at], plane.width as usize);
    let (x, y) = (at % width, at / width);
    let found = format!("channel \"{name}\" holds {value} at pixel ({x}, {y})");
    refuse!(file.path, "{found}; {allowed}")
}
