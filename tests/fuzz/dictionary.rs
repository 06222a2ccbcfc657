//! Useful words for inputs, from `dictionaries.toml`.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use serde::Deserialize;

#[derive(Deserialize)]
struct Dictionary {
    #[serde(default)]
    lines: String,
    #[serde(default)]
    words: Vec<String>,
}

static ALL: LazyLock<BTreeMap<String, Vec<String>>> = LazyLock::new(|| {
    let text = include_str!("dictionaries.toml");
    let parsed: BTreeMap<String, Dictionary> = toml::from_str(text).expect("dictionaries are TOML");
    let mut all: BTreeMap<String, Vec<String>> = (parsed.into_iter())
        .map(|(name, Dictionary { lines, mut words })| {
            words.extend(lines.split_inclusive('\n').map(str::to_owned));
            (name, words)
        })
        .collect();
    let options = include_str!("../../docs/commands.md").split([' ', '\n', '`', ',', '.']);
    let options: BTreeSet<&str> = options.filter(|word| word.starts_with("--")).collect();
    let command_line = all.get_mut("command_line").expect("it has values");
    command_line.extend(options.into_iter().map(str::to_owned));
    all
});

/// Returns the words of a dictionary.
pub fn words(name: &str) -> &'static [String] {
    (ALL.get(name)).unwrap_or_else(|| panic!("dictionaries.toml has no \"{name}\""))
}
