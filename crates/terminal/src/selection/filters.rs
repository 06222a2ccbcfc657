//! Selection of filters, their presets and overrides.

use std::path::{Path, PathBuf};

use filters::Filter;
use measure::{Error, FilterChoice};

use super::names::{
    find_twin, is_path, is_pattern, match_names, refuse_empty_names, suggest_names,
};

/// Permission to select filters that are programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Programs {
    /// They may be selected: the caller allowed it, or does not run them.
    Allowed,
    /// They are refused: a filter folder may come from anybody.
    Refused,
}

/// Loads the named filters, or every built-in one.
///
/// A name is a built-in filter, a pattern of them, or a filter folder, with an optional `:preset`,
/// which may also be a pattern. Without a preset, in the name or for all, every preset of the
/// filter is selected. `overrides` are `filter.parameter=value`. Filters that are programs are
/// refused unless `programs` allows them.
pub fn select_filters(
    names: &[String],
    preset: Option<&str>,
    overrides: &[String],
    programs: Programs,
) -> Result<Vec<FilterChoice>, Error> {
    refuse_empty_names("--filter", names)?;
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
        for filter in load_filters(name)? {
            for preset in find_presets(&filter, own_preset.or(preset))? {
                choices.push(FilterChoice::new(filter.clone(), &preset)?);
            }
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

/// Loads the filters of a name, a pattern or a path. A built-in filter has priority over a folder
/// of the same name.
pub fn load_filters(name: &str) -> Result<Vec<Filter>, Error> {
    if is_path(name) {
        return Ok(vec![Filter::load(Path::new(name))?]);
    }
    let known = Filter::builtin_names();
    let matched = match_names("--filter", name, &known)?;
    if !matched.is_empty() {
        let loaded = matched.iter().map(|name| Filter::builtin(name));
        return Ok(loaded.collect::<Result<_, _>>()?);
    }
    if Path::new(name).is_dir() {
        return Ok(vec![Filter::load(&Path::new(".").join(name))?]);
    }
    refuse!(
        "--filter: no built-in filter is called \"{name}\"; {} A filter of your own is named by its folder, such as ./{name}",
        suggest_names(name, &known)
    )
}

/// Lists the folders among the names of filters.
pub fn filter_folders(names: &[String]) -> Vec<PathBuf> {
    let builtin = Filter::builtin_names();
    let folders = names.iter().filter_map(|text| {
        let name = match text.rsplit_once(':') {
            Some((name, preset)) if !preset.contains(['/', '\\']) => name,
            _ => text.as_str(),
        };
        let is_folder = !builtin.iter().any(|known| known == name) && Path::new(name).is_dir();
        is_folder.then(|| PathBuf::from(name))
    });
    folders.collect()
}

/// Lists a filter's presets that match a name or a pattern, or all of them.
fn find_presets(filter: &Filter, text: Option<&str>) -> Result<Vec<String>, Error> {
    let known: Vec<String> = (filter.presets.iter())
        .map(|preset| preset.name.clone())
        .collect();
    let Some(text) = text else {
        return Ok(known);
    };
    match match_names("--filter", text, &known)? {
        matched if !matched.is_empty() => Ok(matched),
        _ if is_pattern(text) => refuse!(
            "--filter: no preset of {} matches '{text}'; allowed: {}",
            filter.name,
            known.join(", ")
        ),
        _ => Ok(vec![text.to_owned()]),
    }
}

fn refuse_programs(choices: &[FilterChoice]) -> Result<(), Error> {
    match choices
        .iter()
        .find_map(|choice| choice.filter.command.as_ref())
    {
        None => Ok(()),
        Some(command) => refuse!(
            "{}:{}: the filter is a program and would run `{}`; read what that does, and allow it with --allow-commands",
            command.manifest.display(),
            command.line,
            command.words.join(" ")
        ),
    }
}

/// Refuses a preset that is named twice, and two filters of one name: both would share a folder and
/// count twice.
fn refuse_duplicates(choices: &[FilterChoice]) -> Result<(), Error> {
    let names: Vec<String> = choices.iter().map(FilterChoice::name).collect();
    match find_twin(&names) {
        None => Ok(()),
        Some(name) => refuse!(
            "--filter: {name} is named twice; allowed: each filter and preset once; give a folder of your own \
             another name in its filter.toml"
        ),
    }
}

fn apply_override(choices: &mut [FilterChoice], text: &str) -> Result<(), Error> {
    let parts = text.split_once('=').and_then(|(place, value)| {
        let (filter, parameter) = place.split_once('.')?;
        Some((filter, parameter, value))
    });
    let Some((name, parameter, value)) = parts else {
        refuse!("--set {text}; allowed: filter.parameter=value, such as jump_flood.samples=16");
    };
    let mut names: Vec<String> = (choices.iter())
        .map(|choice| choice.filter.name.clone())
        .collect();
    if !names.iter().any(|known| known == name) {
        names.dedup();
        refuse!(
            "--set {text}: no filter \"{name}\" is in the run; allowed: {}",
            names.join(", ")
        );
    }
    for choice in choices.iter_mut() {
        if choice.filter.name == name {
            choice.set(parameter, value)?;
        }
    }
    Ok(())
}
