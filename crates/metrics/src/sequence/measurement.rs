//! Measurement of a sequence of pictures.

use frame::Plane;

use crate::metric::{SequenceMetric, SequenceScores};

/// Scores of a sequence of pictures, and what they were pooled from.
#[derive(Clone, Debug, PartialEq)]
pub struct SequenceMeasurement {
    /// Scores over all frames.
    pub scores: SequenceScores,
    /// Worst frame, from 0, by every score that frames have a share in. A change belongs to its
    /// second frame.
    pub worst_frames: Vec<(SequenceMetric, usize)>,
    /// Squared error where anything moves, per frame; none if nothing does.
    pub errors: Vec<Option<f64>>,
    /// Squared error of the change along the motion since the frame before, per frame; none for the
    /// first.
    pub flickers: Vec<Option<f64>>,
    /// Error of the change since the frame before at fixed places, per frame from the second: the
    /// root of the mean square over the channels, in display white.
    pub change_errors: Vec<Plane>,
}
