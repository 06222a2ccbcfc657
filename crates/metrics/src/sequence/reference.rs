//! The truths of a sequence, ready to measure any number of sequences of pictures.

use frame::{Image, Plane, Raster};

use super::fixed_pattern::{FineError, correlate, fine};
use super::instant::Instant;
use super::jod::{JOD_DISPLAY, displayed, video_jod};
use super::measurement::SequenceMeasurement;
use super::pairs::{Pair, mean_in, scatter_in};
use super::popping::{largest_floor, largest_jumps, object_errors};
use super::temporal_antialiasing::accumulate;
use crate::color::cross_error::squared_error;
use crate::math::pooling::mean;
use crate::math::raster::{map_pixels, zip_pixels};
use crate::metric::{SequenceMetric, SequenceScores};
use crate::{MeasureError, Measured, Viewing};

const ONE_FRAME: &str = "a sequence of one frame has no change";
const NOTHING_MOVES: &str = "nothing moves on screen";
const NOTHING_IN_TWO: &str = "no point that moves is seen in two frames that follow one another";
const NO_OBJECT: &str = "no object covers enough of two frames that follow one another";

/// The truths of a sequence.
pub struct SequenceReference {
    instants: Vec<Instant>,
    /// Pixels that each frame is pooled over: where anything moves, or all if nothing ever does.
    masks: Vec<Raster<bool>>,
    /// Factor from radiance to display.
    scale: f64,
    fixed: Vec<Pair>,
    along: Vec<Pair>,
    /// Mean of the truth's halves as a display shows it, per frame.
    displayed: Vec<Image>,
    /// Quality of one half against that mean, or the reason why there is none.
    half_jod: Result<f64, String>,
    /// Frames per second, and exposure in stops.
    shown: (f64, f32),
    /// Halves after temporal anti-aliasing, per frame.
    accumulated: Vec<[Image; 2]>,
    along_accumulated: Vec<Pair>,
}

impl SequenceReference {
    /// Prepares the truths of consecutive frames, at least one, which are shown at a number of
    /// frames per second. Panics if their sizes differ.
    pub fn new(instants: Vec<Instant>, viewing: &Viewing, per_second: f64) -> Self {
        let first = instants.first().expect("a sequence has a frame");
        assert!(
            instants
                .iter()
                .all(|instant| instant.moving.same_size(&first.moving)),
            "the frames of a sequence have one size"
        );
        let moves = |instant: &Instant| instant.moving.pixels.contains(&true);
        let anything_moves = instants.iter().any(moves);
        let mask = |instant: &Instant| instant.moving.map(|moves| *moves || !anything_moves);
        let masks: Vec<Raster<bool>> = instants.iter().map(mask).collect();
        let halves: Vec<[Image; 2]> = instants
            .iter()
            .map(|instant| instant.halves.clone())
            .collect();
        let half = |half: usize| -> Vec<Image> {
            let pictures: Vec<Image> = halves.iter().map(|halves| halves[half].clone()).collect();
            accumulate(&pictures, &instants)
        };
        let accumulated: Vec<[Image; 2]> = (half(0).into_iter().zip(half(1)))
            .map(<[Image; 2]>::from)
            .collect();
        let along = |halves: &[[Image; 2]]| -> Vec<Pair> {
            let pairs = (1..instants.len()).map(|now| {
                Pair::along_the_motion(
                    [&instants[now - 1], &instants[now]],
                    [&halves[now - 1], &halves[now]],
                    &masks[now],
                )
            });
            pairs.collect()
        };
        let fixed = (1..instants.len()).map(|now| {
            let either = masks[now - 1].zip(&masks[now], |before, now| *before || *now);
            Pair::at_fixed_places([&halves[now - 1], &halves[now]], either)
        });
        let means: Vec<Image> = (halves.iter())
            .map(|[a, b]| zip_pixels(a, b, |a, b| std::array::from_fn(|c| 0.5 * (a[c] + b[c]))))
            .collect();
        let shown = displayed(&means, viewing.stops);
        let half = displayed(halves.iter().map(|halves| &halves[0]), viewing.stops);
        Self {
            half_jod: jod_of_several(&half, &shown, per_second),
            displayed: shown,
            shown: (per_second, viewing.stops),
            fixed: fixed.collect(),
            along: along(&halves),
            along_accumulated: along(&accumulated),
            scale: viewing.scale(),
            masks,
            accumulated,
            instants,
        }
    }

    /// Measures one picture per frame, in their order.
    ///
    /// # Errors
    /// A picture has another size than the truths, or there is another number of pictures.
    pub fn measure(&self, pictures: &[Image]) -> Result<SequenceMeasurement, MeasureError> {
        self.check(pictures)?;
        let scale = self.scale;
        let halves = |at: usize| self.instants[at].halves.each_ref();
        let error_maps: Vec<Raster<f64>> = (pictures.iter().enumerate())
            .map(|(at, picture)| squared_error(picture, halves(at), scale))
            .collect();
        let pool = |(map, mask): (&Raster<f64>, &Raster<bool>)| mean_in(map, mask);
        let errors: Vec<Option<f64>> = error_maps.iter().zip(&self.masks).map(pool).collect();
        let change_maps = map_pairs(&self.fixed, pictures, scale);
        let along_maps = map_pairs(&self.along, pictures, scale);
        let accumulated = accumulate(pictures, &self.instants);
        let accumulated_maps = map_pairs(&self.along_accumulated, &accumulated, scale);
        let later = (1..pictures.len()).map(|at| {
            let halves = self.accumulated[at].each_ref();
            let map = squared_error(&accumulated[at], halves, scale);
            (
                mean_in(&map, &self.masks[at]),
                scatter_in(halves, &self.masks[at], scale),
            )
        });
        let (later_errors, later_floors): (Vec<_>, Vec<_>) = later.unzip();
        let own_floors: Vec<Option<f64>> = (self.masks.iter().enumerate())
            .map(|(at, mask)| scatter_in(halves(at), mask, scale))
            .collect();
        let changes = pool_pairs(&self.fixed, &change_maps);
        let along = pool_pairs(&self.along, &along_maps);
        let changes_after_taa = pool_pairs(&self.along_accumulated, &accumulated_maps);
        let jumps = self.jumps(&error_maps);
        let scores = SequenceScores {
            error: self.combine(&errors, &own_floors, NOTHING_MOVES),
            flicker: self.change(&self.fixed, &changes, NOTHING_MOVES),
            flicker_along: self.change(&self.along, &along, NOTHING_IN_TWO),
            popping: self.popping(&jumps),
            fixed_pattern: self.fixed_pattern(pictures),
            jod: self.jod(pictures),
            error_after_taa: match pictures.len() {
                1 => Measured::not_applicable(ONE_FRAME),
                _ => self.combine(&later_errors, &later_floors, NOTHING_MOVES),
            },
            flicker_after_taa: self.change(
                &self.along_accumulated,
                &changes_after_taa,
                NOTHING_IN_TWO,
            ),
        };
        Ok(SequenceMeasurement {
            // Except for errors, the first value belongs to the second frame.
            worst_frames: find_worst_frames([
                (SequenceMetric::Error, 0, &errors),
                (SequenceMetric::Flicker, 1, &changes),
                (SequenceMetric::FlickerAlong, 1, &along),
                (SequenceMetric::Popping, 1, &jumps),
                (SequenceMetric::ErrorAfterTaa, 1, &later_errors),
                (SequenceMetric::FlickerAfterTaa, 1, &changes_after_taa),
            ]),
            scores,
            errors,
            flickers: std::iter::once(None).chain(along).collect(),
            change_errors: change_maps.iter().map(root).collect(),
        })
    }

    fn check(&self, pictures: &[Image]) -> Result<(), MeasureError> {
        if pictures.len() != self.instants.len() {
            return Err(MeasureError::Disagree {
                what: "a sequence of pictures",
                found: format!("{} frames", pictures.len()),
                allowed: format!("{} frames", self.instants.len()),
            });
        }
        let size = self.masks[0].size();
        match (pictures.iter()).position(|picture| picture.size() != size) {
            None => Ok(()),
            Some(at) => Err(MeasureError::Size {
                what: format!("the picture of frame {at}"),
                found: pictures[at].size(),
                truth: size,
            }),
        }
    }

    /// Averages values and floors over the frames that have them.
    fn combine(&self, values: &[Option<f64>], floors: &[Option<f64>], none: &str) -> Measured {
        let all = |numbers: &[Option<f64>]| mean(numbers.iter().flatten().copied());
        Measured::of(all(values), all(floors), none)
    }

    /// Averages the error of a change over all pairs.
    fn change(&self, pairs: &[Pair], values: &[Option<f64>], none: &str) -> Measured {
        if pairs.is_empty() {
            return Measured::not_applicable(ONE_FRAME);
        }
        let floors: Vec<_> = pairs.iter().map(|pair| pair.floor(self.scale)).collect();
        self.combine(values, &floors, none)
    }

    /// Finds the largest jump of an object's error from each frame to the next.
    fn jumps(&self, error_maps: &[Raster<f64>]) -> Vec<Option<f64>> {
        let frames: Vec<_> = (error_maps.iter().zip(&self.instants))
            .map(|(map, instant)| object_errors(map, &instant.seen))
            .collect();
        largest_jumps(&frames)
    }

    fn popping(&self, jumps: &[Option<f64>]) -> Measured {
        if self.instants.len() == 1 {
            return Measured::not_applicable(ONE_FRAME);
        }
        let floors = self.instants.iter().filter_map(|instant| {
            largest_floor(instant.halves.each_ref(), &instant.seen, self.scale)
        });
        let largest = jumps.iter().flatten().copied().reduce(f64::max);
        Measured::of(largest, floors.reduce(f64::max), NO_OBJECT)
    }

    /// Computes the quality as a display shows it. The truth supports at most the quality of one of
    /// its halves.
    fn jod(&self, pictures: &[Image]) -> Measured {
        let (per_second, stops) = self.shown;
        let pictures = displayed(pictures, stops);
        match (
            jod_of_several(&pictures, &self.displayed, per_second),
            &self.half_jod,
        ) {
            (Ok(value), Ok(floor)) => Measured::score(value, *floor),
            (Err(reason), _) => Measured::not_applicable(reason),
            (_, Err(reason)) => Measured::not_applicable(reason.clone()),
        }
    }

    fn fixed_pattern(&self, pictures: &[Image]) -> Measured {
        if pictures.len() == 1 {
            return Measured::not_applicable(ONE_FRAME);
        }
        let frames: Vec<FineError> = (pictures.iter().zip(&self.instants).zip(&self.masks))
            .map(|((picture, instant), mask)| {
                FineError::new(picture, instant.halves.each_ref(), mask)
            })
            .collect();
        let floors: Vec<Option<f64>> = (self.instants.iter().zip(&self.masks))
            .map(|(instant, mask)| {
                let [a, b] = instant.halves.each_ref().map(fine);
                scatter_in([&a, &b], mask, self.scale)
            })
            .collect();
        self.combine(&[correlate(&frames, self.scale)], &floors, NOTHING_MOVES)
    }
}

/// Computes the quality of a video; a single frame has none.
fn jod_of_several(pictures: &[Image], truths: &[Image], per_second: f64) -> Result<f64, String> {
    match pictures.len() {
        1 => Err(ONE_FRAME.to_owned()),
        _ => video_jod(pictures, truths, JOD_DISPLAY, per_second),
    }
}

/// Maps the error of the change from each frame to the next.
fn map_pairs(pairs: &[Pair], pictures: &[Image], scale: f64) -> Vec<Raster<f64>> {
    let maps = pairs.iter().zip(pictures.windows(2));
    maps.map(|(pair, two)| pair.map_error([&two[0], &two[1]], scale))
        .collect()
}

/// Averages the error of the change of each pair; none if no pixel counts.
fn pool_pairs(pairs: &[Pair], maps: &[Raster<f64>]) -> Vec<Option<f64>> {
    let pairs = pairs.iter().zip(maps);
    pairs.map(|(pair, map)| pair.pool(map)).collect()
}

/// Finds the frame of the largest value of each score, the first of equal ones, from the frame of
/// its first value; leaves out scores without values.
fn find_worst_frames(
    shares: [(SequenceMetric, usize, &Vec<Option<f64>>); 6],
) -> Vec<(SequenceMetric, usize)> {
    let worst = shares.into_iter().filter_map(|(metric, first, values)| {
        let known = (first..)
            .zip(values)
            .filter_map(|(at, value)| Some((at, (*value)?)));
        let largest =
            known.reduce(|largest, value| if value.1 > largest.1 { value } else { largest });
        Some((metric, largest?.0))
    });
    worst.collect()
}

/// Takes roots of squared errors, 0 for those that noise makes negative.
fn root(map: &Raster<f64>) -> Plane {
    map_pixels(map, |square| square.max(0.0).sqrt() as f32)
}
