//! The background and the sun of a scene.toml.

use std::path::Path;

use toml::Spanned;

use super::document::Document;
use super::environment;
use super::error::{SceneError, Slip};
use super::files::Files;
use super::schema::{BackgroundTable, SunTable};
use crate::limits::{BRIGHTEST, SMALLEST_SUN};
use crate::{Background, EnvironmentMap, Sun};

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
        (Some(constant), None, None) => Ok(Background::Constant(constant.0)),
        (None, Some(gradient), None) => Ok(Background::Gradient {
            ground: gradient.ground.0,
            horizon: gradient.horizon.0,
            zenith: gradient.zenith.0,
        }),
        (None, None, Some(image)) => {
            let map = environment::read_map(files, &folder.join(image.get_ref()))
                .map_err(|reason| document.error(image.span(), reason))?;
            if let Some(strength) = strength {
                check_strength(strength, &map).map_err(|slip| document.locate(slip))?;
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
pub(super) fn read_sun(table: &SunTable) -> Result<Sun, Slip> {
    let degrees = table.angular_radius.as_ref().map_or(0.0, |r| *r.get_ref());
    if let Some(radius) = &table.angular_radius
        && degrees != 0.0
        && !(SMALLEST_SUN..90.0).contains(&degrees)
    {
        let reason = format!(
            "the sun's angular_radius is {degrees:?} degrees; allowed: 0 (a point) and {SMALLEST_SUN} to below 90"
        );
        return Err(Slip::new(radius.span(), reason));
    }
    let sun = Sun {
        direction: table.direction.0,
        irradiance: table.irradiance.get_ref().0,
        angular_radius: degrees.to_radians(),
    };
    let brightest = sun.radiance().max_element();
    if brightest > BRIGHTEST {
        let reason = format!(
            "irradiance gives the sun's disc of {degrees} degrees a radiance of {brightest:.2e}; allowed: {BRIGHTEST:e}; \
             lower it, or give a larger angular_radius"
        );
        return Err(Slip::new(table.irradiance.span(), reason));
    }
    Ok(sun)
}

fn check_strength(strength: &Spanned<f32>, map: &EnvironmentMap) -> Result<(), Slip> {
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
    Err(Slip::new(strength.span(), reason))
}
