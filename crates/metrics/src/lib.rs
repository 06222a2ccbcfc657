//! Scores of a picture against the truth.
//!
//! [`measure`] compares a filter's output with the truth and returns [`Scores`] with the [`Maps`]
//! that they were pooled from. Every score has a floor: the score of the truth's own noise. If a
//! score would mean nothing in a scene, a reason replaces it. The crate's `README.md` defines each
//! score and says what fools it; [`Metric`] names them all.
//!
//! | module | contents |
//! |---|---|
//! | `metric` | names of all metrics, and a row for each |
//! | `color`, `label`, `object`, `probe` | formulas: errors of colour, of labels, of one object's matte, of probes |
//! | `picture` | errors of a whole picture, pooled over regions |
//! | `skill`, `subframes` | error put into proportion: skill and equivalent sub-frames |
//! | `smear` | length, side and direction of a smear |
//! | `reference` | the truth, ready to measure pictures against |
//! | `scatter_oracle` | about the best picture that one frame can give |
//! | `sequence` | errors from frame to frame |
//! | `math` | means, convolutions and powers |

mod color;
mod error;
mod interval;
mod label;
mod maps;
mod math;
mod metric;
mod object;
#[cfg(test)]
mod parity;
mod picture;
mod probe;
mod reference;
mod scatter_oracle;
mod score;
mod scores;
mod sequence;
mod skill;
mod smear;
mod subframes;
mod viewing;

pub use color::absolute_error::SMAPE_EPSILON;
pub use color::cross_error::{PSNR_LIMIT, RELATIVE_EPSILON, psnr};
pub use color::flip::{flip_hdr, flip_ldr};
pub use error::MeasureError;
pub use frame::{Region, Regions, regions};
pub use interval::{Interval, Rise, jackknife, jackknife_of};
pub use maps::{ErrorMap, Maps, ProbeMaps};
pub use metric::{
    EquivalentMetric, EquivalentScores, FrozenMetric, FrozenScores, Group, ImageMetric,
    ImageScores, LabelMetric, LabelScores, Metric, ObjectMetric, ObjectScores, PERFECT_JOD,
    ProbeMetric, ProbeScores, Row, SequenceMetric, SequenceScores, SkillMetric, SkillScores,
};
pub use object::sides::{Side, object_sides};
pub use probe::{ProbeMeasurement, Probes, mix, nonlinearity, pack_planes, unpack_planes};
pub use reference::{
    ColorReference, Jitter, Measurement, Reference, Sharp, TruthErrors, mark_shared,
};
pub use scatter_oracle::{make_oracle, make_oracles, scatter_oracle};
pub use score::{Ideal, Measured, Score};
pub use scores::Scores;
pub use sequence::{
    Instant, JOD_DISPLAY, NEW_SHARE, SequenceMeasurement, SequenceReference, accumulate, video_jod,
};
pub use smear::{Smear, SmearDirection, measure_smear};
pub use subframes::ladder::{Curves, ErrorKind, Errors, Rung};
pub use subframes::{Equivalent, LadderRange, Subframes, equivalent};
pub use viewing::Viewing;

use frame::{Frame, Ladder, Picture, Truth};

/// Measures one picture. To measure several against the same truth, make a [`Reference`] once: it
/// keeps everything that does not depend on the picture (regions, floors, the ladder's errors).
pub fn measure(
    output: &Picture,
    frame: &Frame,
    truth: &Truth,
    ladder: Option<&Ladder>,
    viewing: &Viewing,
) -> Result<Measurement, MeasureError> {
    Reference::new(frame, truth, ladder, viewing)?.measure(output)
}
