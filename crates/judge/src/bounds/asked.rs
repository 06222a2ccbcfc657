//! Limits that decide how to measure scenes: size, number of frames, and ladders.

use frame::Size;
use measure::{Error, FilterChoice, Frames};
use metrics::Metric;

use crate::bounds::{Bound, Length, SceneBounds, sized_bounds_file};

/// Lists the limits on filters in some scenes.
fn list_limits<'a>(
    scenes: impl Iterator<Item = &'a SceneBounds>,
    filters: &'a [FilterChoice],
) -> impl Iterator<Item = (Metric, Bound)> {
    scenes.flat_map(|bounds| {
        let filters = filters.iter();
        filters.flat_map(|choice| bounds.of(&choice.filter.name, &choice.preset))
    })
}

/// Returns whether any of the scenes limits equivalent sub-frames of any of the filters, which
/// needs rendered ladders.
pub fn bound_subframes<'a>(
    scenes: impl Iterator<Item = &'a SceneBounds>,
    filters: &'a [FilterChoice],
) -> bool {
    list_limits(scenes, filters).any(|(metric, _)| matches!(metric, Metric::Equivalent(_)))
}

/// Returns the size that all limits on these filters are for; `asked` if they are for any size.
/// Refuses limits for another size than `asked`, and limits for two sizes, since growth, bleed and
/// misplacement are in pixels.
pub fn size_for_bounds<'a>(
    scenes: impl Iterator<Item = &'a SceneBounds>,
    filters: &'a [FilterChoice],
    asked: Option<Size>,
) -> Result<Option<Size>, Error> {
    let mut first: Option<(Bound, Size)> = None;
    for (metric, bound) in list_limits(scenes, filters) {
        let Some(size) = bound.size else { continue };
        let holds = format!("{}: the limit on {metric} holds for {size}", bound.place);
        if let Some(asked) = asked.filter(|asked| *asked != size) {
            return Err(Error::Refused(format!(
                "{holds}, and the pictures are to have {asked}; leave the size out, or measure limits for it with \
                 `shuttertruth limits calibrate` and put them into {} beside the scene",
                sized_bounds_file(asked)
            )));
        }
        let (other, common) = first.get_or_insert_with(|| (bound.clone(), size));
        if *common != size {
            return Err(Error::Refused(format!(
                "{holds}, that of {} for {common}; check them apart, some of the scenes or filters at a time",
                other.place
            )));
        }
    }
    Ok(first.map(|(_, size)| size).or(asked))
}

/// Refuses limits on these filters for another sequence length than requested. For single frames,
/// ignores limits on sequences, which nothing judges then.
pub fn check_lengths<'a>(
    scenes: impl Iterator<Item = &'a SceneBounds>,
    filters: &'a [FilterChoice],
    frames: Frames,
) -> Result<(), Error> {
    let mut limits = list_limits(scenes, filters).filter(|_| !frames.is_one());
    let other = limits.find_map(|(metric, bound)| {
        let length = bound.length.filter(|length| !length.holds_for(frames))?;
        Some((metric, bound.place, length))
    });
    let Some((metric, place, length)) = other else {
        return Ok(());
    };
    let asked = Length {
        per_second: length.per_second.map(|_| frames.per_second),
        frames: frames.count,
    };
    Err(Error::Refused(format!(
        "{place}: the limit on {metric} holds for sequences of {}, and they are to have {}; measure as many as it holds for, or \
         measure a limit for the others with `shuttertruth limits calibrate`",
        length.text(),
        asked.text()
    )))
}
