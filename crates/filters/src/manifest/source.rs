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
    let SourceEntry {
        repository,
        commit,
        paths,
        publication,
        differs,
    } = spanned.get_ref();
    let named = |reason: &str| format!("preset \"{preset}\": source: {reason}");
    for text in publication.iter().chain(differs) {
        file.check_line(text, &named("text"), text.get_ref())?;
        if text.get_ref().trim().is_empty() {
            let reason = "an empty text; allowed: a sentence, or leave it out";
            return Err(file.at(text, named(reason)));
        }
    }
    let keys = [
        ("repository", repository.is_some()),
        ("commit", commit.is_some()),
        ("paths", paths.is_some()),
    ];
    let missing = keys.iter().filter(|(_, given)| !given);
    let missing: Vec<&str> = missing.map(|(key, _)| *key).collect();
    let code = match (repository, commit, paths) {
        (Some(repository), Some(commit), Some(paths)) => {
            Some(read_code(file, repository, commit, paths, named)?)
        }
        _ if missing.len() < keys.len() => {
            let missing = missing.join(" and ");
            let reason = format!("{missing} is missing; repository, commit and paths go together");
            return Err(file.at(spanned, named(&reason)));
        }
        _ if publication.is_none() => {
            let reason =
                "names nothing; allowed: repository, commit and paths, or publication, or all four";
            return Err(file.at(spanned, named(reason)));
        }
        _ => None,
    };
    Ok(Some(Source {
        code,
        publication: publication
            .as_ref()
            .map(|publication| publication.get_ref().clone()),
        differs: differs
            .iter()
            .map(|difference| difference.get_ref().clone())
            .collect(),
    }))
}

fn read_code(
    file: &File,
    repository: &Spanned<String>,
    commit: &Spanned<String>,
    paths: &Spanned<Vec<String>>,
    named: impl Fn(&str) -> String,
) -> Result<Code, FilterError> {
    let code = Code {
        repository: file.check_line(repository, &named("repository"), repository.get_ref())?,
        commit: commit.get_ref().clone(),
        paths: (paths.get_ref().iter())
            .map(|path| file.check_line(paths, &named("paths"), path))
            .collect::<Result<_, _>>()?,
    };
    let address = code.repository.strip_prefix("https://");
    if address.is_none_or(str::is_empty) {
        let reason = format!(
            "repository = \"{}\"; allowed: an address that begins with https://",
            code.repository
        );
        return Err(file.at(repository, named(&reason)));
    }
    let is_digit = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
    if code.commit.len() != COMMIT_DIGITS || !code.commit.chars().all(is_digit) {
        let reason = format!(
            "commit = \"{}\"; allowed: all {COMMIT_DIGITS} digits of 0-9 and a-f that `git rev-parse` prints",
            code.commit
        );
        return Err(file.at(commit, named(&reason)));
    }
    let is_path = |path: &String| !path.is_empty() && !path.starts_with('/');
    if code.paths.is_empty() || !code.paths.iter().all(is_path) {
        let reason = format!(
            "paths = {:?}; allowed: one file or more, each from the top of the repository",
            code.paths
        );
        return Err(file.at(paths, named(&reason)));
    }
    Ok(code)
}
