//! The keys of a scene.toml. Their meaning is documented in `scenes/README.md`.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::IgnoredAny;
use toml::Spanned;

use super::display::DisplayTable;
use super::rotation::Rotation;
use super::scale::Scale;
use super::shutter::Shutter;
use super::values::{
    Albedo, Exposes, Exposure, FieldOfView, Opacity, PictureSize, Radiance, SunDirection,
};
use crate::{Family, Interpolation};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneTable {
    pub(super) exposes: Exposes,
    pub(super) family: Family,
    pub(super) exposure: Exposure,
    pub(super) size: PictureSize,
    pub(super) shutter: Option<Shutter>,
    #[serde(default)]
    pub(super) display: DisplayTable,
    pub(super) camera: Spanned<CameraTable>,
    pub(super) background: Spanned<BackgroundTable>,
    pub(super) sun: Option<SunTable>,
    #[serde(default)]
    pub(super) object: BTreeMap<Spanned<String>, ObjectTable>,
    /// Removed before the rest is read; listed here so that messages name it among the keys.
    #[serde(rename = "variant")]
    pub(super) _variant: Option<IgnoredAny>,
}

/// Keys that a variant may change. Only their check needs them.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(dead_code, reason = "reading checks them")]
pub(super) struct VariantTable {
    background: Option<BackgroundTable>,
    camera: Option<CameraTable>,
    exposure: Option<Exposure>,
    object: Option<BTreeMap<String, ObjectTable>>,
    shutter: Option<Shutter>,
    sun: Option<SunTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraTable {
    pub(super) position: Option<[f64; 3]>,
    pub(super) look_at: Option<Spanned<[f64; 3]>>,
    pub(super) up: Option<Spanned<[f64; 3]>>,
    pub(super) rotation: Option<Rotation>,
    pub(super) vertical_fov: Option<Spanned<FieldOfView>>,
    pub(super) aperture: Option<Spanned<f64>>,
    pub(super) focus: Option<Spanned<f64>>,
    pub(super) keys: Option<Spanned<Vec<CameraKeyTable>>>,
    pub(super) interpolation: Option<Spanned<Interpolation>>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CameraKeyTable {
    pub(super) time: Spanned<f64>,
    pub(super) position: [f64; 3],
    pub(super) look_at: Option<Spanned<[f64; 3]>>,
    pub(super) up: Option<Spanned<[f64; 3]>>,
    pub(super) rotation: Option<Rotation>,
    pub(super) vertical_fov: Option<Spanned<FieldOfView>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BackgroundTable {
    pub(super) constant: Option<Radiance>,
    pub(super) gradient: Option<GradientTable>,
    pub(super) image: Option<Spanned<String>>,
    pub(super) strength: Option<Spanned<f32>>,
    pub(super) rotation: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct GradientTable {
    pub(super) ground: Radiance,
    pub(super) horizon: Radiance,
    pub(super) zenith: Radiance,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SunTable {
    pub(super) direction: SunDirection,
    pub(super) irradiance: Spanned<Radiance>,
    pub(super) angular_radius: Option<Spanned<f64>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ObjectTable {
    pub(super) mesh: Option<Spanned<String>>,
    pub(super) shapes: Option<Spanned<Vec<ShapeTable>>>,
    pub(super) group: Option<Spanned<String>>,
    pub(super) parent: Option<Spanned<String>>,
    pub(super) translation: Option<Spanned<[f64; 3]>>,
    pub(super) rotation: Option<Spanned<Rotation>>,
    pub(super) scale: Option<Spanned<Scale>>,
    pub(super) keys: Option<Spanned<Vec<KeyTable>>>,
    pub(super) interpolation: Option<Spanned<Interpolation>>,
    pub(super) alpha: Option<AlphaWord>,
    pub(super) buffers: Option<Spanned<BuffersWord>>,
    #[serde(default)]
    pub(super) material: BTreeMap<Spanned<String>, MaterialTable>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ShapeTable {
    pub(super) time: Spanned<f64>,
    pub(super) mesh: Spanned<String>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct KeyTable {
    pub(super) time: Spanned<f64>,
    #[serde(default)]
    pub(super) translation: [f64; 3],
    #[serde(default)]
    pub(super) rotation: Rotation,
    #[serde(default)]
    pub(super) scale: Scale,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialTable {
    pub(super) diffuse: Option<Albedo>,
    pub(super) emission: Option<Radiance>,
    pub(super) opacity: Option<Opacity>,
    pub(super) roughness: Option<Spanned<f32>>,
    pub(super) metallic: Option<Spanned<bool>>,
    pub(super) index_of_refraction: Option<Spanned<f32>>,
    pub(super) filter: Option<Spanned<Albedo>>,
    pub(super) thin_glass: Option<Spanned<bool>>,
    pub(super) diffuse_texture: Option<Spanned<String>>,
    pub(super) emission_texture: Option<Spanned<String>>,
    pub(super) opacity_texture: Option<Spanned<String>>,
}

/// Meaning of an object's opacities.
#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum AlphaWord {
    Cutout,
    Blended,
}

/// Surfaces that the buffers show where an object is translucent.
#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum BuffersWord {
    Behind,
    Own,
}
