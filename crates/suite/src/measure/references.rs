//! Truths, prepared for measuring many pictures.

use frame::{Accumulation, Frame, Ladder, Picture, Truth};
use metrics::{Reference, Sharp, Viewing};

use crate::Error;
use crate::render::ladders::sharp_picture;
use metrics::make_oracle;

/// The truth of one shutter, with everything needed to measure pictures.
pub(crate) struct TruthReferences<'a> {
    /// The truth itself.
    pub truth: &'a Truth,
    /// Picture of the one-frame oracle.
    pub oracle: Picture,
    /// All that pictures are compared with.
    pub reference: Reference<'a>,
    /// References to the truths without one pair of replicates each, and to their ladders without the group of samples of the same
    /// number; empty if nothing gets intervals.
    pub without_pairs: Vec<Reference<'a>>,
}

impl<'a> TruthReferences<'a> {
    /// Prepares the truth, and the same truth without each pair of its replicates. The ladder's rungs are read one at a time, since
    /// together they need more memory than all else; `read_sharp` reads the rung that is the sharp picture of the shutter's middle.
    pub fn new(
        frame: &Frame,
        truth: &'a Truth,
        read_sharp: impl FnOnce() -> Result<Accumulation, Error>,
        rungs: impl Iterator<Item = Result<Ladder, Error>>,
        without_pairs: &'a [Truth],
        viewing: &Viewing,
    ) -> Result<Self, Error> {
        let oracle = make_oracle(frame, truth);
        let frame = frame.cropped();
        let sharp = sharp_picture(&frame, truth, read_sharp)?;
        let reference = |truth: &'a Truth, sharp: &Sharp| {
            Reference::new(&frame, truth, None, viewing)?.with_ends(sharp, &oracle)
        };
        let mut own = reference(truth, &sharp)?;
        let mut without_pairs: Vec<Reference> = (without_pairs.iter().enumerate())
            .map(|(group, truth)| reference(truth, &sharp.without(group)))
            .collect::<Result<_, _>>()?;
        for rung in rungs {
            let rung = rung?;
            own.add_rungs(&rung)?;
            for (group, reference) in without_pairs.iter_mut().enumerate() {
                reference.add_rungs(&rung.without(group))?;
            }
        }
        Ok(Self {
            truth,
            reference: own,
            without_pairs,
            oracle,
        })
    }
}
