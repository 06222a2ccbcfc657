//! Display transform, for pictures that people look at and for LDR metrics.

use crate::exr::ExrFile;
use crate::{FileError, Image};

/// Photographic exposures for pictures and for FLIP.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Display {
    /// Exposure of PNGs and of LDR-FLIP, in stops.
    pub stops: f32,
    /// Exposures of HDR-FLIP.
    pub flip: FlipExposures,
}

/// The range of exposures that HDR-FLIP takes its maximum over.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct FlipExposures {
    /// Darkest, in stops.
    pub start: f32,
    /// Brightest, in stops.
    pub stop: f32,
    /// Number of exposures, both ends included; at least 2.
    pub count: u32,
}

impl Default for FlipExposures {
    /// Two stops either way, a step per stop.
    fn default() -> Self {
        Self {
            start: -2.0,
            stop: 2.0,
            count: 5,
        }
    }
}

/// Upper limit on the stops of a display or of FLIP, up or down. Radiance times `2^stops` stays a
/// number.
pub const MAX_STOPS: f32 = 32.0;

/// Upper limit on the exposures of HDR-FLIP.
const MAX_FLIP_EXPOSURES: u32 = 128;

/// Refuses more stops than can be shown or compared.
fn check_stops(what: &str, stops: f32) -> Result<(), String> {
    if stops.abs() <= MAX_STOPS {
        Ok(())
    } else {
        Err(format!(
            "{what} = {stops}; allowed: stops from -{MAX_STOPS} to {MAX_STOPS}"
        ))
    }
}

impl FlipExposures {
    /// Refuses too many stops, an empty range, and a count that FLIP does not accept.
    pub fn check(&self) -> Result<(), String> {
        let Self { start, stop, count } = self;
        if !(2..=MAX_FLIP_EXPOSURES).contains(count) {
            return Err(format!(
                "flip has {count} exposures; allowed: 2 to {MAX_FLIP_EXPOSURES}"
            ));
        }
        check_stops("flip start", *start)?;
        check_stops("flip stop", *stop)?;
        if start < stop {
            Ok(())
        } else {
            Err(format!(
                "flip starts at {start} and stops at {stop}; stop must be above start"
            ))
        }
    }
}

impl Display {
    /// Refuses more stops than can be shown or compared.
    pub fn check_stops(&self) -> Result<(), String> {
        check_stops("stops", self.stops)
    }

    pub(crate) fn set(&self, file: &mut ExrFile) {
        file.set("display_stops", self.stops);
        file.set("flip_start", self.flip.start);
        file.set("flip_stop", self.flip.stop);
        file.set("flip_count", self.flip.count);
    }

    pub(crate) fn from_exr(file: &ExrFile) -> Result<Self, FileError> {
        let display = Self {
            stops: file.get("display_stops")?,
            flip: FlipExposures {
                start: file.get("flip_start")?,
                stop: file.get("flip_stop")?,
                count: file.get("flip_count")?,
            },
        };
        let checked = display.check_stops().and(display.flip.check());
        checked.map_err(|reason| file.foreign(format!("display: {reason}")))?;
        Ok(display)
    }
}

/// Encodes a radiance component as an sRGB value in [0, 1]: scaled by `2^stops`, clamped, IEC
/// 61966-2-1.
fn encode_srgb(linear: f32, stops: f32) -> f32 {
    let value = (linear * stops.exp2()).clamp(0.0, 1.0);
    if value <= 0.003_130_8 {
        12.92 * value
    } else {
        1.055 * value.powf(1.0 / 2.4) - 0.055
    }
}

/// Converts an image to display values: photographic exposure of `stops`, then sRGB in [0, 1].
pub fn display_srgb(image: &Image, stops: f32) -> Image {
    image.map(|pixel| pixel.map(|component| encode_srgb(component, stops)))
}

/// Returns the luminance of a colour in linear Rec.709.
pub fn luminance([red, green, blue]: [f32; 3]) -> f32 {
    0.2126 * red + 0.7152 * green + 0.0722 * blue
}

/// Decodes an sRGB value in [0, 1] (IEC 61966-2-1).
pub fn decode_srgb(srgb: f32) -> f32 {
    if srgb <= 0.040_45 {
        srgb / 12.92
    } else {
        ((srgb + 0.055) / 1.055).powf(2.4)
    }
}

/// Converts display values in [0, 1] to a scene-linear image: decodes sRGB and undoes the
/// photographic exposure of `stops`. Radiance above display white stays at display white.
pub fn scene_linear(display: &Image, stops: f32) -> Image {
    let factor = (-stops).exp2();
    display.map(|pixel| pixel.map(|component| factor * decode_srgb(component)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radiance_that_was_shown_comes_back_but_for_what_lay_above_white() {
        for stops in [-2.0_f32, 0.0, 1.5] {
            let white = (-stops).exp2();
            for radiance in [0.0, 0.001, 0.0031308, 0.0032, 0.18, 0.999, 1.0, 3.0] {
                let radiance = radiance * white;
                let back = decode_srgb(encode_srgb(radiance, stops)) * white;
                // A power and its inverse in 32-bit floats: a few roundings, relative to white.
                let error = (back - radiance.min(white)).abs();
                assert!(error < 1e-6 * white, "{radiance} at {stops}: {back}");
            }
        }
    }
}
