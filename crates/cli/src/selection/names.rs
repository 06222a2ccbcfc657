//! Names on the command line: patterns, and suggestions for misspelt ones.

use glob::Pattern;
use suite::Error;

/// Similarity from which a known name is suggested for a misspelt one; 1 is equal.
const SIMILAR: f64 = 0.75;

/// Tells whether a text is a pattern, such as `rail*`, and no name.
pub fn is_pattern(text: &str) -> bool {
    text.contains(['*', '?', '['])
}

/// Tells whether a text is a path. A path has a separator; a text without one is a name, whatever lies in the current folder.
pub fn is_path(text: &str) -> bool {
    text.contains(['/', '\\'])
}

/// Lists the known names that a pattern matches.
///
/// # Errors
/// The pattern is malformed.
pub fn match_names(option: &str, text: &str, known: &[String]) -> Result<Vec<String>, Error> {
    let pattern = Pattern::new(text)
        .map_err(|error| Error::Usage(format!("{option}: the pattern '{text}': {error}")))?;
    let matched = known.iter().filter(|name| pattern.matches(name));
    Ok(matched.cloned().collect())
}

/// Chooses the known names that are named or matched by a pattern, in the order of `known`; all where nothing is named.
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
        let matched = match is_pattern(text) {
            true => match_names(option, text, known)?,
            false => (known.iter().filter(|name| *name == text).cloned()).collect(),
        };
        if matched.is_empty() {
            refuse!(
                "{option}: no \"{text}\" there; {}",
                suggest_names(text, known)
            );
        }
        chosen.extend(matched);
    }
    let is_chosen = |name: &&String| texts.is_empty() || chosen.contains(name);
    Ok(known.iter().filter(is_chosen).cloned().collect())
}

/// Refuses a list with an empty name, which a comma too many makes.
pub fn refuse_empty_names(option: &str, names: &[String]) -> Result<(), Error> {
    match names.iter().any(String::is_empty) {
        false => Ok(()),
        true => refuse!(
            "{option}: one of its names is empty; leave out a comma too many, or leave the option out to take all"
        ),
    }
}

/// Compares a word with a name; 1 is equal. One slip of a finger, such as two letters that changed places, is `SIMILAR`.
fn similarity(word: &str, name: &str) -> f64 {
    let slips = strsim::damerau_levenshtein(word, name);
    let least = if slips <= 1 { SIMILAR } else { 0.0 };
    strsim::jaro_winkler(word, name).max(least)
}

/// Says which names are meant or allowed: `did you mean railing?`, or all of them where none is similar.
pub fn suggest_names(text: &str, known: &[String]) -> String {
    let best = known
        .iter()
        .max_by(|a, b| similarity(text, a).total_cmp(&similarity(text, b)));
    match best.filter(|name| similarity(text, name) >= SIMILAR) {
        Some(name) => format!("did you mean {name}?"),
        None => format!("allowed: {}.", known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_gets_a_suggestion_and_another_one_the_list() {
        let known = ["railing", "fan", "two_spheres"].map(str::to_owned);
        for misspelt in ["raling", "Railing", "railings", "rialing"] {
            assert_eq!(suggest_names(misspelt, &known), "did you mean railing?");
        }
        let commands = ["score", "run", "render"].map(str::to_owned);
        assert_eq!(suggest_names("rnu", &commands), "did you mean run?");
        assert_eq!(
            suggest_names("my_scene", &known),
            "allowed: railing, fan, two_spheres."
        );
    }
}
