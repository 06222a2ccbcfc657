//! A capture's folder, converted to the convention of frames.

use std::fs;
use std::path::{Path, PathBuf};

use filters::{Convention, DepthKind, EXCLUSION, VelocityTime};
use frame::{Alignment, FAR_DEPTH, FileError, Image, Plane, Raster, Vectors};
use measure::Error;

use crate::capture::buffers::{
    COLOR_ENDINGS, Color, check_size, find_buffer, find_picture, read_color, read_depth,
    read_exclusion, read_objects, read_objects_beside_color, read_velocity, read_velocity_z,
};
use crate::capture::description::{CAPTURE_FILE, CaptureDescription};
use crate::capture::half_floats::{are_halves, rounding_of};
use crate::files::{name_of, refuse};

/// Name of the file with a capture's convention.
pub const CONVENTION_FILE: &str = "engine.toml";
/// Names and first channels of the buffers that few captures lack.
const VELOCITY: [&str; 2] = ["velocity", "velocity.X"];
const DEPTH: [&str; 2] = ["depth", "Z"];
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
    /// Buffers that it does not have: `velocity`, `depth`.
    pub lacks: Vec<&'static str>,
    /// Screen motion in pixels per frame; +x right, +y down. Zero if it has none.
    pub velocity: Vectors,
    /// The same from the instant to one frame later, if the capture has it.
    pub velocity_next: Option<Vectors>,
    /// Change of depth over the interval of `velocity`, in metres per frame; above 0 moves away.
    /// None where the capture has none.
    pub velocity_z: Option<Plane>,
    /// 1 where the blur must not change the picture, 0 elsewhere; none if the capture has no mask.
    pub exclusion: Option<Plane>,
    /// Distance along the view axis in metres; [`FAR_DEPTH`] where nothing is visible, and
    /// everywhere if it has none.
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
        let capture = Self::read_files(folder, folder, convention)?;
        // Without sub-frames there would be nothing to measure, either.
        if capture.subframes.is_empty() {
            capture.require_buffers()?;
        }
        Ok(capture)
    }

    /// Reads a frame of a sequence, whose folder describes the frames that have no `capture.toml`.
    pub fn read_of_sequence(
        folder: &Path,
        sequence: &Path,
        convention: Option<&Path>,
    ) -> Result<Self, Error> {
        let has_own = folder.join(CAPTURE_FILE).is_file();
        Self::read_files(folder, if has_own { folder } else { sequence }, convention)
    }

    fn read_files(
        folder: &Path,
        described_in: &Path,
        convention: Option<&Path>,
    ) -> Result<Self, Error> {
        let description = describe(folder, described_in)?;
        let lacks = list_lacking(folder)?;
        let convention = read_convention(folder, convention, lacks.len() < 2)?;
        let Some(color_path) = find_picture(folder, "color")? else {
            return refuse_missing(&folder.join("color.exr"), "the radiance of one instant");
        };
        let Color { image: color, note } = read_color(&color_path, &convention, &description)?;
        let mut notes: Vec<String> = note.into_iter().collect();

        let exposure = find_velocity_exposure(folder, &description, &convention)?;
        let buffers = Buffers {
            folder,
            description: &description,
            convention: &convention,
            color: &color,
        };
        let velocity = buffers.read_velocity(exposure, &mut notes)?;
        let read_next = |path: &Path| {
            let next = read_velocity(path, &description, "velocity_next")?;
            in_file(path, convention.restore_velocity(&next, exposure))
        };
        let next = ["velocity_next", "velocity_next.X"];
        let velocity_next = read_optional(folder, next, &color, read_next)?;

        let depth = buffers.read_depth(&mut notes)?;
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
            lacks,
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

    /// Refuses a capture without velocity or depth.
    pub fn require_buffers(&self) -> Result<(), Error> {
        let holds = |buffer: &&&str| match **buffer {
            "velocity" => "every pixel's motion",
            _ => "the distance of every pixel",
        };
        match self.lacks.first() {
            None => Ok(()),
            Some(lacking) => {
                let path = self.folder.join(format!("{lacking}.exr"));
                refuse_missing(&path, holds(&lacking))
            }
        }
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

/// Reads the description of a capture from its folder, or from that of its sequence.
fn describe(folder: &Path, described_in: &Path) -> Result<CaptureDescription, Error> {
    if !folder.is_dir() {
        return refuse!(
            folder,
            "there is no such folder; name one that holds an engine's capture.toml, color.exr, velocity.exr and depth.exr"
        );
    }
    CaptureDescription::read(described_in)
}

/// Lists which of velocity and depth a capture does not have.
fn list_lacking(folder: &Path) -> Result<Vec<&'static str>, Error> {
    let mut lacks = Vec::new();
    for [stem, channel] in [VELOCITY, DEPTH] {
        if find_buffer(folder, stem, channel)?.is_none() {
            lacks.push(stem);
        }
    }
    Ok(lacks)
}

/// A capture's velocity and depth, in the form of frames.
struct Buffers<'a> {
    folder: &'a Path,
    description: &'a CaptureDescription,
    convention: &'a Convention,
    color: &'a Image,
}

impl Buffers<'_> {
    /// Reads velocity; zero if the capture has none.
    fn read_velocity(&self, exposure: f64, notes: &mut Vec<String>) -> Result<Vectors, Error> {
        let Some(path) = find_buffer(self.folder, VELOCITY[0], VELOCITY[1])? else {
            return Ok(self.color.map(|_| [0.0; 2]));
        };
        let stored = read_velocity(&path, self.description, "velocity")?;
        check_size(&path, &stored, self.color)?;
        let is_half = are_halves(stored.pixels.iter().flatten().copied());
        let velocity = in_file(&path, self.convention.restore_velocity(&stored, exposure))?;
        notes.extend(is_half.then(|| velocity_note(&path, &velocity)));
        Ok(velocity)
    }

    /// Reads depth; that of the background if the capture has none.
    fn read_depth(&self, notes: &mut Vec<String>) -> Result<Plane, Error> {
        let Some(path) = find_buffer(self.folder, DEPTH[0], DEPTH[1])? else {
            return Ok(self.color.map(|_| FAR_DEPTH));
        };
        let stored = read_depth(&path, self.convention, self.description)?;
        check_size(&path, &stored, self.color)?;
        let is_half = are_halves(stored.pixels.iter().copied());
        notes.extend(
            is_half
                .then(|| depth_note(&path, self.convention))
                .flatten(),
        );
        in_file(&path, self.convention.restore_depth(&stored))
    }
}

/// Reads the convention; a capture with neither velocity nor depth need not have one.
fn read_convention(folder: &Path, path: Option<&Path>, needed: bool) -> Result<Convention, Error> {
    let default = folder.join(CONVENTION_FILE);
    if path.is_none() && !default.is_file() {
        if !needed {
            return Ok(Convention::default());
        }
        return refuse!(
            default,
            "there is no such file; it says in a table [convention] which velocity and depth the engine has; write one, or name \
             another file"
        );
    }
    let path = path.unwrap_or(&default);
    measure::read_convention(Some(path))
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
