//! `[preset.source]` of filter.toml.

use serde::Deserialize;
use toml::Spanned;

use super::file::File;
use crate::{Code, FilterError, Source};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SourceEntry {
    repository: Option<Spanned<String>>,
    commit: Option<Spanned<String>>,
    paths: Option<Spanned<Vec<String>>>,
    publication: Option<Spanned<String>>,
    #[serde(default)]
    differs: Vec<Spanned<String>>,
}

/// Number of digits of a commit.
const COMMIT_DIGITS: usize = 40;

/// Reads the work that a preset follows.
pub(super) fn read_source(
    file: &File,
    preset: &str,
    entry: Option<&Spanned<SourceEntry>>,
) -> Result<Option<Source>, FilterError> {
    let Some(spanned) = entry else {
        return Ok(None);
    };
    let entry = spanned.get_ref();
    let named = |reason: &str| format!("preset \"{preset}\": source: {reason}");
    for text in (entry.publication.iter()).chain(&entry.differs) {
        file.check_line(text, &named("text"), text.get_ref())?;
        if text.get_ref().trim().is_empty() {
            let reason = "an empty text; allowed: a sentence, or leave it out";
            return Err(file.at(text, named(reason)));
        }
    }
    let code = match (&entry.repository, &entry.commit, &entry.paths) {
        (None, None, None) if entry.publication.is_none() => {
            let reason =
                "names nothing; allowed: repository, commit and paths, or publication, or all four";
            return Err(file.at(spanned, named(reason)));
        }
        (None, None, None) => None,
        (Some(repository), Some(commit), Some(paths)) => {
            Some(read_code(file, (repository, commit, paths), named)?)
        }
        (repository, commit, paths) => {
            let given = [
                ("repository", repository.is_some()),
                ("commit", commit.is_some()),
                ("paths", paths.is_some()),
            ];
            let missing = given.iter().filter(|(_, given)| !given);
            let missing: Vec<&str> = missing.map(|(key, _)| *key).collect();
            let reason = format!(
                "{} is missing; repository, commit and paths go together",
                missing.join(" and ")
            );
            return Err(file.at(spanned, named(&reason)));
        }
    };
    Ok(Some(Source {
        code,
        publication: entry.publication.as_ref().map(|it| it.get_ref().clone()),
        differs: (entry.differs.iter())
            .map(|it| it.get_ref().clone())
            .collect(),
    }))
}

type CodeEntry<'a> = (
    &'a Spanned<String>,
    &'a Spanned<String>,
    &'a Spanned<Vec<String>>,
);

fn read_code(
    file: &File,
    (repository, commit, paths): CodeEntry,
    named: impl Fn(&str) -> String,
) -> Result<Code, FilterError> {
    let address = repository.get_ref();
    file.check_line(repository, &named("repository"), address)?;
    for path in paths.get_ref() {
        file.check_line(paths, &named("paths"), path)?;
    }
    if address.strip_prefix("https://").is_none_or(str::is_empty) {
        let reason =
            format!("repository = \"{address}\"; allowed: an address that begins with https://");
        return Err(file.at(repository, named(&reason)));
    }
    let name = commit.get_ref();
    let is_digit = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
    if name.len() != COMMIT_DIGITS || !name.chars().all(is_digit) {
        let reason = format!(
            "commit = \"{name}\"; allowed: all {COMMIT_DIGITS} digits of 0-9 and a-f that `git rev-parse` prints"
        );
        return Err(file.at(commit, named(&reason)));
    }
    let is_path = |path: &String| !path.is_empty() && !path.starts_with('/');
    if paths.get_ref().is_empty() || !paths.get_ref().iter().all(is_path) {
        let reason = format!(
            "paths = {:?}; allowed: one file or more, each from the top of the repository",
            paths.get_ref()
        );
        return Err(file.at(paths, named(&reason)));
    }
    Ok(Code {
        repository: address.clone(),
        commit: name.clone(),
        paths: paths.get_ref().clone(),
    })
}
