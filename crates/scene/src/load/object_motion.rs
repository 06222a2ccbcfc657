//! The motion of an object of a scene.toml.

use glam::DVec3;
use toml::Spanned;

use super::error::Slip;
use super::keyed_motion::{Pose, build_motion, read_interpolation};
use super::scale::Scale;
use super::schema::ObjectTable;
use crate::{Key, Motion};

/// Reads a still pose, or the motion through keys.
pub(super) fn read_object_motion(name: &str, object: &ObjectTable) -> Result<Motion, Slip> {
    let what = format!("object \"{name}\"");
    let interpolation = read_interpolation(&what, &object.interpolation, &object.keys)?;
    let translation = object.translation.as_ref();
    let rotation = object.rotation.as_ref();
    let scale = object.scale.as_ref();
    let Some(keys) = &object.keys else {
        let translation = translation.map(|translation| DVec3::from(*translation.get_ref()));
        let rotation = rotation.map(|rotation| *rotation.get_ref());
        let Scale(scale) = scale.map(|scale| *scale.get_ref()).unwrap_or_default();
        return Ok(Motion::still(Key {
            translation: translation.unwrap_or_default(),
            orientation: rotation.unwrap_or_default().orientation(),
            scale,
            ..Key::REST
        }));
    };
    let still = (translation.map(Spanned::span)).or(rotation.map(Spanned::span));
    if let Some(place) = still.or(scale.map(Spanned::span)) {
        let reason = format!(
            "{what} has both keys and a still pose; write translation, rotation and scale into the keys"
        );
        return Err(Slip::new(place, reason));
    }
    let poses = keys.get_ref().iter().map(|key| Pose {
        time: *key.time.get_ref(),
        translation: DVec3::from(key.translation),
        rotation: key.rotation,
        scale: key.scale.0,
        place: key.time.span(),
    });
    let poses: Vec<Pose> = poses.collect();
    build_motion(&what, keys.span(), &poses, interpolation)
}
