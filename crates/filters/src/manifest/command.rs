//! `command` and `environment` of filter.toml.

use toml::Spanned;

use super::file::File;
use crate::filter::{PLACEHOLDERS, fill_placeholders};
use crate::{Command, FilterError, Parameter};

/// Reads the words of a command; refuses unknown placeholders, and a command without those that it needs.
pub(super) fn read_command(
    file: &File,
    words: &Spanned<Vec<String>>,
    parameters: &[Parameter],
) -> Result<Command, FilterError> {
    let refuse = |reason: String| file.at(words, format!("command: {reason}"));
    let Some((program, arguments)) = words.get_ref().split_first() else {
        return Err(refuse("is empty; its first word is the program".into()));
    };
    if program.is_empty() {
        return Err(refuse("its first word, the program, is empty".into()));
    }
    let names: Vec<&str> = parameters.iter().map(|known| known.name.as_str()).collect();
    if let Some(name) = names.iter().find(|name| PLACEHOLDERS.contains(name)) {
        return Err(refuse(format!(
            "{{{name}}} already stands for something of the frame; call the parameter otherwise"
        )));
    }
    let mut found = Vec::new();
    for word in arguments {
        fill_placeholders(word, |name| {
            found.push(name.to_owned());
            let known = PLACEHOLDERS.contains(&name) || names.contains(&name);
            known.then(String::new)
        })
        .map_err(|reason| {
            let allowed: Vec<String> = (PLACEHOLDERS.iter().chain(&names))
                .map(|name| format!("{{{name}}}"))
                .collect();
            refuse(format!(
                "\"{word}\" {reason}; allowed: {}, and {{{{ or }}}} for a brace",
                allowed.join(", ")
            ))
        })?;
    }
    for (name, why) in [
        ("frame", "the file to be blurred"),
        ("out", "the file to be written"),
    ]
    .into_iter()
    .chain(names.iter().map(|name| (*name, "a declared parameter")))
    {
        if !found.iter().any(|word| word == name) {
            return Err(refuse(format!(
                "{{{name}}} is missing: it stands for {why}"
            )));
        }
    }
    Ok(Command {
        program: program.clone(),
        arguments: arguments.to_vec(),
        folder: find_folder(file)?,
        environment: Vec::new(),
        manifest: file.path.to_owned(),
        line: file.line(words.span().start),
    })
}

/// Adds the variables that the command is to get.
pub(super) fn add_environment(
    file: &File,
    names: Option<&Spanned<Vec<String>>>,
    command: Option<Command>,
) -> Result<Option<Command>, FilterError> {
    let Some(names) = names else {
        return Ok(command);
    };
    let refuse = |reason: String| Err(file.at(names, format!("environment: {reason}")));
    let Some(command) = command else {
        return refuse("is for a program; kernels have none".into());
    };
    if let Some(name) = names.get_ref().iter().find(|name| !is_variable(name)) {
        return refuse(format!(
            "\"{name}\" names no variable; allowed: letters, digits and _, and no digit first; the value comes from \
             whoever runs the program"
        ));
    }
    Ok(Some(Command {
        environment: names.get_ref().clone(),
        ..command
    }))
}

fn is_variable(name: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    name.chars().all(is_part) && name.starts_with(|first: char| !first.is_ascii_digit())
}

/// Finds the absolute folder of filter.toml, which holds wherever a program is started.
fn find_folder(file: &File) -> Result<std::path::PathBuf, FilterError> {
    let manifest = std::path::absolute(file.path)
        .map_err(|error| file.refuse(None, format!("its folder cannot be found: {error}")))?;
    let folder = manifest.parent().expect("a file lies in a folder");
    Ok(folder.to_owned())
}
