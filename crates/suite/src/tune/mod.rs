//! Finds the parameters with which a filter is nearest to the truth, and proves it on scenes that were not looked at.

mod answer;
mod compare;
mod cost;
mod evaluator;
mod journal;
mod loss;
mod pareto;
mod plan;
mod sealed;
mod search;
mod selection;
mod shot;
mod space;
mod table;
mod trial;
mod tuning;
mod wilcoxon;

pub use answer::{Answer, answer};
pub use compare::{Difference, Paired, Preference, compare_paired};
pub use evaluator::Evaluator;
pub use journal::{Header, JOURNAL_FORMAT, Journal};
pub use pareto::front;
pub use plan::{Objective, TunePlan, interleaved};
pub use sealed::Opening;
pub use search::Search;
pub use selection::{Choice, Fold, Limits, choose, folds};
pub use shot::{SceneScore, Shot, Target};
pub use space::Space;
pub use table::{paired_table, preset_text, tuning_table};
pub use trial::{Trial, TrialOutcome};
pub use tuning::{TUNE_FORMAT, Tuning, evaluator, shots, tune};
pub use wilcoxon::probability_not_above;
