//! Audit of colour, in scenes with colours independent of light.

use frame::{ColorSampling, Image};
use scene::Scene;
use tracer::TraceError;

use crate::audit::cause::Cause;
use crate::audit::clear_pixels::{ClearPixels, select_judged};
use crate::audit::defect::{Buffer, Defect, Explanation};
use crate::audit::views::render_view;
use crate::statistics::median;

/// Largest difference of an object's mean colour, relative to its brightest channel: texture
/// filters differ.
const TOLERANCE: f64 = 0.05;
/// Radiance that may be added to a correct colour: a step of 8 bits, on black.
const DARKEST: f64 = 0.002;
/// Samples per pixel of the correct colour, needed for edges within a texture and for lenses.
const SAMPLES: u32 = 16;

/// Mean colour of an object in the engine's picture, and the correct one.
struct ObjectColor {
    object: u32,
    engine: [f64; 3],
    right: [f64; 3],
}

impl ObjectColor {
    /// Returns whether the colour is correct after dividing by a factor.
    fn is_right_at(&self, scale: f64) -> bool {
        let brightest = self.right.into_iter().fold(0.0, f64::max);
        let pairs = std::iter::zip(self.engine, self.right);
        let errors = pairs.map(|(channel, right)| (channel / scale - right).abs());
        errors.fold(0.0, f64::max) <= TOLERANCE * brightest + DARKEST
    }
}

/// Compares the colour of each object with the scene's. Finds nothing in a lit scene: engines light
/// as they like.
pub fn audit_color(
    picture: &Image,
    scene: &Scene,
    regions: &[ClearPixels],
    names: &[String],
) -> Result<Vec<Defect>, TraceError> {
    if !scene.is_unlit() {
        return Ok(Vec::new());
    }
    let size = picture.size();
    let right = render_view(scene, size, SAMPLES, ColorSampling::default())?.color;
    let colors: Vec<ObjectColor> = (select_judged(regions).into_iter())
        .map(|region| ObjectColor {
            object: region.object,
            engine: mean_color(picture, &region.pixels),
            right: mean_color(&right, &region.pixels),
        })
        .collect();
    let is_wrong = |color: &&ObjectColor| !color.is_right_at(1.0);
    let wrong: Vec<&ObjectColor> = colors.iter().filter(is_wrong).collect();
    if wrong.is_empty() {
        return Ok(Vec::new());
    }
    let brightness = |color: &[f64; 3]| color.iter().sum::<f64>();
    let ratios = (wrong.iter()).map(|color| brightness(&color.engine) / brightness(&color.right));
    let scale = median(ratios);
    if scale > 0.0 && colors.iter().all(|color| color.is_right_at(scale)) {
        let cause = Explanation::by(Cause::Brightness(scale), 1.0);
        return Ok(vec![Defect::new(Buffer::Color, None, cause)]);
    }
    let findings = wrong.into_iter().map(|color| {
        let name = &names[color.object as usize];
        let cause = Explanation::by(Cause::OtherColor(color.engine, color.right), 1.0);
        Defect::new(Buffer::Color, Some(name), cause)
    });
    Ok(findings.collect())
}

fn mean_color(image: &Image, pixels: &[usize]) -> [f64; 3] {
    [0, 1, 2].map(|channel| {
        let values = pixels
            .iter()
            .map(|at| f64::from(image.pixels[*at][channel]));
        values.sum::<f64>() / pixels.len() as f64
    })
}
