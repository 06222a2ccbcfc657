//! Finished pictures from elsewhere, and their reader.

use std::path::Path;

use filters::Convention;
use frame::{ExrFile, Frame, Image, Plane, Truth, read_passes, read_png, scene_linear};

use crate::Error;

/// A picture from a file, converted to the truth's size and to scene-linear radiance.
pub struct FinishedPicture {
    /// Scene-linear radiance.
    pub color: Image,
    /// Mattes: each object's share of every pixel of the picture; none if the file has none.
    pub mattes: Option<Vec<Plane>>,
    /// True for a picture of displayed colours, such as a PNG: nothing in it is brighter than
    /// display white.
    pub display_referred: bool,
    /// Changes that were made to the picture, each a sentence.
    pub notes: Vec<String>,
}

/// Reads a picture that was made from `frame`, to score it against `truth`: OpenEXR or PNG, by its
/// name's ending.
///
/// Reads an OpenEXR's colours by the convention. Decodes a PNG from sRGB and undoes the frame's
/// display exposure. Crops a picture with the frame's guard band. Refuses a file that says it was
/// made for another shutter.
pub fn read_finished_picture(
    path: &Path,
    convention: &Convention,
    frame: &Frame,
    truth: &Truth,
) -> Result<FinishedPicture, Error> {
    let ending = path.extension().and_then(|ending| ending.to_str());
    let finished = match ending.map(str::to_ascii_lowercase).as_deref() {
        Some("exr") => read_radiance(path, convention, truth)?,
        Some("png") if *convention != Convention::default() => {
            return refuse(
                path,
                "is a PNG with display colours; a convention is for OpenEXR files",
            );
        }
        Some("png") => read_display_referred(path, frame.display.stops, truth)?,
        _ => {
            return refuse(
                path,
                "cannot be scored; allowed: a name that ends with .exr or .png",
            );
        }
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

fn read_radiance(
    path: &Path,
    convention: &Convention,
    truth: &Truth,
) -> Result<FinishedPicture, Error> {
    let mut file = read_passes(path)?;
    check_shutter(&file, truth)?;
    let scale = convention.color_scale.filter(|scale| *scale != 1.0);
    let scale = scale.map(|scale| format!("colours divided by color_scale = {scale}"));
    Ok(FinishedPicture {
        color: convention.read_color(&mut file)?,
        mattes: mattes(&file, truth)?,
        display_referred: false,
        notes: file.meaning.note().into_iter().chain(scale).collect(),
    })
}

fn read_display_referred(path: &Path, stops: f32, truth: &Truth) -> Result<FinishedPicture, Error> {
    let mut notes = vec![format!(
        "decoded from sRGB, and the frame's display exposure of {stops} stops undone"
    )];
    let white = (-stops).exp2();
    let truth = truth.mean().color;
    let bright = (truth.pixels.iter())
        .filter(|pixel| pixel.iter().any(|value| *value > white))
        .count();
    if bright > 0 {
        notes.push(format!(
            "a PNG ends at display white, which the truth exceeds in {:.2} % of the pixels: mse, psnr and relmse count \
             the rest as an error of the picture, flip does not",
            100.0 * bright as f64 / truth.pixels.len() as f64
        ));
    }
    Ok(FinishedPicture {
        color: scene_linear(&read_png(path)?, stops),
        mattes: None,
        display_referred: true,
        notes,
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

fn mattes(file: &ExrFile, truth: &Truth) -> Result<Option<Vec<Plane>>, Error> {
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
