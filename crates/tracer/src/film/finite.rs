//! The last check of a render: every pixel is a finite number.

use frame::{AtInstant, Picture, Plane, Raster};
use scene::Scene;

use crate::error::TraceError;
use crate::limits::LARGEST_VALUE;

/// Refuses a picture with a pixel that is not a finite number.
pub(crate) fn check_picture(scene: &Scene, picture: &Picture) -> Result<(), TraceError> {
    check_layer(scene, "color", &picture.color)?;
    let mut coverages = picture.coverage.iter().enumerate();
    coverages.try_for_each(|(id, plane)| check_coverage(scene, id, plane))
}

/// Refuses layers of the instant with a pixel that is not a finite number.
pub(crate) fn check_at_instant(scene: &Scene, at_instant: &AtInstant) -> Result<(), TraceError> {
    check_layer(scene, "shift", &at_instant.shift)?;
    check_layer(scene, "offset", &at_instant.offset)?;
    check_layer(scene, "spread", &at_instant.spread)
}

/// Refuses a layer with a pixel that is not a finite number.
pub(crate) fn check_layer<const N: usize>(
    scene: &Scene,
    layer: &str,
    raster: &Raster<[f32; N]>,
) -> Result<(), TraceError> {
    check_pixels(scene, layer, raster, |pixel| {
        // In this order NaN is the largest number.
        let bad = |value: &f32| value.abs().total_cmp(&LARGEST_VALUE).is_gt();
        pixel.iter().copied().find(bad)
    })
}

fn check_coverage(scene: &Scene, id: usize, plane: &Plane) -> Result<(), TraceError> {
    let name = match id.checked_sub(1) {
        Some(object) => &scene.objects[object].name,
        None => "background",
    };
    check_pixels(scene, &format!("coverage.{name}"), plane, |value| {
        (!value.is_finite()).then_some(*value)
    })
}

/// Refuses a layer by the first pixel in which `bad` finds a value.
fn check_pixels<T>(
    scene: &Scene,
    layer: &str,
    raster: &Raster<T>,
    bad: impl Fn(&T) -> Option<f32>,
) -> Result<(), TraceError> {
    let mut values = raster.pixels.iter().map(bad).enumerate();
    match values.find_map(|(pixel, value)| Some((pixel as u32, value?))) {
        None => Ok(()),
        Some((pixel, value)) => Err(TraceError::NotFinite {
            scene: scene.id.to_string(),
            layer: layer.to_owned(),
            value,
            x: pixel % raster.width,
            y: pixel / raster.width,
        }),
    }
}
