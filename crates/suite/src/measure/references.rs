//! Truths, prepared for measuring many pictures against them.

use std::cell::RefCell;
use std::collections::BTreeMap;

use frame::{Frame, Ladder, Picture, Truth};
use metrics::{MeasureError, Reference, Viewing};
use tracer::Scene;

use crate::render::scatter_oracle::make_oracle;

/// The truth of one shutter, with everything that pictures are measured against.
pub(crate) struct TruthReferences<'a> {
    pub truth: &'a Truth,
    /// Accumulations that are still to be measured, by their number of sub-frames.
    accumulations: RefCell<BTreeMap<u32, Picture>>,
    /// Picture of the one-frame oracle.
    pub oracle: Picture,
    pub reference: Reference<'a>,
    /// References to the truths without one pair of replicates each; empty where scores get no intervals.
    pub without_pairs: Vec<Reference<'a>>,
}

impl<'a> TruthReferences<'a> {
    /// Prepares the truth, and the same truth without each pair of its replicates. Of the ladder, which takes more memory than all
    /// else, it keeps the accumulations of `subframes`. `ended` hears of the end of each part of measuring a picture against the
    /// truth.
    pub fn new(
        frame: &Frame,
        (truth, ladder): (&'a Truth, Ladder),
        subframes: &[u32],
        without_pairs: &'a [Truth],
        viewing: &Viewing,
        ended: fn(&'static str),
    ) -> Result<Self, MeasureError> {
        let oracle = make_oracle(frame, truth);
        let frame = frame.cropped();
        let reference = |truth: &'a Truth| {
            Reference::new(&frame, truth, Some(&ladder), viewing)?.with_best(&oracle)
        };
        let rungs = (ladder.rungs.iter()).filter(|rung| subframes.contains(&rung.subframes));
        let accumulations = rungs.map(|rung| (rung.subframes, Picture::mean(&rung.halves)));
        Ok(Self {
            truth,
            accumulations: RefCell::new(accumulations.collect()),
            reference: reference(truth)?.with_listener(ended),
            without_pairs: without_pairs
                .iter()
                .map(reference)
                .collect::<Result<_, _>>()?,
            oracle,
        })
    }

    /// Takes the accumulation of a number of sub-frames out of those that are still to be measured.
    pub fn take_accumulation(&self, subframes: u32) -> Picture {
        let picture = self.accumulations.borrow_mut().remove(&subframes);
        picture.expect("every accumulation that is due was kept, and is measured once")
    }
}

/// Returns the photographic exposures that a scene is compared at.
pub fn scene_viewing(scene: &Scene) -> Viewing {
    scene.display.into()
}
