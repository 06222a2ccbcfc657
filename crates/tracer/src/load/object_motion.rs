//! The motion of an object of a scene.toml.

use glam::DVec3;
use toml::Spanned;

use super::document::Document;
use super::error::SceneError;
use super::keyed_motion::{Pose, build_motion, read_interpolation};
use super::rotation::Rotation;
use super::schema::{ObjectTable, RotationTable, ScaleTable};
use crate::{Key, Motion};

/// Reads a still pose, or the motion through keys.
pub(super) fn read_object_motion(
    document: &Document,
    name: &str,
    object: &ObjectTable,
) -> Result<Motion, SceneError> {
    let what = format!("object \"{name}\"");
    let interpolation = read_interpolation(document, &what, &object.interpolation, &object.keys)?;
    let Some(keys) = &object.keys else {
        let translation = object.translation.as_ref();
        let translation = translation.map(|translation| DVec3::from(*translation.get_ref()));
        return Ok(Motion::still(Key {
            translation: translation.unwrap_or_default(),
            orientation: read_rotation(document, &object.rotation)?.orientation(),
            scale: read_scale(document, &object.scale)?,
            ..Key::REST
        }));
    };
    let still = object.translation.as_ref().map(Spanned::span);
    let still = still.or(object.rotation.as_ref().map(Spanned::span));
    if let Some(place) = still.or(object.scale.as_ref().map(Spanned::span)) {
        let reason = format!(
            "{what} has both keys and a still pose; write translation, rotation and scale into the keys"
        );
        return Err(document.error(place, reason));
    }
    let mut poses = Vec::new();
    for key in keys.get_ref() {
        poses.push(Pose {
            time: *key.time.get_ref(),
            translation: DVec3::from(key.translation.unwrap_or_default()),
            rotation: read_rotation(document, &key.rotation)?,
            scale: read_scale(document, &key.scale)?,
            place: key.time.span(),
        });
    }
    build_motion(document, &what, keys.span(), &poses, interpolation)
}

fn read_rotation(
    document: &Document,
    table: &Option<Spanned<RotationTable>>,
) -> Result<Rotation, SceneError> {
    match table {
        Some(table) => Rotation::read(document, table),
        None => Ok(Rotation::NONE),
    }
}

fn read_scale(
    document: &Document,
    table: &Option<Spanned<ScaleTable>>,
) -> Result<DVec3, SceneError> {
    let Some(table) = table else {
        return Ok(DVec3::ONE);
    };
    let ScaleTable(factors) = *table.get_ref();
    if factors.contains(&0.0) {
        let reason = format!("scale is {factors:?}; allowed: factors other than 0");
        return Err(document.error(table.span(), reason));
    }
    Ok(DVec3::from(factors))
}
