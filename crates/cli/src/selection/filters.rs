//! Selection of filters, their presets and overrides.

use std::path::Path;

use filters::Filter;
use suite::{Error, FilterChoice};

use super::path::is_path;

/// Permission to select filters that are programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Programs {
    /// They may be selected: the caller allowed it, or does not run them.
    Allowed,
    /// They are refused: a filter folder may come from anybody.
    Refused,
}

/// Loads the named filters; every built-in one where none is named.
///
/// A name is that of a built-in filter or the path of a filter folder, then optionally `:preset`. Without a preset, in
/// the name or for all, each preset of the filter is taken. `overrides` are `filter.parameter=value`. Filters that are
/// programs are refused unless `programs` allows them.
pub fn select_filters(
    names: &[String],
    preset: Option<&str>,
    overrides: &[String],
    programs: Programs,
) -> Result<Vec<FilterChoice>, Error> {
    let names = if names.is_empty() {
        Filter::builtin_names()
    } else {
        names.to_vec()
    };
    let mut choices: Vec<FilterChoice> = Vec::new();
    for text in &names {
        let (name, own_preset) = match text.rsplit_once(':') {
            Some((name, preset)) if !preset.contains(['/', '\\']) => (name, Some(preset)),
            _ => (text.as_str(), None),
        };
        let load = || match is_path(name) {
            true => Filter::load(Path::new(name)),
            false => Filter::builtin(name),
        };
        let presets = match own_preset.or(preset) {
            Some(preset) => vec![preset.to_owned()],
            None => load()?
                .presets
                .into_iter()
                .map(|preset| preset.name)
                .collect(),
        };
        for preset in presets {
            choices.push(FilterChoice::new(load()?, &preset)?);
        }
    }
    if programs == Programs::Refused {
        refuse_programs(&choices)?;
    }
    for text in overrides {
        apply_override(&mut choices, text)?;
    }
    refuse_duplicates(&choices)?;
    Ok(choices)
}

fn refuse_programs(choices: &[FilterChoice]) -> Result<(), Error> {
    match choices.iter().find_map(|it| it.filter.command.as_ref()) {
        None => Ok(()),
        Some(command) => Err(Error::Usage(format!(
            "{}:{}: the filter is a program and would run `{}`; read what that does, and allow it with --allow-commands",
            command.manifest.display(),
            command.line,
            command.words().join(" ")
        ))),
    }
}

/// Refuses a preset that is named twice, or two filters of one name: both would be written to one folder and counted as two.
fn refuse_duplicates(choices: &[FilterChoice]) -> Result<(), Error> {
    for (index, choice) in choices.iter().enumerate() {
        let name = choice.name();
        if choices[..index].iter().any(|other| other.name() == name) {
            return Err(Error::Usage(format!(
                "--filters: {name} is named twice; allowed: each filter and preset once; give a folder of your own \
                 another name in its filter.toml"
            )));
        }
    }
    Ok(())
}

fn apply_override(choices: &mut [FilterChoice], text: &str) -> Result<(), Error> {
    let parts = text.split_once('=').and_then(|(place, value)| {
        place
            .split_once('.')
            .map(|(filter, parameter)| (filter, parameter, value))
    });
    let Some((name, parameter, value)) = parts else {
        return Err(Error::Usage(format!(
            "--set {text}: allowed is filter.parameter=value, such as jump_flood.samples=16"
        )));
    };
    let mut found = false;
    for choice in choices
        .iter_mut()
        .filter(|choice| choice.filter.name == name)
    {
        choice.settings.set(&choice.filter, parameter, value)?;
        found = true;
    }
    if found {
        return Ok(());
    }
    let mut names: Vec<&str> = choices
        .iter()
        .map(|choice| choice.filter.name.as_str())
        .collect();
    names.dedup();
    Err(Error::Usage(format!(
        "--set {text}: no filter \"{name}\" takes part; allowed: {}",
        names.join(", ")
    )))
}
