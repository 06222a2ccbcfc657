//! `command` and `environment` of filter.toml.

use toml::Spanned;

use super::file::File;
use crate::filter::{PLACEHOLDERS, fill_placeholders};
use crate::{Command, FilterError, Parameter};

/// Reads the words of a command, and the variables that it gets; none for a filter with kernels.
pub(super) fn read_command(
    file: &File,
    words: Option<&Spanned<Vec<String>>>,
    environment: Option<&Spanned<Vec<String>>>,
    parameters: &[Parameter],
) -> Result<Option<Command>, FilterError> {
    if let Some(variables) = environment {
        check_environment(variables.get_ref(), words.is_some())
            .map_err(|reason| file.at(variables, format!("environment: {reason}")))?;
    }
    let Some(words) = words else {
        return Ok(None);
    };
    check_words(words.get_ref(), parameters)
        .map_err(|reason| file.at(words, format!("command: {reason}")))?;
    // The path stays valid wherever the program is started.
    let manifest = std::path::absolute(file.path)
        .map_err(|error| file.refuse(None, format!("its folder cannot be found: {error}")))?;
    Ok(Some(Command {
        words: words.get_ref().clone(),
        folder: (manifest.parent().expect("a file is in a folder")).to_owned(),
        environment: environment.map_or(Vec::new(), |names| names.get_ref().clone()),
        manifest: file.path.to_owned(),
        line: file.line(words.span().start),
    }))
}

/// Refuses a command without a program, unknown placeholders, and a command that lacks required
/// ones.
fn check_words(words: &[String], parameters: &[Parameter]) -> Result<(), String> {
    let Some((program, arguments)) = words.split_first() else {
        return Err("is empty; its first word is the program".into());
    };
    if program.is_empty() {
        return Err("its first word, the program, is empty".into());
    }
    let names: Vec<&str> = parameters.iter().map(|known| known.name.as_str()).collect();
    if let Some(name) = names.iter().find(|name| PLACEHOLDERS.contains(name)) {
        return Err(format!(
            "{{{name}}} is already a value of the frame; rename the parameter"
        ));
    }
    let mut placeholders = Vec::new();
    for word in arguments {
        fill_placeholders(word, |name| {
            placeholders.push(name.to_owned());
            let known = PLACEHOLDERS.contains(&name) || names.contains(&name);
            known.then(String::new)
        })
        .map_err(|reason| {
            let allowed: Vec<String> = (PLACEHOLDERS.iter().chain(&names))
                .map(|name| format!("{{{name}}}"))
                .collect();
            format!(
                "\"{word}\" {reason}; allowed: {}, and {{{{ or }}}} for a brace",
                allowed.join(", ")
            )
        })?;
    }
    let files = [
        ("frame", "the file to be blurred"),
        ("out", "the file to be written"),
    ];
    let declared = names.iter().map(|name| (*name, "a declared parameter"));
    let mut needed = files.into_iter().chain(declared);
    match needed.find(|(name, _)| !placeholders.iter().any(|word| word == name)) {
        None => Ok(()),
        Some((name, why)) => Err(format!("{{{name}}} is missing: it stands for {why}")),
    }
}

/// Refuses variables for kernels, and names that no variable has.
fn check_environment(names: &[String], is_command: bool) -> Result<(), String> {
    if !is_command {
        return Err("is for a program; kernels have none".into());
    }
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let is_variable = |name: &str| {
        name.chars().all(is_part) && name.starts_with(|first: char| !first.is_ascii_digit())
    };
    match names.iter().find(|name| !is_variable(name)) {
        None => Ok(()),
        Some(name) => Err(format!(
            "\"{name}\" names no variable; allowed: letters, digits and _, and no digit first; the value comes from \
             whoever runs the program"
        )),
    }
}
