//! Finished pictures from elsewhere, and their reader.

use std::path::Path;

use filters::Convention;
use frame::{ExrFile, Frame, Image, Plane, Truth};

use super::picture_file::{PictureKind, read_picture};
use crate::Error;

/// A picture from a file, converted to the truth's size and to scene-linear radiance.
pub struct FinishedPicture {
    /// Scene-linear radiance.
    pub color: Image,
    /// Mattes: each object's share of every pixel of the picture; none if the file has none.
    pub mattes: Option<Vec<Plane>>,
    /// True for a picture of displayed colours, a PNG or JPEG: nothing in it is brighter than
    /// display white.
    pub display_referred: bool,
    /// Changes that were made to the picture, each a sentence.
    pub notes: Vec<String>,
}

/// Reads a picture that was made from `frame`, to score it against `truth`: OpenEXR, HDR, PNG or
/// JPEG, by its name's ending.
///
/// Reads scene-linear colours by the convention. Decodes those of a display from sRGB and undoes
/// the frame's display exposure. Crops a picture with the frame's guard band. Refuses a file that
/// says it was made for another shutter.
pub fn read_finished_picture(
    path: &Path,
    convention: &Convention,
    frame: &Frame,
    truth: &Truth,
) -> Result<FinishedPicture, Error> {
    let kind = PictureKind::of(path)?;
    if kind.is_display_referred() && *convention != Convention::default() {
        return refuse(
            path,
            "has colours of a display; a convention is for scene-linear files, OpenEXR and HDR",
        );
    }
    let stops = frame.display.stops;
    let file = read_picture(path, convention, stops)?;
    let mut notes = file.notes;
    if kind.is_display_referred() {
        notes.extend(describe_display(stops, truth));
    }
    let mut mattes = None;
    if let Some(file) = &file.channels {
        check_shutter(file, truth)?;
        mattes = find_mattes(file, truth)?;
    }
    let finished = FinishedPicture {
        color: file.color,
        mattes,
        display_referred: kind.is_display_referred(),
        notes,
    };
    let band = frame.guard_band;
    let size = finished.color.size();
    if size == truth.size() {
        Ok(finished)
    } else if band > 0 && size == frame.size() {
        Ok(finished.cropped(band))
    } else {
        let reason = format!(
            "has {size} pixels, the truth has {}{}",
            truth.size(),
            match band {
                0 => String::new(),
                _ => format!(", and the frame with its guard band {}", frame.size()),
            }
        );
        refuse(path, &reason)
    }
}

/// Says how colours of a display were decoded, and what of the truth they cannot hold.
fn describe_display(stops: f32, truth: &Truth) -> Vec<String> {
    let mut notes = vec![format!(
        "decoded from sRGB, and the frame's display exposure of {stops} stops undone"
    )];
    notes.extend(bright_note(&truth.mean().color, stops, "the truth"));
    notes
}

/// Counts what is brighter than display white in a picture that one of a display is compared with;
/// none if nothing is.
pub fn bright_note(picture: &Image, stops: f32, name: &str) -> Option<String> {
    let white = (-stops).exp2();
    let is_bright = |pixel: &&[f32; 3]| pixel.iter().any(|value| *value > white);
    let bright = picture.pixels.iter().filter(is_bright).count();
    (bright > 0).then(|| {
        format!(
            "a picture of a display ends at display white, which {name} exceeds in {:.2} % of the pixels: mse, psnr and relmse \
             count the rest as an error of the picture, flip does not",
            100.0 * bright as f64 / picture.pixels.len() as f64
        )
    })
}

/// Refuses a file of `shuttertruth engine blur` that names another shutter than the truth's. In
/// other programs' files these attributes may mean something else.
fn check_shutter(file: &ExrFile, truth: &Truth) -> Result<(), Error> {
    if !file.attributes.contains_key("kind") {
        return Ok(());
    }
    let exposure = truth.shutter.exposure();
    let other = |what: &str, value: String, expected: String| {
        refuse(
            &file.path,
            &format!(
                "was made for {what} {value}, the truth has {expected}; render that one, or blur for this one"
            ),
        )
    };
    if file.attributes.contains_key("alignment") {
        let alignment: String = file.get("alignment")?;
        if alignment != truth.alignment.name() {
            return other(
                "the shutter alignment",
                alignment,
                truth.alignment.to_string(),
            );
        }
    }
    if file.attributes.contains_key("exposure") {
        let value: f64 = file.get("exposure")?;
        // Files keep the ends of the truth's interval, and their difference may round.
        if (value - exposure).abs() > 1e-9 * exposure {
            return other("an exposure of", value.to_string(), exposure.to_string());
        }
    }
    Ok(())
}

fn find_mattes(file: &ExrFile, truth: &Truth) -> Result<Option<Vec<Plane>>, Error> {
    let names: Vec<String> = (truth.objects.iter())
        .map(|object| format!("coverage.{object}"))
        .collect();
    let held = |name: &&String| (file.channels.iter()).any(|channel| channel.name == **name);
    if !names.iter().any(|name| held(&name)) {
        return Ok(None);
    }
    let planes: Result<_, _> = names.iter().map(|name| file.plane(name)).collect();
    Ok(Some(planes?))
}

impl FinishedPicture {
    fn cropped(mut self, band: u32) -> Self {
        self.color = self.color.cropped(band);
        self.mattes =
            (self.mattes).map(|mattes| mattes.iter().map(|matte| matte.cropped(band)).collect());
        self.notes.push(format!(
            "cropped by the frame's guard band of {band} pixels"
        ));
        self
    }
}

fn refuse<T>(path: &Path, reason: &str) -> Result<T, Error> {
    Err(Error::Refused(format!("{}: {reason}", path.display())))
}
