//! Checks that inputs can be compared, before anything is computed.

use frame::{Accumulation, Frame, Ladder, MAX_STOPS, Picture, Raster, Truth};

use crate::color::flip::MAX_EXPOSURES;
use crate::{MeasureError, Viewing};

/// Upper limit on pixels: measuring more takes tens of gigabytes.
const LARGEST_PICTURE: u64 = 28_000_000;

/// Upper limit on radiance at the brightest exposure of a comparison: HDR-FLIP's tone curve squares
/// it, and the square must stay finite.
pub const BRIGHTEST: f32 = 1e18;

/// Refuses a picture whose radiance exceeds [`BRIGHTEST`] at an exposure of the comparison.
pub fn check_brightness(
    picture: &Picture,
    viewing: &Viewing,
    what: &str,
) -> Result<(), MeasureError> {
    let stops = viewing.stops.max(viewing.flip_stop).max(0.0);
    let limit = BRIGHTEST / stops.exp2();
    match find_value(&picture.color, |pixel| *pixel, |value| value.abs() > limit) {
        None => Ok(()),
        Some((found, at)) => Err(MeasureError::TooBright {
            what: what.to_owned(),
            found,
            at,
            limit,
        }),
    }
}

/// Refuses exposures of HDR-FLIP that form no range.
pub fn check_viewing(viewing: &Viewing) -> Result<(), MeasureError> {
    let Viewing {
        stops,
        flip_start: start,
        flip_stop: stop,
        flip_count: count,
    } = *viewing;
    let bounded = [stops, start, stop]
        .iter()
        .all(|stops| stops.abs() <= MAX_STOPS);
    if bounded && start <= stop && (2..=MAX_EXPOSURES).contains(&count) {
        Ok(())
    } else {
        Err(MeasureError::Exposures {
            stops,
            start,
            stop,
            count,
        })
    }
}

/// Refuses a ladder of another scene or shutter than the truth's.
pub fn check_ladder(ladder: &Ladder, truth: &Truth) -> Result<(), MeasureError> {
    agree("the ladder's object list", &ladder.objects, &truth.objects)?;
    agree("the ladder's shutter", &ladder.shutter, &truth.shutter)?;
    for rung in &ladder.rungs {
        let what = format!("rung {} of the ladder", rung.subframes);
        check_rung(rung, truth, &what)?;
    }
    Ok(())
}

/// Refuses an accumulation as [`check_picture`] refuses a picture.
pub fn check_rung(rung: &Accumulation, truth: &Truth, what: &str) -> Result<(), MeasureError> {
    let mut groups = rung.groups.iter();
    groups.try_for_each(|group| check_picture(group, truth, what))
}

/// Refuses a truth that is too large, and a frame of another scene or shutter than the truth's.
pub fn check_agreement(frame: &Frame, truth: &Truth) -> Result<(), MeasureError> {
    if truth.size().pixels() > LARGEST_PICTURE {
        return Err(MeasureError::TooLarge {
            truth: truth.size(),
            limit: LARGEST_PICTURE,
        });
    }
    agree("the frame's object list", &frame.objects, &truth.objects)?;
    // Files store the interval's ends, and their difference may round.
    let exposure = truth.shutter.exposure();
    if (frame.exposure - exposure).abs() > 1e-9 * exposure {
        agree("the frame's exposure", &frame.exposure, &exposure)?;
    }
    for (plane, what) in [
        (&frame.depth, "the frame's depth"),
        (&truth.motion, "the truth's motion"),
    ] {
        check_size(plane, truth, what)?;
        check_finite(plane, what, |value| [*value])?;
    }
    check_support(truth)?;
    check_size(&frame.object_id, truth, "the frame's object id")?;
    check_size(&frame.velocity, truth, "the frame's velocity")?;
    check_finite(&frame.velocity, "the frame's velocity", |value| *value)
}

/// Refuses a support of another size or of other objects.
fn check_support(truth: &Truth) -> Result<(), MeasureError> {
    let support = &truth.support;
    agree(
        "the truth's support: number of objects",
        &support.seen.len(),
        &truth.objects.len(),
    )?;
    let masks = support.seen.iter();
    for mask in masks.chain([&support.moving, &support.unknowable]) {
        check_size(mask, truth, "the truth's support")?;
    }
    Ok(())
}

/// Refuses a picture of another size, with missing mattes, or with values that are not finite.
pub fn check_picture(picture: &Picture, truth: &Truth, what: &str) -> Result<(), MeasureError> {
    check_size(&picture.color, truth, what)?;
    if picture.coverage.len() != truth.objects.len() {
        return Err(MeasureError::Mattes {
            what: what.to_owned(),
            found: picture.coverage.len(),
            allowed: truth.objects.len(),
        });
    }
    check_finite(&picture.color, &format!("the colour of {what}"), |pixel| {
        *pixel
    })?;
    for (matte, object) in picture.coverage.iter().zip(&truth.objects) {
        let what = format!("the matte of {object} in {what}");
        check_size(matte, truth, &what)?;
        check_finite(matte, &what, |value| [*value])?;
    }
    Ok(())
}

fn agree<T: std::fmt::Debug + PartialEq>(
    what: &'static str,
    found: &T,
    allowed: &T,
) -> Result<(), MeasureError> {
    if found == allowed {
        Ok(())
    } else {
        Err(MeasureError::Disagree {
            what,
            found: format!("{found:?}"),
            allowed: format!("{allowed:?}"),
        })
    }
}

fn check_size<T>(raster: &Raster<T>, truth: &Truth, what: &str) -> Result<(), MeasureError> {
    let (found, truth) = (raster.size(), truth.size());
    if found == truth {
        Ok(())
    } else {
        Err(MeasureError::Size {
            what: what.to_owned(),
            found,
            truth,
        })
    }
}

fn check_finite<T, const N: usize>(
    raster: &Raster<T>,
    what: &str,
    components: impl Fn(&T) -> [f32; N],
) -> Result<(), MeasureError> {
    match find_value(raster, components, |value| !value.is_finite()) {
        None => Ok(()),
        Some((found, at)) => Err(MeasureError::NotFinite {
            what: what.to_owned(),
            found,
            at,
        }),
    }
}

/// Finds the first wrong value, with its column and row.
fn find_value<T, const N: usize>(
    raster: &Raster<T>,
    components: impl Fn(&T) -> [f32; N],
    is_wrong: impl Fn(f32) -> bool,
) -> Option<(f32, (u32, u32))> {
    (0..).zip(&raster.pixels).find_map(|(index, pixel)| {
        let found = components(pixel)
            .into_iter()
            .find(|value| is_wrong(*value))?;
        Some((found, (index % raster.width, index / raster.width)))
    })
}
