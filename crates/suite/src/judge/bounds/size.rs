//! The picture size that a check is made at.

use super::{Bound, SceneBounds};
use crate::{Error, FilterChoice};

/// The size that all limits on these filters hold for; `asked` where they hold for any, and none if nothing is asked either.
/// Limits for another size than asked, or for two, are refused: growth, bleed and misplacement are in pixels.
pub fn bounded_size<'a>(
    scenes: impl Iterator<Item = &'a SceneBounds>,
    filters: &[FilterChoice],
    asked: Option<(u32, u32)>,
) -> Result<Option<(u32, u32)>, Error> {
    let text = |(width, height): (u32, u32)| format!("{width}x{height}");
    let mut first: Option<(Bound, (u32, u32))> = None;
    for bounds in scenes {
        let bounds =
            (filters.iter()).flat_map(|choice| bounds.of(&choice.filter.name, &choice.preset));
        for (metric, bound) in bounds {
            let Some(size) = bound.size else { continue };
            let holds = format!(
                "{}: the limit on {metric} holds for {}",
                bound.place,
                text(size)
            );
            if let Some(asked) = asked.filter(|asked| *asked != size) {
                return Err(Error::Usage(format!(
                    "{holds}, and --size is {asked}; leave --size out, or measure limits for that size: `shuttertruth \
                     calibrate --size {asked}`",
                    asked = text(asked)
                )));
            }
            let (other, common) = first.get_or_insert_with(|| (bound.clone(), size));
            if *common != size {
                return Err(Error::Usage(format!(
                    "{holds}, that of {} for {}; check them apart, with --scenes or --filters",
                    other.place,
                    text(*common)
                )));
            }
        }
    }
    Ok(first.map(|(_, size)| size).or(asked))
}
