//! Options as this command line gives them, for the command lines of jobs.

use std::ffi::OsString;

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, Args, Command};
use suite::Error;

use super::arguments::PlanArgs;
use crate::output::OutputArgs;

/// Name of the command.
const PLAN: &str = "plan";

/// Lists the options of this command line that the command with the arguments `A` has as well, each with its values, but for those
/// whose long names are in `but`.
///
/// # Errors
/// A value is not UTF-8.
pub fn given_options<A: Args>(but: &[&str]) -> Result<Vec<String>, Error> {
    let own = std::env::args_os().skip_while(|word| word != PLAN);
    let plan = OutputArgs::augment_args(PlanArgs::augment_args(Command::new(PLAN)));
    let given = plan.get_matches_from(own);
    let command = A::augment_args(Command::new("job"));
    let mut words = Vec::new();
    for option in command.get_arguments() {
        if let Some(long) = option.get_long()
            && !but.contains(&long)
            && is_given(&given, option)
        {
            push_option(&mut words, &given, option, long)?;
        }
    }
    Ok(words)
}

fn is_given(given: &ArgMatches, option: &Arg) -> bool {
    let id = option.get_id().as_str();
    given.try_contains_id(id).unwrap_or(false)
        && given.value_source(id) == Some(ValueSource::CommandLine)
}

/// Adds an option once per value, or alone if it takes none.
fn push_option(
    words: &mut Vec<String>,
    given: &ArgMatches,
    option: &Arg,
    long: &str,
) -> Result<(), Error> {
    if !option.get_action().takes_values() {
        words.push(format!("--{long}"));
        return Ok(());
    }
    for value in given
        .get_raw(option.get_id().as_str())
        .into_iter()
        .flatten()
    {
        words.extend([format!("--{long}"), text_of(value.to_owned())?]);
    }
    Ok(())
}

/// Lists the words behind the name of this command, without some options: pairs of a long name, and true if a value follows.
///
/// # Errors
/// A word is not UTF-8.
pub fn words_behind(but: &[(&str, bool)]) -> Result<Vec<String>, Error> {
    let mut behind = (std::env::args_os().skip_while(|word| word != PLAN).skip(1))
        .map(text_of)
        .collect::<Result<Vec<String>, Error>>()?
        .into_iter();
    let mut words = Vec::new();
    while let Some(word) = behind.next() {
        let left_out = but.iter().find(|(long, has_value)| {
            let rest = word
                .strip_prefix("--")
                .and_then(|word| word.strip_prefix(long));
            rest.is_some_and(|rest| rest.is_empty() || (*has_value && rest.starts_with('=')))
        });
        match left_out {
            None => words.push(word),
            Some((_, true)) if !word.contains('=') => drop(behind.next()),
            Some(_) => {}
        }
    }
    Ok(words)
}

fn text_of(word: OsString) -> Result<String, Error> {
    word.into_string().map_err(|word| {
        Error::Usage(format!(
            "{}: is not UTF-8, which the command line of a job must be; rename it",
            word.display()
        ))
    })
}
