//! Names of all metrics, and a row for each.

mod name;
mod row;
mod rows;
mod text;

pub use name::Metric;
pub(crate) use row::metrics;
pub use row::{Group, Row};
pub use rows::{
    EquivalentMetric, EquivalentScores, FrozenMetric, FrozenScores, ImageMetric, ImageScores,
    LabelMetric, LabelScores, ObjectMetric, ObjectScores, ProbeMetric, ProbeScores, SkillMetric,
    SkillScores,
};
