//! Truths, prepared for measuring many pictures.

use frame::{Accumulation, Frame, Ladder, Picture, Truth};
use metrics::{ImageScores, Reference, Sharp, Viewing, make_oracles};

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

impl<'a> TruthReferences<'a> {
    /// Prepares the truth, and the same for each of `parts`. The ladder's rungs are read one at a
    /// time, since together they need more memory than all else; `read_sharp` reads the rung that
    /// is the sharp picture of the shutter's middle.
    pub fn new(
        frame: &Frame,
        truth: &'a Truth,
        read_sharp: impl FnOnce() -> Result<Accumulation, Error>,
        rungs: impl Iterator<Item = Result<Ladder, Error>>,
        parts: &'a [TruthPart],
        viewing: &Viewing,
    ) -> Result<Self, Error> {
        let pictures: Vec<Picture> = parts.iter().map(|part| part.picture.clone()).collect();
        let (oracle, oracles) = make_oracles(frame, &pictures, truth);
        let band = frame.guard_band;
        let frame = frame.cropped();
        let sharp = sharp_picture(&frame, truth, read_sharp)?;
        let mut reference =
            Reference::new(&frame, truth, None, viewing)?.with_ends(&sharp, &oracle)?;
        let of_part = |((group, part), oracle): ((usize, &'a TruthPart), Picture)| {
            let frame = frame.showing(&part.picture.cropped(band));
            // The sharp picture of a centred shutter is the frame.
            let sharp = match &sharp {
                Sharp::Frame(_) => Sharp::Frame(frame.picture()),
                rung => rung.without(group),
            };
            Reference::new(&frame, &part.truth, None, viewing)?.with_ends(&sharp, &oracle)
        };
        let mut references: Vec<Reference> = (parts.iter().enumerate().zip(oracles))
            .map(of_part)
            .collect::<Result<_, _>>()?;
        for rung in rungs {
            let rung = rung?;
            reference.add_rungs(&rung)?;
            for (group, reference) in references.iter_mut().enumerate() {
                reference.add_rungs(&rung.without(group))?;
            }
        }
        let still = match parts {
            [] => None,
            _ => Some(reference.measure(&frame.picture())?.scores.still),
        };
        Ok(Self {
            truth,
            reference,
            parts: references,
            still,
            oracle,
        })
    }
}
