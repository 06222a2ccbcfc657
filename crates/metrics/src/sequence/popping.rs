//! Popping: the largest jump, from one frame to the next, of the error of an object.

use frame::{Image, Raster};

use super::pairs::{mean_in, scatter_in};

/// Least part of the picture that an object covers for its error to count.
const LEAST_PART: f64 = 1e-3;

/// Root mean squared error of every object in one frame; none for those that cover too little of
/// the picture.
pub fn object_errors(error: &Raster<f64>, seen: &[Raster<bool>]) -> Vec<Option<f64>> {
    let root = |mask: &Raster<bool>| {
        let mean = mean_in(error, mask).filter(|_| counts(mask));
        // Below 0 by noise alone.
        mean.map(|mean| mean.max(0.0).sqrt())
    };
    seen.iter().map(root).collect()
}

/// Finds the largest jump of any object's error from each frame to the next; none if no object
/// counts in both.
pub fn largest_jumps(frames: &[Vec<Option<f64>>]) -> Vec<Option<f64>> {
    let largest = |pair: &[Vec<Option<f64>>]| {
        let objects = pair[0].iter().zip(&pair[1]);
        let jumps = objects.filter_map(|(before, now)| Some(((*now)? - (*before)?).abs()));
        jumps.reduce(f64::max)
    };
    frames.windows(2).map(largest).collect()
}

/// Finds the largest error that the truth's noise causes on any object; none if no object counts.
pub fn largest_floor(halves: [&Image; 2], seen: &[Raster<bool>], scale: f64) -> Option<f64> {
    let counts = |mask: &&Raster<bool>| counts(mask);
    let floors = (seen.iter().filter(counts)).filter_map(|mask| scatter_in(halves, mask, scale));
    floors.map(f64::sqrt).reduce(f64::max)
}

/// Returns whether an object covers enough of the picture.
fn counts(seen: &Raster<bool>) -> bool {
    let covered = seen.pixels.iter().filter(|seen| **seen).count();
    covered as f64 >= LEAST_PART * seen.pixels.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_jump_is_between_two_frames_that_both_show_the_object() {
        let frames = [
            vec![Some(0.1), Some(0.5)],
            vec![Some(0.3), None],
            vec![Some(0.2), Some(0.0)],
        ];
        let [first, second] = largest_jumps(&frames)[..] else {
            panic!("three frames have two changes");
        };
        assert!((first.unwrap() - 0.2).abs() < 1e-12);
        assert!((second.unwrap() - 0.1).abs() < 1e-12);
        assert_eq!(largest_jumps(&frames[..1]), []);
    }
}
