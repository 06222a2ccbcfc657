//! The camera of a scene.toml.

use glam::{DMat3, DQuat, DVec3};
use toml::Spanned;

use super::document::Document;
use super::error::SceneError;
use super::keyed_motion::{Pose, build_motion, read_interpolation};
use super::lens::read_lens;
use super::rotation::Rotation;
use super::schema::{CameraTable, RotationTable};
use crate::limits::NARROWEST_VIEW;
use crate::{Camera, Key, Motion};

/// View of a camera as written: towards a point, or with a rotation.
struct View<'a> {
    position: [f64; 3],
    look_at: &'a Option<Spanned<[f64; 3]>>,
    up: &'a Option<Spanned<[f64; 3]>>,
    rotation: &'a Option<Spanned<RotationTable>>,
    /// Place in the file.
    place: std::ops::Range<usize>,
}

/// Reads the camera, still or moving.
pub(super) fn read_camera(
    document: &Document,
    table: &Spanned<CameraTable>,
) -> Result<Camera, SceneError> {
    let place = table.span();
    let table = table.get_ref();
    let mut fields_of_view = Vec::new();
    if let Some(degrees) = &table.vertical_fov {
        fields_of_view.push((0.0, read_field_of_view(document, degrees)?));
    }
    let interpolation =
        read_interpolation(document, "the camera", &table.interpolation, &table.keys)?;
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
                orientation: read_view_rotation(document, &view)?.orientation(),
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
                    rotation: read_view_rotation(document, &view)?,
                    scale: DVec3::ONE,
                    place: key.time.span(),
                });
                if let Some(degrees) = &key.vertical_fov {
                    if still {
                        let reason = "vertical_fov stands both beside the keys and in a key; leave it out in one of \
                                      these places";
                        return Err(document.error(degrees.span(), reason));
                    }
                    fields_of_view.push((time, read_field_of_view(document, degrees)?));
                }
            }
            build_motion(document, "the camera", keys.span(), &poses, interpolation)?
        }
        _ => {
            let reason = "a camera needs either a position with look_at or rotation, or keys that hold these";
            return Err(document.error(place, reason));
        }
    };
    if fields_of_view.is_empty() {
        let reason = "the camera has no vertical_fov; give it in degrees, once or in the keys";
        return Err(document.error(place, reason));
    }
    Ok(Camera {
        motion,
        vertical_fov: fields_of_view,
        lens: read_lens(document, table)?,
    })
}

fn read_field_of_view(document: &Document, degrees: &Spanned<f64>) -> Result<f64, SceneError> {
    let found = *degrees.get_ref();
    if (NARROWEST_VIEW..180.0).contains(&found) {
        return Ok(found.to_radians());
    }
    let reason =
        format!("vertical_fov is {found:?} degrees; allowed: {NARROWEST_VIEW} to below 180");
    Err(document.error(degrees.span(), reason))
}

fn read_view_rotation(document: &Document, view: &View) -> Result<Rotation, SceneError> {
    match (view.look_at, view.rotation) {
        (None, Some(table)) if view.up.is_none() => Rotation::read(document, table),
        (Some(target), None) => read_look_at(document, view, target),
        _ => {
            let reason = "a camera needs either look_at, with up or without, or rotation";
            Err(document.error(view.place.clone(), reason))
        }
    }
}

/// Turns -Z towards the target and +Y as far up as that allows.
fn read_look_at(
    document: &Document,
    view: &View,
    target: &Spanned<[f64; 3]>,
) -> Result<Rotation, SceneError> {
    let Some(backward) =
        (DVec3::from(view.position) - DVec3::from(*target.get_ref())).try_normalize()
    else {
        let reason = format!(
            "the camera is at {:?} and looks at the same point; give another look_at",
            view.position
        );
        return Err(document.error(target.span(), reason));
    };
    let (up, place) = match view.up {
        Some(up) => (*up.get_ref(), up.span()),
        None => ([0.0, 1.0, 0.0], target.span()),
    };
    // An angle of 1e-6 radians still gives the side to many digits.
    let side = DVec3::from(up)
        .try_normalize()
        .map(|up| up.cross(backward))
        .filter(|side| side.length() > 1e-6)
        .and_then(DVec3::try_normalize);
    let Some(right) = side else {
        let reason = format!(
            "the camera's up {up:?} is zero or parallel to its view; give an up across the view"
        );
        return Err(document.error(place, reason));
    };
    let axes = DMat3::from_cols(right, backward.cross(right), backward);
    Ok(Rotation::Quaternion(DQuat::from_mat3(&axes)))
}
