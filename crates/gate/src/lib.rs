//! The gate of a CI: checks a run by its limits and by a baseline, accepts the scores of a run as a
//! baseline, and proposes limits.

mod baseline;
mod calibrate;
mod check;
mod command;
mod tables;

pub use self::baseline::{
    Acceptance, Baseline, BaselineComparison, ComparisonKind, DecidedBy, accept_scores,
    compare_with_baseline,
};
pub use self::calibrate::{Calibration, calibrate, default_metrics};
pub use self::check::{CHECK_FORMAT, Check, check};
pub use self::command::accept::{AcceptArgs, execute as execute_accept};
pub use self::command::calibrate::{CalibrateArgs, execute as execute_calibrate};
pub use self::command::check::{CheckArgs, execute as execute_check};
pub use self::tables::{annotations, check_text, junit, summary};
