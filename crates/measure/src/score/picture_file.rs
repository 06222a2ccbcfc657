//! Files of pictures from elsewhere, and how their colours are read.

use std::path::Path;

use filters::Convention;
use frame::{
    ExrFile, FileError, Image, read_hdr, read_jpeg, read_passes, read_png, read_png_bits,
    scene_linear,
};

use crate::Error;

/// A kind of file that holds a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureKind {
    /// OpenEXR, scene-linear.
    OpenExr,
    /// Radiance HDR, scene-linear.
    RadianceHdr,
    /// PNG, for a display.
    Png,
    /// JPEG, for a display.
    Jpeg,
}

/// Endings of the files' names.
const ENDINGS: [(&str, PictureKind); 5] = [
    ("exr", PictureKind::OpenExr),
    ("hdr", PictureKind::RadianceHdr),
    ("png", PictureKind::Png),
    ("jpg", PictureKind::Jpeg),
    ("jpeg", PictureKind::Jpeg),
];

/// What a JPEG adds to scores.
const COMPRESSED: &str =
    "a JPEG's compression is a part of its scores; save PNG or OpenEXR to score the blur alone";

impl PictureKind {
    /// Finds the kind by the ending of the name.
    pub fn of(path: &Path) -> Result<Self, Error> {
        let ending = path.extension().and_then(|ending| ending.to_str());
        let ending = ending.map(str::to_ascii_lowercase);
        let known = ENDINGS
            .iter()
            .find(|(known, _)| Some(*known) == ending.as_deref());
        match known {
            Some((_, kind)) => Ok(*kind),
            None => Err(Error::Refused(format!(
                "{}: cannot be scored; allowed: a name that ends with .exr, .hdr, .png, .jpg or .jpeg",
                path.display()
            ))),
        }
    }

    /// Returns whether it stores colours of a display, so that nothing is brighter than display
    /// white.
    pub fn is_display_referred(self) -> bool {
        matches!(self, Self::Png | Self::Jpeg)
    }
}

/// The content of a picture's file.
pub struct PictureFile {
    /// Scene-linear radiance.
    pub color: Image,
    /// Kind of file.
    pub kind: PictureKind,
    /// How its colours were read: `8-bit PNG, read as sRGB`.
    pub reading: String,
    /// What the file lost or was converted from, each a sentence.
    pub notes: Vec<String>,
    /// All channels of an OpenEXR file.
    pub channels: Option<ExrFile>,
}

/// Reads a picture as scene-linear radiance. Colours of a display are decoded from sRGB, and its
/// exposure of `stops` undone; others are read by the convention.
pub fn read_picture(
    path: &Path,
    convention: &Convention,
    stops: f32,
) -> Result<PictureFile, Error> {
    let kind = PictureKind::of(path)?;
    if kind.is_display_referred() {
        return read_display_referred(path, kind, convention, stops);
    }
    let restore = |color: Image| {
        let restored = convention.restore_color(&color);
        restored.map_err(|reason| FileError::foreign(path, reason))
    };
    let scale = convention.color_scale.filter(|scale| *scale != 1.0);
    let scale = scale.map(|scale| format!("colours divided by color_scale = {scale}"));
    let (color, name, channels) = if kind == PictureKind::OpenExr {
        let mut file = read_passes(path)?;
        (convention.read_color(&mut file)?, "OpenEXR", Some(file))
    } else {
        (restore(read_hdr(path)?)?, "Radiance HDR", None)
    };
    let meaning = channels.as_ref().and_then(|file| file.meaning.note());
    Ok(PictureFile {
        color,
        kind,
        reading: format!("{name}, read as scene-linear Rec.709"),
        notes: meaning.into_iter().chain(scale).collect(),
        channels,
    })
}

fn read_display_referred(
    path: &Path,
    kind: PictureKind,
    convention: &Convention,
    stops: f32,
) -> Result<PictureFile, Error> {
    if convention.color_scale.is_some() {
        return Err(Error::Refused(format!(
            "{}: has colours of a display, and color_scale in [convention] is for scene-linear ones; remove it there",
            path.display()
        )));
    }
    let (values, reading, notes) = if kind == PictureKind::Jpeg {
        let notes = vec![COMPRESSED.to_owned()];
        (
            read_jpeg(path)?,
            "8-bit JPEG, read as sRGB".to_owned(),
            notes,
        )
    } else {
        let bits = read_png_bits(path)?;
        let reading = format!("{bits}-bit PNG, read as sRGB");
        (read_png(path)?, reading, Vec::new())
    };
    Ok(PictureFile {
        color: scene_linear(&values, stops),
        kind,
        reading,
        notes,
        channels: None,
    })
}
