//! A capture's folder, converted to the convention of frames.

use std::fs;
use std::path::{Path, PathBuf};

use filters::{Convention, DepthKind, EXCLUSION, VelocityTime};
use frame::{Alignment, FileError, Image, Plane, Raster, Vectors};
use measure::{Error, read_text};

use crate::capture::buffers::{
    COLOR_ENDINGS, Color, check_size, find_buffer, find_picture, read_color, read_depth,
    read_exclusion, read_objects, read_objects_beside_color, read_velocity, read_velocity_z,
};
use crate::capture::description::{CAPTURE_FILE, CaptureDescription};
use crate::capture::half_floats::{are_halves, rounding_of};
use crate::files::{name_of, refuse};

/// Name of the file with a capture's convention.
pub const CONVENTION_FILE: &str = "engine.toml";
/// Name of the folder with a capture's sub-frames.
pub const SUBFRAMES: &str = "subframes";

/// An engine's pictures of one instant, and its sub-frames. All rasters have the same size.
#[derive(Clone, Debug)]
pub struct Capture {
    /// Folder of the files.
    pub folder: PathBuf,
    /// Contents of `capture.toml`.
    pub description: CaptureDescription,
    /// Form of velocity, depth and colour in the files.
    pub convention: Convention,
    /// Scene-linear radiance.
    pub color: Image,
    /// Screen motion in pixels per frame; +x right, +y down.
    pub velocity: Vectors,
    /// The same from the instant to one frame later, if the capture has it.
    pub velocity_next: Option<Vectors>,
    /// Change of depth over the interval of `velocity`, in metres per frame; above 0 moves away.
    /// None where the capture has none.
    pub velocity_z: Option<Plane>,
    /// 1 where the blur must not change the picture, 0 elsewhere; none if the capture has no mask.
    pub exclusion: Option<Plane>,
    /// Distance along the view axis in metres; [`frame::FAR_DEPTH`] where nothing is visible.
    pub depth: Plane,
    /// Object at each pixel's centre, numbered as in an exported manifest; 0 is the background.
    /// None if the capture has no ids.
    pub object_id: Option<Raster<u32>>,
    /// The engine's own blurred picture.
    pub blurred: Option<Image>,
    /// Files of the sub-frames, in order of time.
    pub subframes: Vec<PathBuf>,
    /// Notes on precision that the files lost, a sentence each.
    pub notes: Vec<String>,
}

impl Capture {
    /// Reads a capture without its sub-frames. Takes the convention from the named file, or else
    /// from `engine.toml` in the folder.
    pub fn read(folder: &Path, convention: Option<&Path>) -> Result<Self, Error> {
        if !folder.is_dir() {
            return refuse!(
                folder,
                "there is no such folder; name one that holds an engine's capture.toml, color.exr, velocity.exr and depth.exr"
            );
        }
        let description = CaptureDescription::read(folder)?;
        let convention = read_convention(folder, convention)?;
        let Some(color_path) = find_picture(folder, "color")? else {
            return refuse_missing(&folder.join("color.exr"), "the radiance of one instant");
        };
        let Color { image: color, note } = read_color(&color_path, &convention, &description)?;
        let mut notes: Vec<String> = note.into_iter().collect();

        let path = require(folder, ["velocity", "velocity.X"], "every pixel's motion")?;
        let velocity = read_velocity(&path, &description, "velocity")?;
        check_size(&path, &velocity, &color)?;
        let is_half = are_halves(velocity.pixels.iter().flatten().copied());
        let exposure = find_velocity_exposure(folder, &description, &convention)?;
        let velocity = in_file(&path, convention.restore_velocity(&velocity, exposure))?;
        notes.extend(is_half.then(|| velocity_note(&path, &velocity)));
        let read_next = |path: &Path| {
            let next = read_velocity(path, &description, "velocity_next")?;
            in_file(path, convention.restore_velocity(&next, exposure))
        };
        let next = ["velocity_next", "velocity_next.X"];
        let velocity_next = read_optional(folder, next, &color, read_next)?;

        let path = require(folder, ["depth", "Z"], "the distance of every pixel")?;
        let depth = read_depth(&path, &convention, &description)?;
        check_size(&path, &depth, &color)?;
        let is_half = are_halves(depth.pixels.iter().copied());
        notes.extend(is_half.then(|| depth_note(&path, &convention)).flatten());
        let depth = in_file(&path, convention.restore_depth(&depth))?;
        let read_z = |path: &Path| read_velocity_z(path, &description);
        let read_ids = |path: &Path| read_objects(path, &description);
        let mut blurred = None;
        if let Some(path) = find_picture(folder, "blurred")? {
            let picture = read_color(&path, &convention, &description)?;
            check_size(&path, &picture.image, &color)?;
            notes.extend(picture.note);
            blurred = Some(picture.image);
        }
        Ok(Self {
            subframes: list_subframes(folder, &color_path)?,
            velocity_z: read_optional(folder, ["velocity_z"; 2], &color, read_z)?,
            exclusion: read_mask(folder, &description, &color)?,
            object_id: read_optional(folder, ["object"; 2], &color, read_ids)?,
            folder: folder.to_owned(),
            description,
            convention,
            color,
            velocity,
            velocity_next,
            depth,
            blurred,
            notes,
        })
    }

    /// Reads one of the sub-frames as scene-linear radiance.
    pub fn read_subframe(&self, index: usize) -> Result<Image, Error> {
        let path = &self.subframes[index];
        let subframe = read_color(path, &self.convention, &self.description)?.image;
        check_size(path, &subframe, &self.color)?;
        Ok(subframe)
    }

    /// Reads the object ids of one of the sub-frames; none if its file has no such channel.
    pub fn read_subframe_objects(&self, index: usize) -> Result<Option<Raster<u32>>, Error> {
        read_objects_beside_color(&self.subframes[index])
    }

    /// Refuses another number of sub-frames than `capture.toml` says.
    pub fn check_subframes(&self) -> Result<(), Error> {
        let count = self.subframes.len();
        match self.description.subframes {
            Some(expected) if expected != count => refuse!(
                self.folder.join(SUBFRAMES),
                "holds {count} sub-frames, {CAPTURE_FILE} says {expected}; capture all of them, or correct subframes = {expected}"
            ),
            _ => Ok(()),
        }
    }

    /// Returns exposure and alignment of the shutter of the sub-frames and the blurred picture.
    ///
    /// # Errors
    /// `capture.toml` does not state them.
    pub fn shutter(&self) -> Result<(f64, Alignment), Error> {
        match (self.description.exposure, self.description.alignment) {
            (Some(exposure), Some(alignment)) => Ok((exposure, alignment)),
            (None, _) => refuse_key(&self.folder, "exposure = 0.5", "in frames"),
            (_, None) => refuse_key(
                &self.folder,
                "alignment = \"trailing\"",
                "or centred, or leading",
            ),
        }
    }
}

fn read_convention(folder: &Path, path: Option<&Path>) -> Result<Convention, Error> {
    let default = folder.join(CONVENTION_FILE);
    if path.is_none() && !default.is_file() {
        return refuse!(
            default,
            "there is no such file; it says in a table [convention] which velocity and depth the engine has; write one, or name \
             another file"
        );
    }
    let path = path.unwrap_or(&default);
    Ok(Convention::parse(path, &read_text(path)?)?)
}

/// Finds the exposure for converting velocity; any will do if velocity does not depend on it.
fn find_velocity_exposure(
    folder: &Path,
    description: &CaptureDescription,
    convention: &Convention,
) -> Result<f64, Error> {
    match (description.exposure, convention.velocity_per) {
        (Some(exposure), _) => Ok(exposure),
        (None, VelocityTime::Shutter) => refuse_key(
            folder,
            "exposure = 0.5",
            "in frames, because the convention has velocity per shutter",
        ),
        (None, _) => Ok(1.0),
    }
}

/// Finds the file of a buffer by its name, or by a channel in a file of several buffers.
fn require(folder: &Path, [stem, channel]: [&str; 2], holds: &str) -> Result<PathBuf, Error> {
    match find_buffer(folder, stem, channel)? {
        Some(path) => Ok(path),
        None => refuse_missing(&folder.join(format!("{stem}.exr")), holds),
    }
}

/// Reads the mask of what a blur leaves alone; none if the capture has none.
fn read_mask(
    folder: &Path,
    description: &CaptureDescription,
    color: &Image,
) -> Result<Option<Plane>, Error> {
    let read = |path: &Path| read_exclusion(path, description);
    read_optional(folder, [EXCLUSION; 2], color, read)
}

/// Reads a picture that a capture need not have, of the colour's size.
fn read_optional<T>(
    folder: &Path,
    [stem, channel]: [&str; 2],
    color: &Image,
    read: impl Fn(&Path) -> Result<Raster<T>, Error>,
) -> Result<Option<Raster<T>>, Error> {
    let Some(path) = find_buffer(folder, stem, channel)? else {
        return Ok(None);
    };
    let picture = read(&path)?;
    check_size(&path, &picture, color)?;
    Ok(Some(picture))
}

/// Names the file in the reason why its content was refused.
fn in_file<T>(path: &Path, content: Result<T, String>) -> Result<T, Error> {
    Ok(content.map_err(|reason| FileError::foreign(path, reason))?)
}

fn refuse_missing<T>(path: &Path, holds: &str) -> Result<T, Error> {
    refuse!(
        path,
        "there is no such file; it holds {holds}, without which no filter can blur: save that buffer from the engine"
    )
}

fn refuse_key<T>(folder: &Path, key: &str, about: &str) -> Result<T, Error> {
    refuse!(
        folder.join(CAPTURE_FILE),
        "sub-frames and blurred pictures need a shutter; add a line such as `{key}` ({about})"
    )
}

/// Lists the sub-frames by their numbers from 0; none without a folder of them.
fn list_subframes(folder: &Path, color: &Path) -> Result<Vec<PathBuf>, Error> {
    let subframe_folder = folder.join(SUBFRAMES);
    let ending = color.extension().and_then(|ending| ending.to_str());
    let ending = ending.unwrap_or_default();
    let mut paths = Vec::new();
    if subframe_folder.is_dir() {
        let fail = |source| FileError::io(&subframe_folder, "read", source);
        for entry in fs::read_dir(&subframe_folder).map_err(fail)? {
            let path = entry.map_err(fail)?.path();
            let extension = path.extension().and_then(|extension| extension.to_str());
            if let Some(extension) = extension
                .filter(|extension| *extension != ending && COLOR_ENDINGS.contains(extension))
            {
                return refuse!(
                    path,
                    "is a .{extension}, the colour a .{ending}; allowed: sub-frames in the form of the colour"
                );
            }
            paths.extend((extension == Some(ending)).then_some(path));
        }
    }
    paths.sort();
    for (index, path) in paths.iter().enumerate() {
        let expected = format!("{index:04}.{ending}");
        if !path.ends_with(&expected) {
            return refuse!(
                path,
                "expected {expected}: number sub-frames from 0000 without gaps"
            );
        }
    }
    Ok(paths)
}

fn velocity_note(path: &Path, velocity: &Vectors) -> String {
    let speeds = velocity.pixels.iter().map(|[x, y]| x.hypot(*y));
    let fastest = speeds.fold(0.0, f32::max);
    format!(
        "{} holds half floats: the fastest velocity, {fastest:.1} pixels per frame, is rounded by up to {:.4} pixels",
        name_of(path),
        rounding_of(fastest)
    )
}

/// Describes the precision that depth loses to half floats; none if that is little.
fn depth_note(path: &Path, convention: &Convention) -> Option<String> {
    let near = convention.near.unwrap_or(1.0);
    let kind = match convention.depth {
        DepthKind::Linear | DepthKind::Reversed => return None,
        DepthKind::Forward => "forward",
        DepthKind::Ndc => "ndc",
    };
    // Below 1 a half has steps of 1/2048, and all far surfaces have such a depth.
    Some(format!(
        "{} holds half floats of depth = \"{kind}\": {:.0} m and everything beyond it is off by a tenth or more; save 32 \
         bits, or reversed depth",
        name_of(path),
        0.1 * 2.0 * 2048.0 * near
    ))
}
