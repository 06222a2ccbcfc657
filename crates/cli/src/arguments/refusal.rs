//! Text of an error in the command line.

use std::ffi::OsString;

use clap::Command;
use clap::error::{ContextKind, ContextValue, ErrorKind};

use super::groups::{command_line, list_commands};
use crate::selection::suggest_names;

/// Writes the place, what was found, what is allowed, and the way out. `words` are those of the command line.
pub fn refusal_text(error: &clap::Error, words: &[OsString]) -> String {
    let command = find_command(words);
    let place = match &command {
        Some(command) => format!("shuttertruth {}", command.get_name()),
        None => "shuttertruth".to_owned(),
    };
    let help = match &command {
        Some(command) => format!("shuttertruth help {} says more", command.get_name()),
        None => "shuttertruth --help lists the commands".to_owned(),
    };
    let argument = context(error, ContextKind::InvalidArg);
    let value = context(error, ContextKind::InvalidValue).unwrap_or_default();
    match (error.kind(), argument) {
        (ErrorKind::InvalidSubcommand, _) => {
            let word = context(error, ContextKind::InvalidSubcommand).unwrap_or_default();
            format!(
                "no command \"{word}\"; {}",
                suggest_names(&word, &list_commands())
            )
        }
        (ErrorKind::UnknownArgument, Some(option)) if option.starts_with('-') => {
            match suggest_option(error, &option, command.as_ref()) {
                Some(meant) => format!("no option {option}; did you mean {meant}?"),
                None => format!("{place}: no option {option}; {help}"),
            }
        }
        (ErrorKind::UnknownArgument, Some(word)) => format!(
            "{place}: found {}; allowed: {}; {help}",
            quoted(&word),
            allowed_words(command.as_ref(), &word)
        ),
        (ErrorKind::InvalidValue, Some(option)) if value.is_empty() => format!(
            "{place}: {} has no value; allowed: {}",
            name_of(&option),
            match list(error, ContextKind::ValidValue).as_slice() {
                [] => option,
                values => values.join(", "),
            }
        ),
        (ErrorKind::InvalidValue, Some(option)) => format!(
            "{place}: {} {} is not known; {}",
            name_of(&option),
            quoted(&value),
            suggest_names(&value, &list(error, ContextKind::ValidValue))
        ),
        (ErrorKind::ValueValidation, Some(option)) => {
            let reason = std::error::Error::source(error).map(ToString::to_string);
            format!(
                "{place}: {} {}; {}",
                name_of(&option),
                quoted(&value),
                reason.unwrap_or(help)
            )
        }
        (ErrorKind::TooManyValues, Some(option)) => {
            format!(
                "{place}: {} {}; allowed: {option} without a value",
                name_of(&option),
                quoted(&value)
            )
        }
        (ErrorKind::MissingRequiredArgument, _) => {
            let missing = list(error, ContextKind::InvalidArg);
            let verb = if missing.len() == 1 { "is" } else { "are" };
            format!("{place}: {} {verb} missing; {help}", joined(&missing))
        }
        (ErrorKind::ArgumentConflict, Some(option)) => {
            let others = list(error, ContextKind::PriorArg);
            let others: Vec<String> = others.iter().map(|other| name_of(other)).collect();
            let option = name_of(&option);
            match others.is_empty() || others == [option.as_str()] {
                true => format!("{place}: {option} is given twice; allowed: once"),
                false => format!(
                    "{place}: {option} cannot be used with {}; leave one of them out",
                    joined(&others)
                ),
            }
        }
        (ErrorKind::InvalidUtf8, _) => {
            let word = words.iter().find(|word| word.to_str().is_none());
            let word = word.map(|word| word.to_string_lossy()).unwrap_or_default();
            format!(
                "{place}: found {}, which is no UTF-8; allowed: other bytes in paths alone",
                quoted(&word)
            )
        }
        (kind, _) => format!("{place}: {kind}; {help}"),
    }
}

/// Finds the command among the words.
fn find_command(words: &[OsString]) -> Option<Command> {
    let program = command_line();
    (words.iter().filter_map(|word| word.to_str()))
        .find_map(|word| program.find_subcommand(word))
        .cloned()
}

fn context(error: &clap::Error, kind: ContextKind) -> Option<String> {
    match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.clone()),
        _ => None,
    }
}

fn list(error: &clap::Error, kind: ContextKind) -> Vec<String> {
    match error.get(kind) {
        Some(ContextValue::Strings(texts)) => texts.clone(),
        Some(ContextValue::String(text)) => vec![text.clone()],
        _ => Vec::new(),
    }
}

/// Suggests an option for a misspelt one, or for one that stands before its command.
fn suggest_option(error: &clap::Error, option: &str, command: Option<&Command>) -> Option<String> {
    let program = command_line();
    let has_it = |command: &&Command| {
        let mut longs = command.get_arguments().filter_map(clap::Arg::get_long);
        option
            .strip_prefix("--")
            .is_some_and(|own| longs.any(|long| long == own))
    };
    let of_command = match command {
        Some(command) => Some(command).filter(has_it),
        None => program.get_subcommands().find(has_it),
    };
    of_command
        .map(|command| format!("shuttertruth {} {option}", command.get_name()))
        .or_else(|| context(error, ContextKind::SuggestedArg))
}

/// Takes the name of an argument from its usage: `--size` from `--size <WxH>`, `RUN` from `[RUN]`.
fn name_of(usage: &str) -> String {
    let name = usage.split(' ').next().unwrap_or_default();
    name.trim_matches(['<', '>', '[', ']', '.']).to_owned()
}

/// Says which words a command takes that begin with no hyphen; most names belong to options.
fn allowed_words(command: Option<&Command>, word: &str) -> String {
    let arguments = command.map(|command| command.get_arguments().collect());
    let arguments: Vec<&clap::Arg> = arguments.unwrap_or_default();
    let words: Vec<String> = (arguments.iter())
        .filter(|argument| argument.is_positional())
        .map(|argument| name_of(&argument.to_string()))
        .collect();
    let options: Vec<String> = (arguments.iter().filter_map(|argument| argument.get_long()))
        .filter(|option| ["scenes", "filter"].contains(option))
        .map(|option| format!("--{option} {}", quoted(word)))
        .collect();
    match (words.is_empty(), options.is_empty()) {
        (false, _) => joined(&words),
        (true, false) => format!(
            "options, such as {}",
            joined(&options).replace(" and ", " or ")
        ),
        (true, true) => "options alone".to_owned(),
    }
}

/// Joins names as `a, b and c`.
fn joined(names: &[String]) -> String {
    match names {
        [others @ .., last] if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => names.concat(),
    }
}

/// Quotes a word whose ends would not be seen.
fn quoted(word: &str) -> String {
    match word.is_empty() || word.contains(char::is_whitespace) {
        true => format!("\"{word}\""),
        false => word.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parses a command line that is refused.
    fn refused(words: &[OsString]) -> (ErrorKind, String) {
        let all = [&[OsString::from("shuttertruth")], words].concat();
        let error = command_line().try_get_matches_from(all).unwrap_err();
        (error.kind(), refusal_text(&error, words))
    }

    #[test]
    fn every_error_names_place_finding_allowed_values_and_way_out() {
        for (line, kind, expected) in [
            (
                "rnu",
                ErrorKind::InvalidSubcommand,
                "no command \"rnu\"; did you mean run?",
            ),
            (
                "run --sceens railing",
                ErrorKind::UnknownArgument,
                "no option --sceens; did you mean --scenes?",
            ),
            (
                "--scenes railing",
                ErrorKind::UnknownArgument,
                "no option --scenes; did you mean shuttertruth run --scenes?",
            ),
            (
                "--size 9x9 check",
                ErrorKind::UnknownArgument,
                "no option --size; did you mean shuttertruth check --size?",
            ),
            (
                "merge a --jobs",
                ErrorKind::UnknownArgument,
                "shuttertruth merge: no option --jobs; shuttertruth help merge says more",
            ),
            (
                "run railing",
                ErrorKind::UnknownArgument,
                "shuttertruth run: found railing; allowed: options, such as --scenes railing or --filter railing; \
                 shuttertruth help run says more",
            ),
            (
                "compare a b c",
                ErrorKind::UnknownArgument,
                "shuttertruth compare: found c; allowed: RUN_A and RUN_B; shuttertruth help compare says more",
            ),
            (
                "accept all",
                ErrorKind::UnknownArgument,
                "shuttertruth accept: found all; allowed: options alone; shuttertruth help accept says more",
            ),
            (
                "run --size",
                ErrorKind::InvalidValue,
                "shuttertruth run: --size has no value; allowed: --size <WxH>",
            ),
            (
                "run --depth-format",
                ErrorKind::InvalidValue,
                "shuttertruth run: --depth-format has no value; allowed: float32, float16, reversed24, reversed32",
            ),
            (
                "run --depth-format flaot16",
                ErrorKind::InvalidValue,
                "shuttertruth run: --depth-format flaot16 is not known; did you mean float16?",
            ),
            (
                "run --size 10",
                ErrorKind::ValueValidation,
                "shuttertruth run: --size 10; allowed: WIDTHxHEIGHT, each from 16 to 16384 pixels, such as 640x360",
            ),
            (
                "run --seed -1",
                ErrorKind::ValueValidation,
                "shuttertruth run: --seed -1; allowed: a whole number, 0 or more, and not too large",
            ),
            (
                "run --color=red",
                ErrorKind::ValueValidation,
                "shuttertruth run: --color red; allowed: auto, always or never",
            ),
            (
                "accept --reason x --only [",
                ErrorKind::ValueValidation,
                "shuttertruth accept: --only [; Pattern syntax error near position 0: invalid range pattern; \
                 allowed: a pattern such as 'fan/*' or '*/jump_flood:*'",
            ),
            (
                "run --json=yes",
                ErrorKind::TooManyValues,
                "shuttertruth run: --json yes; allowed: --json without a value",
            ),
            (
                "score --truth a.exr",
                ErrorKind::MissingRequiredArgument,
                "shuttertruth score: --frame <FILE> and --image <FILE|DIR> are missing; shuttertruth help score says more",
            ),
            (
                "import",
                ErrorKind::MissingRequiredArgument,
                "shuttertruth import: <MODEL.OBJ> is missing; shuttertruth help import says more",
            ),
            (
                "check --evidence",
                ErrorKind::MissingRequiredArgument,
                "shuttertruth check: <RUN> is missing; shuttertruth help check says more",
            ),
            (
                "run --table --json",
                ErrorKind::ArgumentConflict,
                "shuttertruth run: --table cannot be used with --json; leave one of them out",
            ),
            (
                "check out --size 16x16 --seed 2",
                ErrorKind::ArgumentConflict,
                "shuttertruth check: RUN cannot be used with --size and --seed; leave one of them out",
            ),
            (
                "run --seed 1 --seed 2",
                ErrorKind::ArgumentConflict,
                "shuttertruth run: --seed is given twice; allowed: once",
            ),
        ] {
            let words: Vec<OsString> = line.split(' ').map(OsString::from).collect();
            assert_eq!(refused(&words), (kind, expected.to_owned()), "{line}");
        }
        assert_eq!(
            refused(&["run".into(), "two spheres".into()]).1,
            "shuttertruth run: found \"two spheres\"; allowed: options, such as --scenes \"two spheres\" or --filter \
             \"two spheres\"; shuttertruth help run says more"
        );
    }

    #[cfg(unix)]
    #[test]
    fn a_name_that_is_no_utf_8_is_refused() {
        use std::os::unix::ffi::OsStringExt;
        let name = OsString::from_vec(b"caf\xe9".to_vec());
        assert_eq!(
            refused(&["run".into(), "--filter".into(), name]),
            (
                ErrorKind::InvalidUtf8,
                "shuttertruth run: found caf\u{fffd}, which is no UTF-8; allowed: other bytes in paths alone".to_owned()
            )
        );
    }

    /// So the kinds `NoEquals`, `TooFewValues`, `WrongNumberOfValues` and `MissingSubcommand` cannot occur.
    #[test]
    fn no_option_asks_for_several_values_or_for_an_equals_sign() {
        let program = command_line();
        assert!(!program.is_subcommand_required_set());
        for command in program.get_subcommands() {
            for argument in command.get_arguments() {
                let least = argument
                    .get_num_args()
                    .map_or(1, |range| range.min_values());
                assert!(
                    least <= 1 && !argument.is_require_equals_set(),
                    "{argument}"
                );
            }
        }
    }
}
