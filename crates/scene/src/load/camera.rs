//! The camera of a scene.toml, and its lens.

use std::ops::Range;

use glam::{DMat3, DQuat, DVec3};
use toml::Spanned;

use super::error::Slip;
use super::keyed_motion::{Pose, build_motion, read_interpolation};
use super::rotation::Rotation;
use super::schema::{CameraKeyTable, CameraTable};
use crate::limits::{NEAREST_FOCUS, WIDEST_LENS};
use crate::{Camera, Lens};

/// Reads the camera, still or moving.
pub(super) fn read_camera(table: &Spanned<CameraTable>) -> Result<Camera, Slip> {
    let place = table.span();
    let table = table.get_ref();
    let interpolation = read_interpolation("the camera", &table.interpolation, &table.keys)?;
    let keys = read_keys(table, place.clone())?;
    let mut poses = Vec::new();
    let mut fields_of_view = Vec::new();
    if let (Some(degrees), Some(_)) = (&table.vertical_fov, &table.keys) {
        fields_of_view.push((0.0, degrees.get_ref().0));
    }
    let is_still = !fields_of_view.is_empty();
    for key in keys.get_ref() {
        let time = *key.time.get_ref();
        poses.push(Pose {
            time,
            translation: DVec3::from(key.position),
            rotation: read_view_rotation(key)?,
            scale: DVec3::ONE,
            place: key.time.span(),
        });
        if let Some(degrees) = &key.vertical_fov {
            if is_still {
                let reason =
                    "vertical_fov is given both for the camera and in a key; leave out one of them";
                return Err(Slip::new(degrees.span(), reason));
            }
            fields_of_view.push((time, degrees.get_ref().0));
        }
    }
    let motion = build_motion("the camera", keys.span(), &poses, interpolation)?;
    if fields_of_view.is_empty() {
        let reason = "the camera has no vertical_fov; give it in degrees, once or in the keys";
        return Err(Slip::new(place, reason));
    }
    Ok(Camera {
        motion,
        vertical_fov: fields_of_view,
        lens: read_lens(table)?,
    })
}

/// Returns the keys of a camera; one at time 0 for a still one.
fn read_keys(
    table: &CameraTable,
    place: Range<usize>,
) -> Result<Spanned<Vec<CameraKeyTable>>, Slip> {
    let is_turned = table.look_at.is_some() || table.up.is_some() || table.rotation.is_some();
    match (&table.keys, table.position) {
        (None, Some(position)) => {
            let key = CameraKeyTable {
                time: Spanned::new(place.clone(), 0.0),
                position,
                look_at: table.look_at.clone(),
                up: table.up.clone(),
                rotation: table.rotation,
                vertical_fov: table.vertical_fov.clone(),
            };
            Ok(Spanned::new(place, vec![key]))
        }
        (Some(keys), None) if !is_turned => Ok(keys.clone()),
        _ => {
            let reason = "a camera needs either a position with look_at or rotation, or keys that hold these";
            Err(Slip::new(place, reason))
        }
    }
}

fn read_view_rotation(key: &CameraKeyTable) -> Result<Rotation, Slip> {
    match (&key.look_at, key.rotation) {
        (None, Some(rotation)) if key.up.is_none() => Ok(rotation),
        (Some(target), None) => read_look_at(key, target),
        _ => {
            let reason = "a camera needs either look_at, with up or without, or rotation";
            Err(Slip::new(key.time.span(), reason))
        }
    }
}

/// Turns -Z towards the target and +Y as far up as that allows.
fn read_look_at(key: &CameraKeyTable, target: &Spanned<[f64; 3]>) -> Result<Rotation, Slip> {
    let Some(backward) =
        (DVec3::from(key.position) - DVec3::from(*target.get_ref())).try_normalize()
    else {
        let reason = format!(
            "the camera is at {:?} and looks at the same point; give another look_at",
            key.position
        );
        return Err(Slip::new(target.span(), reason));
    };
    let (up, place) = match &key.up {
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
        return Err(Slip::new(place, reason));
    };
    let axes = DMat3::from_cols(right, backward.cross(right), backward);
    Ok(Rotation::Quaternion(DQuat::from_mat3(&axes)))
}

/// Reads the lens; none for a pinhole.
fn read_lens(camera: &CameraTable) -> Result<Option<Lens>, Slip> {
    let refuse = |number: &Spanned<f64>, reason: String| Err(Slip::new(number.span(), reason));
    match (&camera.aperture, &camera.focus) {
        (None, None) => Ok(None),
        (Some(aperture), None) => {
            let reason = "the camera has an aperture and no focus; give the distance in metres at which it is sharp, or leave \
                          both out";
            refuse(aperture, reason.to_owned())
        }
        (None, Some(focus)) => {
            let reason = "the camera has a focus and no aperture; give the diameter of its lens in metres, or leave both out: a \
                          pinhole is sharp at all distances";
            refuse(focus, reason.to_owned())
        }
        (Some(aperture), Some(focus)) => {
            let lens = Lens {
                aperture: *aperture.get_ref(),
                focus: *focus.get_ref(),
            };
            if lens.focus < NEAREST_FOCUS {
                let distance = lens.focus;
                return refuse(
                    focus,
                    format!("focus is {distance:?} m; allowed: {NEAREST_FOCUS:e} or more"),
                );
            }
            if !(lens.aperture > 0.0 && lens.aperture <= WIDEST_LENS * lens.focus) {
                let Lens {
                    aperture: diameter,
                    focus,
                } = lens;
                let reason = format!(
                    "aperture is {diameter:?} m and focus {focus:?} m; allowed: an aperture above 0 and up to {WIDEST_LENS} times \
                     the focus; leave both out for a pinhole"
                );
                return refuse(aperture, reason);
            }
            Ok(Some(lens))
        }
    }
}
