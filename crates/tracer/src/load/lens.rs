//! The lens of a scene.toml's camera.

use toml::Spanned;

use super::document::Document;
use super::error::SceneError;
use super::schema::CameraTable;
use crate::Lens;
use crate::limits::{NEAREST_FOCUS, WIDEST_LENS};

/// Reads the lens; none of a pinhole.
pub(super) fn read_lens(
    document: &Document,
    camera: &CameraTable,
) -> Result<Option<Lens>, SceneError> {
    let refuse = |number: &Spanned<f64>, reason: String| Err(document.error(number.span(), reason));
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
                let found = lens.focus;
                return refuse(
                    focus,
                    format!("focus is {found:?} m; allowed: {NEAREST_FOCUS:e} or more"),
                );
            }
            if !(lens.aperture > 0.0 && lens.aperture <= WIDEST_LENS * lens.focus) {
                let Lens {
                    aperture: found,
                    focus,
                } = lens;
                let reason = format!(
                    "aperture is {found:?} m and focus {focus:?} m; allowed: an aperture above 0 and up to {WIDEST_LENS} times \
                     the focus; leave both out for a pinhole"
                );
                return refuse(aperture, reason);
            }
            Ok(Some(lens))
        }
    }
}
