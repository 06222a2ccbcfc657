//! Filter folders from disk: the documented one, built-in ones, and wrong ones.

mod example;
mod inputs;
mod notes;
mod textures;

use crate::filter_files::FilterFiles;

const README: &str = include_str!("../../../shaders/README.md");

/// Returns the first code block in this language in shaders/README.md.
pub fn example(language: &str) -> &'static str {
    let start = README.split_once(&format!("```{language}\n")).unwrap().1;
    start.split_once("```").unwrap().0
}

/// Returns the files of the documented example.
pub fn documented() -> FilterFiles {
    FilterFiles::default()
        .with("filter.toml", example("toml"))
        .with("centre_blur.wgsl", example("c"))
}
