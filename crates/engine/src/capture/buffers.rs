//! Pictures of a capture, one file each, read and checked.

use std::path::{Path, PathBuf};

use filters::{Convention, DepthKind};
use frame::{
    ExrFile, FAR_DEPTH, Image, Plane, Raster, Samples, Vectors, read_exr, read_png, scene_linear,
};
use store::printable;
use suite::{Error, SIDES};

use crate::files::refuse;

/// Largest rounding of a number beyond the range of a depth buffer.
const RANGE_ROUNDING: f32 = 1e-3;
/// Id of no object, if ids are unsigned.
const NO_OBJECT: u32 = u32::MAX;
/// Upper limit on an object's id.
const LARGEST_ID: f32 = 65535.0;

/// Finds the one file of a picture that may be OpenEXR or PNG; none if there is neither.
pub fn find_picture(folder: &Path, stem: &str) -> Result<Option<PathBuf>, Error> {
    let [exr, png] = ["exr", "png"].map(|ending| folder.join(format!("{stem}.{ending}")));
    match (exr.is_file(), png.is_file()) {
        (true, true) => refuse!(
            png,
            "is in one folder with an OpenEXR file of the same name; remove one of them"
        ),
        (true, false) => Ok(Some(exr)),
        (false, true) => Ok(Some(png)),
        (false, false) => Ok(None),
    }
}

/// Returns whether a picture is a PNG, which has 8 bits or 16, and nothing above display white.
pub fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "png")
}

/// Reads colour as scene-linear radiance. A PNG is decoded from sRGB, and the display exposure of `stops` undone.
pub fn read_color(path: &Path, convention: &Convention, stops: f32) -> Result<Image, Error> {
    let color = match is_png(path) {
        true => scene_linear(&read_png(path)?, stops),
        false => {
            let file = open(path)?;
            let names = ["R", "G", "B"];
            check_finite(&file, &names)?;
            file.color("")?
        }
    };
    check_sides(path, (color.width, color.height))?;
    Ok(convention.restore_color(&color))
}

/// Reads velocity as the engine stores it.
pub fn read_velocity(path: &Path) -> Result<Vectors, Error> {
    let file = open(path)?;
    let pairs = [["velocity.X", "velocity.Y"], ["X", "Y"], ["R", "G"]];
    let has_both = |pair: &&[&str; 2]| pair.iter().all(|name| file.has_channel(name));
    let Some(names) = pairs.iter().find(has_both) else {
        return refuse_channels(&file, "velocity.X and velocity.Y, X and Y, or R and G");
    };
    check_finite(&file, names)?;
    let [x, y] = names.map(|name| file.plane(name));
    Ok(x?.zip(&y?, |x, y| [*x, *y]))
}

/// Reads the change of depth, in metres per frame.
pub fn read_velocity_z(path: &Path) -> Result<Plane, Error> {
    let file = open(path)?;
    let name = find_channel(&file, &["velocity_z", "Z", "R"])?;
    check_finite(&file, &[name])?;
    Ok(file.plane(name)?)
}

/// Reads depth as the engine stores it; infinite linear depth becomes the background's.
pub fn read_depth(path: &Path, convention: &Convention) -> Result<Plane, Error> {
    let file = open(path)?;
    let name = find_channel(&file, &["Z", "R", "depth"])?;
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
pub fn read_objects(path: &Path) -> Result<Raster<u32>, Error> {
    let file = open(path)?;
    let names = [OBJECT_CHANNELS[0], OBJECT_CHANNELS[1], "R"];
    let name = find_channel(&file, &names)?;
    take_objects(&file, name)
}

/// Reads the object ids of a picture's file; none if it has none.
pub fn read_objects_beside_color(path: &Path) -> Result<Option<Raster<u32>>, Error> {
    if is_png(path) {
        return Ok(None);
    }
    let file = open(path)?;
    let name = OBJECT_CHANNELS.iter().find(|name| file.has_channel(name));
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

fn open(path: &Path) -> Result<ExrFile, Error> {
    let file = read_exr(path)?;
    file.expect_no_padding()?;
    Ok(file)
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

/// Finds the first of some channels in a file.
fn find_channel<'a>(file: &ExrFile, names: &[&'a str]) -> Result<&'a str, Error> {
    match names.iter().find(|name| file.has_channel(name)) {
        Some(name) => Ok(name),
        None => refuse_channels(file, &format!("one of {}", names.join(", "))),
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
fn check_finite(file: &ExrFile, names: &[&str]) -> Result<(), Error> {
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
