//! The command `tune evaluate`.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use filters::{Settings, Value};
use measure::{Error, FilterChoice, read_text};
use terminal::output::print_json;

use super::CandidateArgs;
use crate::evaluator::evaluate_candidate;
use crate::trial::Objective;

/// Arguments of `tune evaluate`.
#[derive(Debug, Args)]
pub struct EvaluateArgs {
    /// Filter and scenes.
    #[command(flatten)]
    pub candidate: CandidateArgs,
    /// JSON file with the parameters that differ from the preset: {"samples": 12}
    #[arg(help_heading = "Filters", long, value_name = "FILE")]
    pub params: PathBuf,
}

/// Scores one set of parameters on every scene, and prints JSON.
pub fn execute(args: &EvaluateArgs) -> Result<(), Error> {
    let candidate = &args.candidate;
    let choice = candidate.select()?;
    let settings = read_params(&args.params, &choice)?;
    let [bleed, cost] = [Objective::Bleed, Objective::Cost]
        .map(|objective| candidate.objective.contains(&objective));
    let scores = candidate.score(&choice, bleed, None, |evaluator| {
        let all: Vec<usize> = (0..evaluator.targets.len()).collect();
        evaluate_candidate(evaluator, &settings, &all, cost, |_, _| true)
    })?;
    print_json(&scores)
}

fn read_params(path: &Path, choice: &FilterChoice) -> Result<Settings, Error> {
    let refuse = |reason: String| Error::Refused(format!("{}: {reason}", path.display()));
    let values = serde_json::from_str(&read_text(path)?).map_err(|error| {
        refuse(format!(
            "{error}; allowed: one table of parameters, such as {{\"samples\": 12}}"
        ))
    })?;
    change_settings(choice, values).map_err(|error| refuse(error.to_string()))
}

/// Replaces some of the preset's values.
fn change_settings(
    choice: &FilterChoice,
    values: BTreeMap<String, Value>,
) -> Result<Settings, filters::FilterError> {
    let mut settings = choice.settings.clone();
    for (name, value) in values {
        // JSON may write 2.0 as 2.
        let kind = choice
            .filter
            .parameters
            .iter()
            .find(|parameter| parameter.name == name);
        let value = match (kind.map(|parameter| &parameter.kind), value) {
            (Some(filters::Kind::Real { .. }), Value::Integer(whole)) => {
                Value::Real(f64::from(whole))
            }
            (_, value) => value,
        };
        settings.set_value(&choice.filter, &name, value)?;
    }
    Ok(settings)
}
