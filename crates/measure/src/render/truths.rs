//! Truths of scenes, made of replicates.

use std::ops::Range;

use crate::{Error, MAX_REPLICATES, refuse_scene};
use frame::{Alignment, Region, Truth};

use super::rendering::Rendering;
use super::replicates::Tracers;

impl<'a> Rendering<'a> {
    /// Renders and writes the truth over the shutter of an alignment. Reads the truth, or some of
    /// its replicates, if their inputs are the same.
    pub fn truth(&self, alignment: Alignment) -> Result<Truth, Error> {
        let files = self.files(alignment);
        if let Some(truth) = files.read_truth() {
            return Ok(truth);
        }
        let truth = files.average(&mut Tracers::default())?;
        files.write(&truth)?;
        Ok(truth)
    }

    /// Renders replicates of each truth until its noise floor reaches `target` where anything moves
    /// (everywhere if nothing does), or there are `most`. Writes each truth when it ends, and hands
    /// it to `ended`, with true if it reached the target: truths of large pictures are too large to
    /// hold together.
    ///
    /// The floor that ends the render is measured on the same halves that the truth keeps: if the
    /// render ends early because they happened to agree, the floor reads a little low.
    pub fn truths_until(
        mut self,
        alignments: &[Alignment],
        target: f64,
        most: u32,
        mut ended: impl FnMut(&Truth, bool) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let mut open = alignments.to_vec();
        let mut tracers = Tracers::default();
        while !open.is_empty() {
            let count = self.settings.replicates;
            let mut next = count + 2;
            self.share(&open, 0..count, &mut tracers)?;
            for alignment in std::mem::take(&mut open) {
                let files = self.files(alignment);
                let stored_truth = files.read_truth();
                let is_new = stored_truth.is_none();
                let truth = stored_truth.map_or_else(|| files.average(&mut tracers), Ok)?;
                let (_, floor) = deciding_floor(&truth);
                if floor > target && count + 2 <= most {
                    next = next.max(predict_replicates(count, floor / target));
                    open.push(alignment);
                    continue;
                }
                if is_new {
                    files.write(&truth)?;
                }
                ended(&truth, floor <= target)?;
            }
            self.settings = self.settings.with_replicates(next.min(most - most % 2));
        }
        Ok(())
    }

    /// Renders some replicates of a truth and writes them.
    pub fn part(&self, alignment: Alignment, indices: Range<u32>) -> Result<(), Error> {
        refuse_scene(&self.folder())?;
        self.check_memory(indices.len() as u32)?;
        self.files(alignment).replicates(indices).map(drop)
    }
}

/// Predicts the even number of replicates that lowers the noise by `factor`: noise falls with the
/// root of their number.
fn predict_replicates(replicates: u32, factor: f64) -> u32 {
    let pairs = 0.5 * f64::from(replicates) * factor.powi(2);
    // No more than are ever allowed.
    2 * pairs.ceil().min(f64::from(MAX_REPLICATES / 2)) as u32
}

/// Returns the noise floor to compare with a target: the moving region's, or the whole picture's if
/// nothing moves.
pub fn deciding_floor(truth: &Truth) -> (Region, f64) {
    let floors = truth.noise_floors();
    *floors
        .iter()
        .find(|(region, _)| *region == Region::Moving)
        .or(floors.last())
        .expect("a picture has pixels")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_the_noise_takes_four_times_the_replicates() {
        assert_eq!(predict_replicates(8, 2.0), 32);
        // 8 x 1.1^2 = 9.68, to the next even number.
        assert_eq!(predict_replicates(8, 1.1), 10);
        assert_eq!(predict_replicates(8, f64::INFINITY), MAX_REPLICATES);
    }
}
