//! Finds the parameters with which a filter is nearest to the truth, and proves it on scenes that were not looked at.

mod answer;
mod compare;
mod cost;
mod engine;
mod evaluator;
mod journal;
mod loss;
mod pareto;
mod plan;
mod preset;
mod random;
mod sealed;
mod search;
mod selection;
mod sensitivity;
mod shot;
mod sobol;
mod space;
mod trial;
mod trying;
mod tuning;
mod wilcoxon;

pub use answer::{Answer, answer};
pub(crate) use compare::FEWEST_SCENES;
pub use compare::{Difference, Paired, Preference, compare_paired};
pub use evaluator::Evaluator;
pub use journal::{Header, JOURNAL_FORMAT, Journal};
pub use loss::LEAST_BLEED;
pub use loss::log_ratio;
pub use pareto::front;
pub use plan::{Objective, TunePlan, interleaved};
pub use preset::preset_text;
#[cfg(test)]
pub(crate) use random::Random;
pub use sealed::Opening;
pub use search::Search;
pub use selection::{Choice, Fold, Limits, choose, folds};
pub use sensitivity::{ParameterSensitivity, Sensitivity, analyze_sensitivity};
pub use shot::{SceneScore, Shot, Target};
pub use sobol::{Estimate, SobolIndices, sobol_indices};
pub use space::Space;
pub use trial::{Trial, TrialOutcome};
pub use tuning::{TUNE_FORMAT, Tuning, evaluator, shots, tune};
pub use wilcoxon::probability_not_above;
