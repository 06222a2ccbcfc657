//! Questions to people about the pictures of a run, and what follows from their answers.

mod agreement;
mod answers;
mod bradley_terry;
mod clips;
mod design;
mod paired_counts;
mod preference_scale;
mod preferences;
mod question;
mod rank_correlation;
mod score_agreement;
mod session;
mod study;

pub use answers::{Answer, AnswerFile, Chosen, DisplayFacts, SHARP_CLIP, TRUTH_CLIP};
pub use clips::{ClipFiles, StudyChoice, make_study};
pub use design::{Clip, ShownPair, draw_session};
pub use preference_scale::{MIN_PEOPLE, RESAMPLES, Resampled};
pub use preferences::{Preferences, QuestionResult, SessionFacts, ShutterScale, find_preferences};
pub use question::Question;
pub use score_agreement::ScoreAgreement;
pub use session::{read_sessions, refuse_other_run};
pub use study::{SECONDS_PER_QUESTION, Study};
