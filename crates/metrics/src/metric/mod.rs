//! Names of all metrics, and a row for each.

mod name;
mod row;
mod rows;
mod sequence_rows;
mod text;

pub use name::Metric;
pub use row::{Group, Row};
pub use rows::{
    EquivalentMetric, EquivalentScores, FrozenMetric, FrozenScores, ImageMetric, ImageScores,
    LabelMetric, LabelScores, ObjectMetric, ObjectScores, ProbeMetric, ProbeScores, SkillMetric,
    SkillScores,
};
pub use sequence_rows::{PERFECT_JOD, SequenceMetric, SequenceScores};
