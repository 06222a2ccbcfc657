//! Filter folders from disk: the documented one, built-in ones, and wrong ones.

mod example;
mod inputs;
mod refusals;
mod textures;

use filters::{Filter, FilterError};
use tests::filter_folder::load_filter;

const README: &str = include_str!("../../../shaders/README.md");

/// Returns the first code block in this language in shaders/README.md.
pub fn example(language: &str) -> &'static str {
    let start = README.split_once(&format!("```{language}\n")).unwrap().1;
    start.split_once("```").unwrap().0
}

/// Loads the example with one piece of its files replaced.
fn load_changed(file: &str, from: &str, to: &str) -> Result<Filter, FilterError> {
    let (mut manifest, mut kernels) = (example("toml").to_owned(), example("wgsl").to_owned());
    let text = match file {
        "filter.toml" => &mut manifest,
        _ => &mut kernels,
    };
    assert!(text.contains(from), "the example holds \"{from}\"");
    *text = text.replacen(from, to, 1);
    load_filter("centre_blur", &manifest, &kernels)
}
