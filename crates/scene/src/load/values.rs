//! Values of a scene.toml that check themselves as they are read: the parser adds their place.

use frame::{Alignment, Size};
use glam::{DVec3, Vec3};
use serde::Deserialize;

use crate::limits::{BRIGHTEST, NARROWEST_VIEW};
use crate::picture_size::check_size;

/// What a scene exposes, in one sentence.
#[derive(Deserialize)]
#[serde(try_from = "String")]
pub(super) struct Exposes(pub(super) String);

impl TryFrom<String> for Exposes {
    type Error = &'static str;

    fn try_from(sentence: String) -> Result<Self, Self::Error> {
        if sentence.trim().is_empty() {
            Err("exposes is empty; say in one sentence what the scene exposes")
        } else {
            Ok(Self(sentence))
        }
    }
}

/// Exposure in frames.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "f64")]
pub(super) struct Exposure(pub(super) f64);

impl TryFrom<f64> for Exposure {
    type Error = String;

    fn try_from(exposure: f64) -> Result<Self, Self::Error> {
        let shutter = Alignment::Trailing.shutter(exposure);
        shutter.map_err(|error| error.to_string())?;
        Ok(Self(exposure))
    }
}

/// Size of the picture.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "[u32; 2]")]
pub(super) struct PictureSize(pub(super) Size);

impl TryFrom<[u32; 2]> for PictureSize {
    type Error = String;

    fn try_from([width, height]: [u32; 2]) -> Result<Self, Self::Error> {
        check_size(width, height).map_err(|error| error.to_string())?;
        Ok(Self(Size { width, height }))
    }
}

/// Amount of light, which is never negative.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "[f32; 3]")]
pub(super) struct Radiance(pub(super) Vec3);

impl TryFrom<[f32; 3]> for Radiance {
    type Error = String;

    fn try_from(light: [f32; 3]) -> Result<Self, Self::Error> {
        check_radiance(light).map_err(|reason| format!("found {reason}"))?;
        Ok(Self(light.into()))
    }
}

/// Part of the light that a surface returns or lets pass.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "[f32; 3]")]
pub(super) struct Albedo(pub(super) Vec3);

impl TryFrom<[f32; 3]> for Albedo {
    type Error = String;

    fn try_from(part: [f32; 3]) -> Result<Self, Self::Error> {
        check_albedo(part).map_err(|reason| format!("found {reason}"))?;
        Ok(Self(part.into()))
    }
}

/// Opacity of a material.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "f32")]
pub(super) struct Opacity(pub(super) f32);

impl TryFrom<f32> for Opacity {
    type Error = String;

    fn try_from(opacity: f32) -> Result<Self, Self::Error> {
        if (0.0..=1.0).contains(&opacity) {
            Ok(Self(opacity))
        } else {
            Err(format!("opacity is {opacity}; allowed: 0 to 1"))
        }
    }
}

/// Direction of a length other than 0, normalised.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "[f64; 3]")]
pub(super) struct SunDirection(pub(super) DVec3);

impl TryFrom<[f64; 3]> for SunDirection {
    type Error = &'static str;

    fn try_from(direction: [f64; 3]) -> Result<Self, Self::Error> {
        let direction = DVec3::from(direction).try_normalize();
        let reason = "the sun's direction is [0, 0, 0]; give a direction towards the sun";
        direction.map(Self).ok_or(reason)
    }
}

/// Vertical field of view; degrees in the file, radians here.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "f64")]
pub(super) struct FieldOfView(pub(super) f64);

impl TryFrom<f64> for FieldOfView {
    type Error = String;

    fn try_from(degrees: f64) -> Result<Self, Self::Error> {
        if (NARROWEST_VIEW..180.0).contains(&degrees) {
            Ok(Self(degrees.to_radians()))
        } else {
            Err(format!(
                "vertical_fov is {degrees:?} degrees; allowed: {NARROWEST_VIEW} to below 180"
            ))
        }
    }
}

/// Checks an amount of light. The error is the value and what is allowed.
pub(super) fn check_radiance(value: [f32; 3]) -> Result<(), String> {
    if value.iter().all(|part| (0.0..=BRIGHTEST).contains(part)) {
        return Ok(());
    }
    Err(format!("{value:?}; allowed: 0 to {BRIGHTEST:e}"))
}

/// Checks an albedo: a surface reflects no more light than falls on it. The error is the value and what is allowed.
pub(super) fn check_albedo(value: [f32; 3]) -> Result<(), String> {
    if value.iter().all(|part| (0.0..=1.0).contains(part)) {
        return Ok(());
    }
    Err(format!("{value:?}; allowed: 0 to 1"))
}
