//! The camera of a scene.toml.

use glam::{DMat3, DQuat, DVec3};
use toml::Spanned;

use super::document::Document;
use super::error::SceneError;
use super::pose::{Pose, Rotation, interpolation, through};
use super::schema::{CameraTable, RotationTable};
use crate::limits::NARROWEST_VIEW;
use crate::{Camera, Key, Motion};

/// Where a camera looks, as written: towards a point, or by its rotation.
struct View<'a> {
    position: [f64; 3],
    look_at: &'a Option<Spanned<[f64; 3]>>,
    up: &'a Option<Spanned<[f64; 3]>>,
    rotation: &'a Option<Spanned<RotationTable>>,
    /// Where it is written.
    place: std::ops::Range<usize>,
}

pub(super) fn camera(
    document: &Document,
    table: &Spanned<CameraTable>,
) -> Result<Camera, SceneError> {
    let place = table.span();
    let table = table.get_ref();
    let mut fields_of_view = Vec::new();
    if let Some(degrees) = &table.vertical_fov {
        fields_of_view.push((0.0, field_of_view(document, degrees)?));
    }
    let interpolation = interpolation(document, "the camera", &table.interpolation, &table.keys)?;
    let motion = match (&table.keys, table.position) {
        (None, Some(position)) => {
            let view = View {
                position,
                look_at: &table.look_at,
                up: &table.up,
                rotation: &table.rotation,
                place: place.clone(),
            };
            Motion::still(Key {
                translation: DVec3::from(position),
                orientation: rotation(document, &view)?.orientation(),
                ..Key::REST
            })
        }
        (Some(keys), None)
            if table.look_at.is_none() && table.up.is_none() && table.rotation.is_none() =>
        {
            let still = !fields_of_view.is_empty();
            let mut poses = Vec::new();
            for key in keys.get_ref() {
                let time = *key.time.get_ref();
                let view = View {
                    position: key.position,
                    look_at: &key.look_at,
                    up: &key.up,
                    rotation: &key.rotation,
                    place: key.time.span(),
                };
                poses.push(Pose {
                    time,
                    translation: DVec3::from(key.position),
                    rotation: rotation(document, &view)?,
                    scale: DVec3::ONE,
                    place: key.time.span(),
                });
                if let Some(degrees) = &key.vertical_fov {
                    if still {
                        let reason = "the camera has a vertical_fov of its own and one in a key; give it once for \
                                      all, or in keys only";
                        return Err(document.error(degrees.span(), reason));
                    }
                    fields_of_view.push((time, field_of_view(document, degrees)?));
                }
            }
            through(document, "the camera", keys.span(), &poses, interpolation)?
        }
        _ => {
            let reason = "a camera needs either position with look_at or rotation, or else keys that hold them";
            return Err(document.error(place, reason));
        }
    };
    if fields_of_view.is_empty() {
        let reason = "the camera has no vertical_fov; give it in degrees, once for all or in keys";
        return Err(document.error(place, reason));
    }
    Ok(Camera {
        motion,
        vertical_fov: fields_of_view,
    })
}

fn field_of_view(document: &Document, degrees: &Spanned<f64>) -> Result<f64, SceneError> {
    let found = *degrees.get_ref();
    if (NARROWEST_VIEW..180.0).contains(&found) {
        return Ok(found.to_radians());
    }
    let reason =
        format!("vertical_fov is {found:?} degrees; allowed: {NARROWEST_VIEW} to below 180");
    Err(document.error(degrees.span(), reason))
}

fn rotation(document: &Document, view: &View) -> Result<Rotation, SceneError> {
    match (view.look_at, view.rotation) {
        (None, Some(table)) if view.up.is_none() => Rotation::read(document, table),
        (Some(target), None) => look_at(document, view, target),
        _ => {
            let reason = "a camera needs either look_at (up goes with it) or rotation";
            Err(document.error(view.place.clone(), reason))
        }
    }
}

/// The orientation that turns -Z towards the target and +Y as far up as that allows.
fn look_at(
    document: &Document,
    view: &View,
    target: &Spanned<[f64; 3]>,
) -> Result<Rotation, SceneError> {
    let Some(backward) =
        (DVec3::from(view.position) - DVec3::from(*target.get_ref())).try_normalize()
    else {
        let reason = format!(
            "the camera stands at {:?} and looks at the same point; give another look_at",
            view.position
        );
        return Err(document.error(target.span(), reason));
    };
    let (up, place) = match view.up {
        Some(up) => (*up.get_ref(), up.span()),
        None => ([0.0, 1.0, 0.0], target.span()),
    };
    // A millionth of a radian from the view the side is still sure to many digits.
    let side = DVec3::from(up)
        .try_normalize()
        .map(|up| up.cross(backward))
        .filter(|side| side.length() > 1e-6)
        .and_then(DVec3::try_normalize);
    let Some(right) = side else {
        let reason = format!(
            "the camera's up {up:?} is [0, 0, 0] or parallel to its view; give an up across the view"
        );
        return Err(document.error(place, reason));
    };
    let axes = DMat3::from_cols(right, backward.cross(right), backward);
    Ok(Rotation::Quaternion(DQuat::from_mat3(&axes)))
}
