//! Pictures of a capture, one file each, read and checked.

use std::path::{Path, PathBuf};

use filters::{Convention, DepthKind, EXCLUSION};
use frame::{
    ExrFile, FAR_DEPTH, FileError, Image, Plane, Raster, Samples, Size, Vectors, read_passes,
    read_png, scene_linear,
};
use measure::{Error, SIDES, check_finite, check_values, find_channel, take_velocity};
use scene::limits::BRIGHTEST;

use crate::capture::description::{CAPTURE_FILE, CaptureDescription};
use crate::files::{name_of, refuse};

/// Largest rounding of a number beyond the range of a depth buffer.
const RANGE_ROUNDING: f32 = 1e-3;
/// Id of no object, if ids are unsigned.
const NO_OBJECT: u32 = u32::MAX;
/// Upper limit on an object's id.
const LARGEST_ID: f32 = 65535.0;

/// Endings of colours' files.
pub const COLOR_ENDINGS: [&str; 3] = ["exr", "png", "raw"];
/// Endings of other buffers' files.
const BUFFER_ENDINGS: [&str; 2] = ["exr", "raw"];
/// Files that may hold several buffers.
const SHARED_FILES: [&str; 2] = ["buffers.exr", "color.exr"];

/// Finds the file of a picture, whatever its ending; none if there is none.
pub fn find_picture(folder: &Path, stem: &str) -> Result<Option<PathBuf>, Error> {
    find_file(folder, stem, &COLOR_ENDINGS)
}

/// Finds the file of another buffer: its own, or one of several buffers that has its channel. None
/// if there is neither.
pub fn find_buffer(folder: &Path, stem: &str, channel: &str) -> Result<Option<PathBuf>, Error> {
    let file = find_file(folder, stem, &BUFFER_ENDINGS)?;
    if file.is_some() {
        return Ok(file);
    }
    let shared = SHARED_FILES.map(|name| folder.join(name));
    for path in shared.into_iter().filter(|path| path.is_file()) {
        if read_passes(&path)?.has_channel(channel) {
            return Ok(Some(path));
        }
    }
    Ok(None)
}

fn find_file(folder: &Path, stem: &str, endings: &[&str]) -> Result<Option<PathBuf>, Error> {
    let paths = endings
        .iter()
        .map(|ending| folder.join(format!("{stem}.{ending}")));
    let mut files = paths.filter(|path| path.is_file());
    match (files.next(), files.next()) {
        (Some(one), Some(other)) => refuse!(
            other,
            "is in one folder with {}; remove one of them",
            one.display()
        ),
        (one, _) => Ok(one),
    }
}

/// Returns whether a picture is a PNG, which has 8 bits or 16, and nothing above display white.
pub fn is_png(path: &Path) -> bool {
    has_ending(path, "png")
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|extension| extension == ending)
}

/// Scene-linear radiance, and what its file lost or was converted from.
pub struct Color {
    pub image: Image,
    /// A sentence; none for a file that keeps all.
    pub note: Option<String>,
}

/// Reads colour as scene-linear radiance. A PNG is decoded from sRGB, and the capture's display
/// exposure undone.
pub fn read_color(
    path: &Path,
    convention: &Convention,
    description: &CaptureDescription,
) -> Result<Color, Error> {
    let name = name_of(path);
    let color = if is_png(path) {
        let color = scene_linear(&read_png(path)?, description.stops.unwrap_or(0.0));
        let restored = convention.restore_color(&color);
        Color {
            image: restored.map_err(|reason| FileError::foreign(path, reason))?,
            note: Some(format!(
                "{name} has 8 bits per channel of a display: what is brighter than display white is lost, and dark colours come in \
                 steps; save OpenEXR for scores that can be trusted"
            )),
        }
    } else {
        let mut file = open(path, description, "color")?;
        check_finite(&file, &["R", "G", "B"])?;
        Color {
            image: convention.read_color(&mut file)?,
            note: file.meaning.note().map(|note| format!("{name}: {note}")),
        }
    };
    check_sides(path, color.image.size())?;
    check_brightness(path, &color.image)?;
    Ok(color)
}

/// Reads velocity, or `velocity_next`, as the engine stores it.
pub fn read_velocity(
    path: &Path,
    description: &CaptureDescription,
    buffer: &str,
) -> Result<Vectors, Error> {
    take_velocity(&open(path, description, buffer)?, buffer)
}

/// Reads the change of depth, in metres per frame.
pub fn read_velocity_z(path: &Path, description: &CaptureDescription) -> Result<Plane, Error> {
    let file = open(path, description, "velocity_z")?;
    let name = find_channel(&file, &["velocity_z", "Z", "R"])?;
    check_finite(&file, &[name])?;
    Ok(file.plane(name)?)
}

/// Reads the mask of what a blur leaves alone.
pub fn read_exclusion(path: &Path, description: &CaptureDescription) -> Result<Plane, Error> {
    let file = open(path, description, EXCLUSION)?;
    let name = find_channel(&file, &[EXCLUSION, "R"])?;
    let mask = file.plane(name)?;
    let is_share = |share: &f32| (0.0..=1.0).contains(share);
    let allowed = "allowed: 0 to 1; 1 where the blur must not change the picture";
    check_values(&file, name, &mask, is_share, allowed)?;
    Ok(mask)
}

/// Reads depth as the engine stores it; infinite linear depth becomes the background's.
pub fn read_depth(
    path: &Path,
    convention: &Convention,
    description: &CaptureDescription,
) -> Result<Plane, Error> {
    let file = open(path, description, "depth")?;
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

/// Reads object ids; 0 is the background, which the file may store as 0, as -1, or as the largest
/// unsigned integer.
pub fn read_objects(path: &Path, description: &CaptureDescription) -> Result<Raster<u32>, Error> {
    let file = open(path, description, "object")?;
    let names = [OBJECT_CHANNELS[0], OBJECT_CHANNELS[1], "R"];
    let name = find_channel(&file, &names)?;
    take_objects(&file, name)
}

/// Reads the object ids of a picture's file; none if it has none.
pub fn read_objects_beside_color(path: &Path) -> Result<Option<Raster<u32>>, Error> {
    if !has_ending(path, "exr") {
        return Ok(None);
    }
    let file = read_passes(path)?;
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
    if raster.same_size(color) {
        Ok(())
    } else {
        refuse!(
            path,
            "has {} pixels, the colour {}; all pictures of a capture have one size: save them from one camera, \
                 without scaling",
            raster.size(),
            color.size()
        )
    }
}

/// Opens the file of a buffer, whose name finds the layout of a raw dump in `capture.toml`.
fn open(path: &Path, description: &CaptureDescription, buffer: &str) -> Result<ExrFile, Error> {
    match (has_ending(path, "raw"), description.raw.get(buffer)) {
        (false, _) => Ok(read_passes(path)?),
        (true, Some(layout)) => layout.read(path, buffer),
        (true, None) => refuse!(
            path,
            "is a raw dump without a layout; add [raw.{buffer}] with width, height, components and type to {CAPTURE_FILE}"
        ),
    }
}

fn check_sides(path: &Path, size: Size) -> Result<(), Error> {
    if size.sides().iter().all(|side| SIDES.contains(side)) {
        Ok(())
    } else {
        refuse!(
            path,
            "has {size} pixels; allowed: {} to {} columns and rows",
            SIDES.start(),
            SIDES.end()
        )
    }
}

/// Refuses colours that no picture has.
fn check_brightness(path: &Path, color: &Image) -> Result<(), Error> {
    let is_allowed = |pixel: &[f32; 3]| pixel.iter().all(|value| value.abs() <= BRIGHTEST);
    let Some(at) = color.pixels.iter().position(|pixel| !is_allowed(pixel)) else {
        return Ok(());
    };
    let (x, y) = (at % color.width as usize, at / color.width as usize);
    refuse!(
        path,
        "has the colour {:?} at pixel ({x}, {y}); allowed: radiance up to {BRIGHTEST:e}; correct its layout, or color_scale in [convention]",
        color.pixels[at]
    )
}
