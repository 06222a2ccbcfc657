//! Names on the command line: patterns, and suggestions for misspelt ones.

use glob::Pattern;
use measure::Error;

/// Smallest similarity of a known name that is suggested for a misspelt one; 1 is equal.
const SIMILAR: f64 = 0.75;

/// Returns whether a text is a pattern, such as `rail*`, rather than a name.
pub fn is_pattern(text: &str) -> bool {
    text.contains(['*', '?', '['])
}

/// Returns whether a text is a path. A path has a separator; other texts are names, whatever the
/// current folder contains.
pub fn is_path(text: &str) -> bool {
    text.contains(['/', '\\'])
}

/// Lists the known names that match a name or a pattern.
///
/// # Errors
/// The pattern is malformed.
pub fn match_names(option: &str, text: &str, known: &[String]) -> Result<Vec<String>, Error> {
    if !is_pattern(text) || known.iter().any(|name| name == text) {
        return Ok((known.iter().filter(|name| *name == text).cloned()).collect());
    }
    let pattern = Pattern::new(text)
        .map_err(|error| Error::Refused(format!("{option}: the pattern '{text}': {error}")))?;
    let matched = known.iter().filter(|name| pattern.matches(name));
    Ok(matched.cloned().collect())
}

/// Chooses the known names that match, in the order of `known`; all without names.
///
/// # Errors
/// A name is unknown, or a pattern is malformed or matches nothing.
pub fn choose_names(
    option: &str,
    texts: &[String],
    known: &[String],
) -> Result<Vec<String>, Error> {
    refuse_empty_names(option, texts)?;
    let mut chosen = Vec::new();
    for text in texts {
        let matched = match_names(option, text, known)?;
        if matched.is_empty() {
            let suggestion = suggest_names(text, known);
            refuse!("{option}: no \"{text}\" there; {suggestion}");
        }
        chosen.extend(matched);
    }
    let is_chosen = |name: &&String| texts.is_empty() || chosen.contains(name);
    Ok(known.iter().filter(is_chosen).cloned().collect())
}

/// Finds the first duplicate.
pub fn find_twin<T: PartialEq>(all: &[T]) -> Option<&T> {
    let is_twin = |(index, item): &(usize, &T)| all[..*index].contains(item);
    all.iter().enumerate().find(is_twin).map(|(_, item)| item)
}

/// Refuses a list with an empty name, from a superfluous comma.
pub fn refuse_empty_names(option: &str, names: &[String]) -> Result<(), Error> {
    if names.iter().any(String::is_empty) {
        refuse!(
            "{option}: one of its names is empty; leave out a comma too many, or leave the option out to take all"
        )
    } else {
        Ok(())
    }
}

/// Compares a word with a name; 1 is equal. One slip, such as two swapped letters, is `SIMILAR`.
fn similarity(word: &str, name: &str) -> f64 {
    let slips = strsim::damerau_levenshtein(word, name);
    let least = if slips <= 1 { SIMILAR } else { 0.0 };
    strsim::jaro_winkler(word, name).max(least)
}

/// Suggests names: `did you mean railing?`, or all of them if none is similar.
pub fn suggest_names(text: &str, known: &[String]) -> String {
    let best = known
        .iter()
        .max_by(|a, b| similarity(text, a).total_cmp(&similarity(text, b)));
    match best.filter(|name| similarity(text, name) >= SIMILAR) {
        Some(name) => format!("did you mean {name}?"),
        None => format!("allowed: {}.", known.join(", ")),
    }
}
