//! Truths, prepared for measuring many pictures against them.

use frame::{Frame, Ladder, Picture, Truth};
use metrics::{MeasureError, Reference, Viewing};
use tracer::Scene;

use crate::render::scatter_oracle::make_oracle;

/// The truth of one shutter, with everything that pictures are measured against.
pub(crate) struct TruthReferences<'a> {
    pub truth: &'a Truth,
    pub ladder: &'a Ladder,
    /// Picture of the one-frame oracle.
    pub oracle: Picture,
    pub reference: Reference<'a>,
    /// References to the truths without one pair of replicates each; empty where scores get no intervals.
    pub without_pairs: Vec<Reference<'a>>,
}

impl<'a> TruthReferences<'a> {
    /// Prepares the truth, and the same truth without each pair of its replicates. `ended` hears of the end of each part of
    /// measuring a picture against the truth.
    pub fn new(
        frame: &Frame,
        (truth, ladder): &'a (Truth, Ladder),
        without_pairs: &'a [Truth],
        viewing: &Viewing,
        ended: fn(&'static str),
    ) -> Result<Self, MeasureError> {
        let oracle = make_oracle(frame, truth);
        let frame = frame.cropped();
        let reference = |truth: &'a Truth| {
            Reference::new(&frame, truth, Some(ladder), viewing)?.with_best(&oracle)
        };
        Ok(Self {
            truth,
            ladder,
            reference: reference(truth)?.with_listener(ended),
            without_pairs: without_pairs
                .iter()
                .map(reference)
                .collect::<Result<_, _>>()?,
            oracle,
        })
    }
}

/// Returns the photographic exposures that a scene is compared at.
pub fn scene_viewing(scene: &Scene) -> Viewing {
    scene.display.into()
}
