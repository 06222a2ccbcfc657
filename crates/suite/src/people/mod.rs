//! Questions to people about the pictures of a run, and what follows from their answers.

pub mod agreement;
pub mod answers;
pub mod bradley_terry;
pub mod clips;
pub mod design;
pub mod paired_counts;
pub mod preference_scale;
pub mod preferences;
pub mod question;
pub mod rank_correlation;
pub mod score_agreement;
pub mod session;
pub mod study;
