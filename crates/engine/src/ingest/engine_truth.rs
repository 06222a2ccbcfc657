//! The truth of an engine's sub-frames: their mean, its noise, and the ladder of means of fewer of
//! them.

use frame::{
    Accumulation, Alignment, AtInstant, Ladder, Picture, Plane, Provenance, Raster, Replicate,
    Shutter, ShutterProfile, Size, Support, Truth,
};
use measure::{Error, LADDER, mark_reached};
use tracer::{Progress, Watch};

use crate::capture::description::CAPTURE_FILE;
use crate::capture::folder::{Capture, SUBFRAMES};
use crate::ingest::moving::ColorRange;
use crate::ingest::objects::draw_coverage;

/// Smallest number of sub-frames.
const MIN_SUBFRAMES: usize = 4;
/// Upper limit on sub-frames.
const MAX_SUBFRAMES: usize = 4096;
/// Halves of the truth, from alternate sub-frames.
const HALVES: usize = 2;
/// Smallest ratio of the truth's sub-frames to those of an accumulation that is compared with the
/// truth: a mean of nearly as many would share the truth's errors.
const TRUTH_PER_MEAN: usize = 4;
/// Provenance of pictures that were not traced.
pub(super) const NOT_TRACED: &str = "none";

/// The pictures of the two halves.
type Halves = [Picture; HALVES];

/// A truth and its ladder.
pub struct EngineTruth {
    pub truth: Truth,
    pub ladder: Ladder,
    /// Part of the pixels that change between sub-frames although no velocity reaches them.
    pub restless: f64,
}

/// Averages the sub-frames of a capture, if it has any: even ones into one half of the truth, odd
/// ones into the other.
pub fn average_subframes(
    capture: &Capture,
    shutter: Shutter,
    alignment: Alignment,
    objects: &[String],
    provenance: &Provenance,
    watch: Watch,
) -> Result<Option<EngineTruth>, Error> {
    if capture.subframes.is_empty() {
        return Ok(None);
    }
    check_count(capture)?;
    let (mut means, range) = read_subframes(capture, objects.len(), watch)?;
    let halves = means.remove(0).1;
    let rungs = subtract_truth(&means, &halves);
    let changed = range.mark_changed();
    let reached = mark_reached(&capture.velocity, shutter);
    let restless = changed.zip(&reached, |changed, reached| *changed && !reached);
    let moving = changed.zip(&reached, |changed, reached| *changed || *reached);
    let support = make_support(&halves, moving);
    let (width, height) = (capture.color.width, capture.color.height);
    let each = (capture.subframes.len() / HALVES) as u32;
    let replicates: Vec<Replicate> = (0..)
        .zip(halves)
        .map(|(index, picture)| Replicate {
            provenance: Provenance {
                samples_per_pixel: each,
                replicates: 1,
                ..provenance.clone()
            },
            index,
            shutter,
            shutter_profile: ShutterProfile::default(),
            alignment,
            objects: objects.to_owned(),
            moving: find_movers(&support),
            picture,
            at_instant: AtInstant::unknown(width, height),
            samples: Plane::filled(width, height, each as f32),
            support: support.clone(),
        })
        .collect();
    Ok(Some(EngineTruth {
        truth: Truth::of(&replicates)?,
        restless: part_of(&restless),
        ladder: Ladder {
            provenance: provenance.clone(),
            shutter,
            shutter_profile: ShutterProfile::default(),
            alignment,
            objects: objects.to_owned(),
            rungs,
        },
    }))
}

/// Marks what the open shutter saw of each object, in pixels where anything moves or not.
fn make_support(halves: &Halves, moving: Raster<bool>) -> Support {
    Support {
        seen: (Picture::mean(halves).coverage.iter())
            .map(|coverage| coverage.map(|share| *share > 0.0))
            .collect(),
        unknowable: moving.map(|_| false),
        moving,
    }
}

/// Makes the rungs of the ladder from the halves of means of sub-frames, each less its own half of
/// the truth.
fn subtract_truth(means: &[(u32, Halves)], truth: &Halves) -> Vec<Accumulation> {
    let rung = |(subframes, halves): &(u32, Halves)| Accumulation {
        subframes: *subframes,
        groups: (halves.iter().zip(truth))
            .map(|(half, truth)| half.minus(truth))
            .collect(),
    };
    means.iter().map(rung).collect()
}

/// Refuses numbers of sub-frames that make no truth with two halves.
fn check_count(capture: &Capture) -> Result<(), Error> {
    let count = capture.subframes.len();
    check_subframe_count(count).map_err(|allowed| {
        Error::Refused(format!(
            "{}: holds {count} sub-frames; allowed: {allowed}, at the midpoints of equal parts of the shutter that {CAPTURE_FILE} \
             names: half of them show the noise of the others; capture 32, for instance",
            capture.folder.join(SUBFRAMES).display()
        ))
    })
}

/// Checks a number of sub-frames; names the allowed ones if it is none of them.
pub fn check_subframe_count(count: usize) -> Result<(), String> {
    if count.is_multiple_of(2) && (MIN_SUBFRAMES..=MAX_SUBFRAMES).contains(&count) {
        Ok(())
    } else {
        Err(format!(
            "even numbers from {MIN_SUBFRAMES} to {MAX_SUBFRAMES}"
        ))
    }
}

/// Picks the sub-frames for the midpoints of `parts` equal parts of the shutter. A midpoint is
/// between two of them: one half uses the earlier, the other the later.
fn pick_subframes(parts: u32, count: usize, half: usize) -> Vec<usize> {
    let doubled_parts = 2 * parts as usize;
    let picks = (0..parts as usize).map(|part| {
        let doubled = (2 * part + 1) * count;
        let is_between = doubled.is_multiple_of(doubled_parts);
        doubled / doubled_parts - usize::from(half == 0 && is_between)
    });
    picks.collect()
}

/// Computes the part of the pixels that are marked.
pub fn part_of(marks: &Raster<bool>) -> f64 {
    let marked = marks.pixels.iter().filter(|is_marked| **is_marked);
    marked.count() as f64 / marks.pixels.len() as f64
}

/// Returns, per object, whether it is visible where anything moves.
fn find_movers(support: &Support) -> Vec<bool> {
    let moves = |seen: &Raster<bool>| {
        let mut both = seen.pixels.iter().zip(&support.moving.pixels);
        both.any(|(seen, moving)| *seen && *moving)
    };
    support.seen.iter().map(moves).collect()
}

/// The mean of some of the sub-frames.
struct Mean {
    subframes: u32,
    /// Indices of the sub-frames, per half.
    picks: [Vec<usize>; HALVES],
    halves: [Sum; HALVES],
}

/// Reads every sub-frame once, with the shares of the objects. Returns the halves of the mean of
/// all, those of the means of fewer, with their numbers of sub-frames, and the range of colours.
fn read_subframes(
    capture: &Capture,
    objects: usize,
    watch: Watch,
) -> Result<(Vec<(u32, Halves)>, ColorRange), Error> {
    let count = capture.subframes.len();
    let size = capture.color.size();
    let mean = |subframes: u32, pick: &dyn Fn(usize) -> Vec<usize>| Mean {
        subframes,
        picks: [0, 1].map(pick),
        halves: [0, 1].map(|_| Sum::new(size, objects)),
    };
    let every_other = |half| (half..count).step_by(HALVES).collect();
    let mut means = vec![mean(count as u32, &every_other)];
    let ladder =
        (LADDER.into_iter()).filter(|subframes| *subframes as usize * TRUTH_PER_MEAN <= count);
    means.extend(
        ladder.map(|subframes| mean(subframes, &|half| pick_subframes(subframes, count, half))),
    );
    let mut range = ColorRange::new(size, capture.description.stops.unwrap_or(0.0));
    for index in 0..count {
        Progress::report(watch, index, count)?;
        let color = capture.read_subframe(index)?;
        let ids = match objects {
            1 => None,
            _ => capture.read_subframe_objects(index)?,
        };
        let coverage = draw_coverage(ids.as_ref(), size, objects);
        let picture = Picture { color, coverage };
        range.add(&picture.color);
        for mean in &mut means {
            for (picks, half) in mean.picks.iter().zip(&mut mean.halves) {
                if picks.contains(&index) {
                    half.add(&picture);
                }
            }
        }
    }
    let means = means.iter();
    let means = means.map(|mean| (mean.subframes, mean.halves.each_ref().map(Sum::mean)));
    Ok((means.collect(), range))
}

/// A sum of pictures.
struct Sum {
    colors: Raster<[f64; 3]>,
    /// Per object, the number of pictures that show it.
    coverage: Vec<Plane>,
    count: u32,
}

impl Sum {
    fn new(Size { width, height }: Size, objects: usize) -> Self {
        Self {
            colors: Raster::filled(width, height, [0.0; 3]),
            coverage: vec![Plane::filled(width, height, 0.0); objects],
            count: 0,
        }
    }

    fn add(&mut self, picture: &Picture) {
        self.count += 1;
        for (sum, color) in self.colors.pixels.iter_mut().zip(&picture.color.pixels) {
            for (sum, value) in sum.iter_mut().zip(color) {
                *sum += f64::from(*value);
            }
        }
        for (sum, coverage) in self.coverage.iter_mut().zip(&picture.coverage) {
            *sum = sum.zip(coverage, |sum, share| sum + share);
        }
    }

    fn mean(&self) -> Picture {
        let count = f64::from(self.count);
        Picture {
            color: self.colors.map(|sum| sum.map(|sum| (sum / count) as f32)),
            coverage: (self.coverage.iter())
                .map(|sum| sum.map(|sum| (f64::from(*sum) / count) as f32))
                .collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_halves_together_lie_at_the_midpoints() {
        for (parts, count) in [(1, 4), (2, 8), (4, 32), (1, 6), (4, 18)] {
            let halves = [0, 1].map(|half| pick_subframes(parts, count, half));
            for part in 0..parts as usize {
                let places = halves.each_ref().map(|picks| picks[part] as f64 + 0.5);
                let middle = 0.5 * (places[0] + places[1]) / count as f64;
                let expected = (part as f64 + 0.5) / f64::from(parts);
                // If the parts are no whole number of sub-frames, the nearest is at most half of
                // one away.
                assert!(
                    (middle - expected).abs() <= 0.5 / count as f64 + 1e-12,
                    "{parts} of {count}: {halves:?}"
                );
            }
        }
    }
}
