//! The last check of what was rendered: every pixel is a finite number.

use frame::{AtInstant, Picture, Plane, Raster};

use crate::scene::Scene;
use crate::settings::{LARGEST_VALUE, TraceError};

/// Refuses a picture with a pixel that is no finite number.
pub(crate) fn check_picture(scene: &Scene, picture: &Picture) -> Result<(), TraceError> {
    check(scene, "color", &picture.color)?;
    let mut coverages = picture.coverage.iter().enumerate();
    coverages.try_for_each(|(id, plane)| check_coverage(scene, id, plane))
}

/// Refuses what was recalled of the instant where a pixel is no finite number.
pub(crate) fn check_at_instant(scene: &Scene, at_instant: &AtInstant) -> Result<(), TraceError> {
    check(scene, "frozen", &at_instant.frozen)?;
    check(scene, "offset", &at_instant.offset)?;
    check(scene, "spread", &at_instant.spread)
}

/// Refuses a layer with a pixel that is no finite number.
pub(crate) fn check<const N: usize>(
    scene: &Scene,
    layer: &str,
    raster: &Raster<[f32; N]>,
) -> Result<(), TraceError> {
    first(scene, layer, raster, |pixel| {
        // In this order NaN is the largest of all.
        let bad = |value: &f32| value.abs().total_cmp(&LARGEST_VALUE).is_gt();
        pixel.iter().copied().find(bad)
    })
}

fn check_coverage(scene: &Scene, id: usize, plane: &Plane) -> Result<(), TraceError> {
    let name = match id.checked_sub(1) {
        Some(object) => &scene.objects[object].name,
        None => "background",
    };
    first(scene, &format!("coverage.{name}"), plane, |value| {
        (!value.is_finite()).then_some(*value)
    })
}

/// An error about the first pixel that `bad` finds a value in.
fn first<T>(
    scene: &Scene,
    layer: &str,
    raster: &Raster<T>,
    bad: impl Fn(&T) -> Option<f32>,
) -> Result<(), TraceError> {
    let mut values = raster.pixels.iter().map(bad).enumerate();
    match values.find_map(|(pixel, value)| Some((pixel as u32, value?))) {
        None => Ok(()),
        Some((pixel, value)) => Err(TraceError::NotFinite {
            scene: scene.name.clone(),
            layer: layer.to_owned(),
            value,
            x: pixel % raster.width,
            y: pixel / raster.width,
        }),
    }
}
