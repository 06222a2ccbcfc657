//! Scores of one object's matte: bleed, growth, mass, and its place along the motion.

pub mod along_motion;
pub mod bleed;
pub mod gradient;
pub mod mass;
pub mod misplacement;
pub mod mover;
pub mod nearest;
pub mod noise;
pub mod patch;
pub mod reference;
pub mod row_mass;
pub mod rows;
pub mod sides;
