//! Truths, prepared for measuring many pictures.

use frame::{Accumulation, Frame, Ladder, Picture, Truth};
use metrics::{ImageScores, Reference, Sharp, TruthErrors, Viewing, make_oracles};

use crate::Error;
use crate::render::ladders::sharp_picture;

/// The truth of one shutter, with everything needed to measure pictures.
pub(crate) struct TruthReferences<'a> {
    /// The truth itself.
    pub truth: &'a Truth,
    /// Picture of the one-frame oracle.
    pub oracle: Picture,
    /// All that pictures are compared with.
    pub reference: Reference<'a>,
    /// References that each lack one group of replicates, of frame, truth and ladder; empty if
    /// nothing gets intervals.
    pub parts: Vec<Reference<'a>>,
    /// Scores of the frame itself where nothing moves, if there are parts: see
    /// [`intervals`](crate::intervals).
    pub still: Option<ImageScores>,
}

/// A part of the replicates of a frame and of its truth.
pub(crate) struct TruthPart {
    /// The frame's colour and coverage, guard band included.
    pub picture: Picture,
    /// The truth.
    pub truth: Truth,
}

/// A frame and its truth, to make references of.
pub(crate) struct ReferenceSource<'a, 'f> {
    /// The frame, guard band included.
    pub frame: &'f Frame,
    pub truth: &'a Truth,
    pub parts: &'a [TruthPart],
    pub viewing: Viewing,
}

impl<'a> ReferenceSource<'a, '_> {
    /// Prepares the truth, and the same for each part, with the errors that they had before, in
    /// this order.
    pub fn with_errors(&self, errors: Vec<TruthErrors>) -> Result<TruthReferences<'a>, Error> {
        let (oracle, _) = make_oracles(self.frame, &[], self.truth);
        let frame = self.frame.cropped();
        let mut errors = errors.into_iter();
        let mut next = || {
            errors
                .next()
                .expect("there are errors of the truth and of each part")
        };
        let reference = Reference::with_errors(&frame, self.truth, &self.viewing, next())?;
        let parts = (self.parts.iter())
            .map(|part| {
                let frame = self.part_frame(&frame, part);
                reference.part(&frame, &part.truth, Some(next()))
            })
            .collect::<Result<_, _>>()?;
        self.finish(&frame, reference, parts, oracle)
    }

    /// Prepares the truth, and the same for each part, and measures their errors. The ladder's
    /// rungs are read one at a time, since together they need more memory than all else;
    /// `read_sharp` reads the rung that is the sharp picture of the shutter's middle.
    pub fn measure(
        &self,
        read_sharp: impl FnOnce() -> Result<Accumulation, Error>,
        rungs: impl Iterator<Item = Result<Ladder, Error>>,
    ) -> Result<TruthReferences<'a>, Error> {
        let (truth, viewing) = (self.truth, &self.viewing);
        let pictures: Vec<Picture> = self.parts.iter().map(|part| part.picture.clone()).collect();
        let (oracle, oracles) = make_oracles(self.frame, &pictures, truth);
        let frame = self.frame.cropped();
        let sharp = sharp_picture(&frame, truth, read_sharp)?;
        let mut reference =
            Reference::new(&frame, truth, None, viewing)?.with_ends(&sharp, &oracle)?;
        let of_part = |((group, part), oracle): ((usize, &'a TruthPart), Picture)| {
            let frame = self.part_frame(&frame, part);
            // The sharp picture of a centred shutter is the frame.
            let sharp = match &sharp {
                Sharp::Frame(_) => Sharp::Frame(frame.picture()),
                rung => rung.without(group),
            };
            (reference.part(&frame, &part.truth, None)?).with_ends(&sharp, &oracle)
        };
        let mut references: Vec<Reference> = (self.parts.iter().enumerate().zip(oracles))
            .map(of_part)
            .collect::<Result<_, _>>()?;
        for rung in rungs {
            let rung = rung?;
            reference.add_rungs(&rung)?;
            for (group, reference) in references.iter_mut().enumerate() {
                reference.add_rungs(&rung.without(group))?;
            }
        }
        self.finish(&frame, reference, references, oracle)
    }

    /// Makes the frame of a part. `frame` has no guard band.
    fn part_frame(&self, frame: &Frame, part: &TruthPart) -> Frame {
        frame.showing(&part.picture.cropped(self.frame.guard_band))
    }

    fn finish(
        &self,
        frame: &Frame,
        reference: Reference<'a>,
        parts: Vec<Reference<'a>>,
        oracle: Picture,
    ) -> Result<TruthReferences<'a>, Error> {
        let still = match &parts[..] {
            [] => None,
            _ => Some(reference.measure(&frame.picture())?.scores.still),
        };
        Ok(TruthReferences {
            truth: self.truth,
            reference,
            parts,
            still,
            oracle,
        })
    }
}

impl TruthReferences<'_> {
    /// Returns the errors of the truth, then of its parts, for [`ReferenceSource::with_errors`].
    pub fn errors(&self) -> Vec<&TruthErrors> {
        let all = std::iter::once(&self.reference).chain(&self.parts);
        all.map(Reference::errors).collect()
    }
}
