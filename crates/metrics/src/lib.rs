//! Scores of a picture against the truth.
//!
//! [`measure`] compares a filter's output with the truth and returns [`Scores`] with the [`Maps`] that they were pooled
//! from. Every score comes with its floor: what the truth's own noise makes of it. A score that would mean nothing in a
//! scene is not a number but a reason. `README.md` beside this crate defines each score and says what fools it;
//! [`Metric`] names them all.

mod check;
mod color;
mod equivalent;
mod error;
mod interval;
mod jitter;
mod label;
mod ladder;
mod maps;
mod metric;
mod metric_rows;
mod object;
#[cfg(test)]
mod parity;
mod probes;
mod reference;
mod row;
mod score;
mod scores;
mod skill;
mod viewing;

pub use color::absolute_error::SMAPE_EPSILON;
pub use color::cross_error::{PSNR_LIMIT, RELATIVE_EPSILON};
pub use color::flip::{flip_hdr, flip_ldr};
pub use color::ssim::{SSIM_BORDER, ssim};
pub use equivalent::{Equivalent, Reach, Subframes};
pub use error::MeasureError;
pub use frame::{Region, Regions, regions};
pub use interval::{Interval, jackknife};
pub use jitter::Jitter;
pub use maps::{ErrorMap, Maps};
pub use metric::Metric;
pub use metric_rows::{
    EquivalentMetric, EquivalentScores, FrozenMetric, FrozenScores, ImageMetric, ImageScores,
    LabelMetric, LabelScores, ObjectMetric, ObjectScores, ProbeMetric, ProbeScores, SkillMetric,
    SkillScores,
};
pub use object::bleed::Side;
pub use object::gradient::{gradient_error, gradient_magnitude};
pub use object::object_sides::object_sides;
pub use probes::{ProbeMaps, ProbeMeasurement, Probes};
pub use reference::{Measurement, Reference};
pub use row::{Group, Row};
pub use score::{Ideal, Measured, Score};
pub use scores::Scores;
pub use viewing::Viewing;

use frame::{Frame, Ladder, Picture, Truth};

/// Measures one picture. To measure several against the same truth, make a [`Reference`] once: it holds what does not
/// depend on the picture (regions, floors, the ladder's errors).
pub fn measure(
    output: &Picture,
    frame: &Frame,
    truth: &Truth,
    ladder: Option<&Ladder>,
    viewing: &Viewing,
) -> Result<Measurement, MeasureError> {
    Reference::new(frame, truth, ladder, viewing)?.measure(output)
}
