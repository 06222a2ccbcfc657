//! Questions to people about the pictures of a run, and what follows from their answers.

pub mod agreement;
pub mod answers;
pub mod clips;
pub mod design;
pub mod preferences;
pub mod question;
pub mod score_agreement;
pub mod session;
pub mod study;
