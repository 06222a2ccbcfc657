//! The background, sun and display of a scene.toml.

use std::path::Path;

use glam::{DVec3, Vec3};
use toml::Spanned;

use super::document::Document;
use super::environment;
use super::error::SceneError;
use super::files::Files;
use super::schema::{BackgroundTable, DisplayTable, FlipTable, SunTable};
use crate::limits::{BRIGHTEST, SMALLEST_SUN};
use crate::{Background, Display, EnvironmentMap, FlipExposures, Sun};

/// Reads the background with its image, if it has one.
pub(super) fn read_background(
    document: &Document,
    files: &mut Files,
    folder: &Path,
    table: &Spanned<BackgroundTable>,
) -> Result<Background, SceneError> {
    let BackgroundTable {
        constant,
        gradient,
        image,
        strength,
        rotation,
    } = table.get_ref();
    if image.is_none() && (strength.is_some() || rotation.is_some()) {
        let reason = "strength and rotation need an image; add one: image = \"sky.exr\"";
        return Err(document.error(table.span(), reason));
    }
    match (constant, gradient, image) {
        (Some(constant), None, None) => {
            let constant = read_radiance(document, "constant", constant)?;
            Ok(Background::Constant(constant))
        }
        (None, Some(gradient), None) => Ok(Background::Gradient {
            ground: read_radiance(document, "ground", &gradient.ground)?,
            horizon: read_radiance(document, "horizon", &gradient.horizon)?,
            zenith: read_radiance(document, "zenith", &gradient.zenith)?,
        }),
        (None, None, Some(image)) => {
            let map = environment::read_map(files, &folder.join(image.get_ref()))
                .map_err(|reason| document.error(image.span(), reason))?;
            if let Some(strength) = strength {
                check_strength(document, strength, &map)?;
            }
            Ok(Background::Map(EnvironmentMap {
                strength: strength
                    .as_ref()
                    .map_or(1.0, |strength| *strength.get_ref()),
                rotation: rotation.unwrap_or(0.0).to_radians(),
                ..map
            }))
        }
        _ => {
            let reason = "a background needs one of: constant = [r, g, b], gradient = { ground, horizon, zenith }, \
                          image = \"sky.exr\"";
            Err(document.error(table.span(), reason))
        }
    }
}

/// Reads the sun.
pub(super) fn read_sun(document: &Document, table: &SunTable) -> Result<Sun, SceneError> {
    let direction = DVec3::from(*table.direction.get_ref())
        .try_normalize()
        .ok_or_else(|| {
            let reason = "the sun's direction is [0, 0, 0]; give a direction towards the sun";
            document.error(table.direction.span(), reason)
        })?;
    let irradiance = read_radiance(document, "irradiance", &table.irradiance)?;
    let degrees = table.angular_radius.as_ref().map_or(0.0, |r| *r.get_ref());
    if let Some(radius) = &table.angular_radius
        && degrees != 0.0
        && !(SMALLEST_SUN..90.0).contains(&degrees)
    {
        let reason = format!(
            "the sun's angular_radius is {degrees:?} degrees; allowed: 0 (a point) and {SMALLEST_SUN} to below 90"
        );
        return Err(document.error(radius.span(), reason));
    }
    let sun = Sun {
        direction,
        irradiance,
        angular_radius: degrees.to_radians(),
    };
    let brightest = sun.radiance().max_element();
    if brightest > BRIGHTEST {
        let reason = format!(
            "irradiance gives the sun's disc of {degrees} degrees a radiance of {brightest:.2e}; allowed: {BRIGHTEST:e}; \
             lower it, or give a larger angular_radius"
        );
        return Err(document.error(table.irradiance.span(), reason));
    }
    Ok(sun)
}

fn check_strength(
    document: &Document,
    strength: &Spanned<f32>,
    map: &EnvironmentMap,
) -> Result<(), SceneError> {
    let factor = *strength.get_ref();
    let brightest = map.texels.iter().flatten().copied().fold(0.0, f32::max);
    let reason = if factor <= 0.0 {
        format!("strength is {factor}; allowed: above 0")
    } else if factor * brightest > BRIGHTEST {
        format!(
            "strength is {factor}, and the image's brightest texel is {brightest:.2e}; allowed: a product up to \
             {BRIGHTEST:e}"
        )
    } else {
        return Ok(());
    };
    Err(document.error(strength.span(), reason))
}

/// Reads how pictures of the scene are shown.
pub(super) fn read_display(
    document: &Document,
    table: &DisplayTable,
) -> Result<Display, SceneError> {
    let mut display = Display::default();
    if let Some(stops) = &table.stops {
        display.stops = *stops.get_ref();
        (display.check_stops()).map_err(|reason| document.error(stops.span(), reason))?;
    }
    if let Some(flip) = &table.flip {
        let FlipTable { start, stop, count } = *flip.get_ref();
        display.flip = FlipExposures { start, stop, count };
        (display.flip.check()).map_err(|reason| document.error(flip.span(), reason))?;
    }
    Ok(display)
}

/// Reads an amount of light, which is never negative.
pub(super) fn read_radiance(
    document: &Document,
    what: &str,
    value: &Spanned<[f32; 3]>,
) -> Result<Vec3, SceneError> {
    check_radiance(*value.get_ref())
        .map(|()| Vec3::from(*value.get_ref()))
        .map_err(|reason| document.error(value.span(), format!("{what} {reason}")))
}

/// Reads an albedo.
pub(super) fn read_albedo(
    document: &Document,
    what: &str,
    value: &Spanned<[f32; 3]>,
) -> Result<Vec3, SceneError> {
    check_albedo(*value.get_ref())
        .map(|()| Vec3::from(*value.get_ref()))
        .map_err(|reason| document.error(value.span(), format!("{what} {reason}")))
}

/// Checks an amount of light. The error follows its name.
pub(super) fn check_radiance(value: [f32; 3]) -> Result<(), String> {
    if value.iter().all(|part| (0.0..=BRIGHTEST).contains(part)) {
        return Ok(());
    }
    Err(format!("is {value:?}; allowed: 0 to {BRIGHTEST:e}"))
}

/// Checks an albedo: a surface reflects no more light than falls on it. The error follows its name.
pub(super) fn check_albedo(value: [f32; 3]) -> Result<(), String> {
    if value.iter().all(|part| (0.0..=1.0).contains(part)) {
        return Ok(());
    }
    Err(format!("is {value:?}; allowed: 0 to 1"))
}
