//! ColorVideoVDP (Mantiuk et al. 2024): the difference that viewers of a display would see between
//! two videos.

use colorvideovdp::{Color, Cvvdp, DisplayModel, Options};
use frame::{Image, display_srgb};

/// The display on which sequences are assumed to be shown: 24 inches, 1920x1080 pixels, seen from
/// 0.6 m. A pixel of a picture is a pixel of the display.
pub const JOD_DISPLAY: &str = "standard_fhd";

/// Computes the quality of sRGB-encoded pictures against the truth's, in JOD: 10 if no difference
/// is seen; 1 less if three of four viewers would prefer the truth. `display` is a name from the
/// reference implementation's list.
///
/// # Errors
/// The display is unknown, or the pictures are too small, too large or of two sizes.
pub fn video_jod(
    pictures: &[Image],
    truths: &[Image],
    display: &str,
    per_second: f64,
) -> Result<f64, String> {
    let convert = |images: &[Image]| -> Result<Vec<colorvideovdp::Image>, colorvideovdp::Error> {
        let images = images.iter().map(|image| {
            let values = image.pixels.as_flattened().to_vec();
            colorvideovdp::Image::new(image.width as usize, image.height as usize, 3, values)
        });
        images.collect()
    };
    let predict = || -> Result<f32, colorvideovdp::Error> {
        let display = DisplayModel::from_name(display)?;
        let metric = Cvvdp::new(display, Options::default())?;
        let (pictures, truths) = (convert(pictures)?, convert(truths)?);
        let score = metric.predict_video(&pictures, &truths, per_second as f32, Color::Srgb)?;
        Ok(score.jod)
    };
    predict().map(f64::from).map_err(|error| error.to_string())
}

/// Shows pictures as a display would, at an exposure in stops.
pub(super) fn displayed<'a>(
    pictures: impl IntoIterator<Item = &'a Image>,
    stops: f32,
) -> Vec<Image> {
    let pictures = pictures.into_iter();
    pictures
        .map(|picture| display_srgb(picture, stops))
        .collect()
}
