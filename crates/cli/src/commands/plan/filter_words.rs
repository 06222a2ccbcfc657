//! Filters as words of a job's command line.

use std::path::Path;

use filters::Filter;
use suite::{Error, FilterChoice};

use super::job::files_below;
use super::scene_words::as_path;
use crate::arguments::MeasureArgs;
use crate::selection::{Programs, is_path, select_filters};

/// Some presets of one filter, which one job measures.
pub struct FilterWords {
    /// Name of the job's folder, which no other filter of the plan has.
    pub name: String,
    /// Values of `--filter`.
    pub words: Vec<String>,
    /// Values of `--set`.
    pub overrides: Vec<String>,
    /// Files of a filter of the user's own.
    pub files: Vec<String>,
}

/// Groups the presets of a plan by their filters, in the order of the plan.
pub fn list_filter_words(
    args: &MeasureArgs,
    choices: &[FilterChoice],
) -> Result<Vec<FilterWords>, Error> {
    let given = match args.filters.as_slice() {
        [] => Filter::builtin_names(),
        given => given.to_vec(),
    };
    let mut all: Vec<FilterWords> = Vec::new();
    let mut last = String::new();
    for text in &given {
        let preset = args.preset.as_deref();
        let named = select_filters(std::slice::from_ref(text), preset, &[], Programs::Allowed)?;
        let folder = folder_of(text);
        for choice in named {
            let name = choice.filter.name.clone();
            // The plan has left it out.
            if !choices
                .iter()
                .any(|own| own.filter.name == name && own.preset == choice.preset)
            {
                continue;
            }
            let base = folder.clone().unwrap_or(name.clone());
            let word = format!("{base}:{}", choice.preset);
            if last == base {
                all.last_mut().expect("it is the last").words.push(word);
                continue;
            }
            last = base;
            let like = |other: &&FilterWords| {
                other.name == name || other.name.starts_with(&format!("{name}+"))
            };
            let before = all.iter().filter(like).count();
            let is_own = |set: &&String| set.split('.').next() == Some(name.as_str());
            all.push(FilterWords {
                overrides: args.set.iter().filter(is_own).cloned().collect(),
                files: (folder.as_deref())
                    .map_or(Ok(Vec::new()), |it| files_below(Path::new(it)))?,
                words: vec![word],
                name: match before {
                    0 => name,
                    before => format!("{name}+{before}"),
                },
            });
        }
    }
    Ok(all)
}

/// Returns the folder that a word names; none where it names built-in filters.
fn folder_of(text: &str) -> Option<String> {
    let name = match text.rsplit_once(':') {
        Some((name, preset)) if !preset.contains(['/', '\\']) => name,
        _ => text,
    };
    let is_folder = is_path(name) || (Filter::builtin(name).is_err() && Path::new(name).is_dir());
    is_folder.then(|| as_path(name.to_owned()))
}
