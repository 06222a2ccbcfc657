//! Picture size that bounds hold for.

use suite::{Error, FilterChoice};

use crate::bounds::{Bound, SceneBounds, sized_bounds_file};

/// Returns the size that all limits on these filters hold for; `asked` if they hold for any size. Refuses limits for another size
/// than `asked`, and limits for two sizes: growth, bleed and misplacement are in pixels.
pub fn size_for_bounds<'a>(
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
                    "{holds}, and the pictures are to have {}; leave the size out, or measure limits for it with \
                     `shuttertruth limits calibrate` and put them into {} beside the scene",
                    text(asked),
                    sized_bounds_file(asked)
                )));
            }
            let (other, common) = first.get_or_insert_with(|| (bound.clone(), size));
            if *common != size {
                return Err(Error::Usage(format!(
                    "{holds}, that of {} for {}; check them apart, some of the scenes or filters at a time",
                    other.place,
                    text(*common)
                )));
            }
        }
    }
    Ok(first.map(|(_, size)| size).or(asked))
}
