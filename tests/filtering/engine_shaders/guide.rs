//! One blur as each engine would have it: what the guide shows, and what the folders beside it hold.

use std::fs;

use filters::Filter;
use tests::filter_folder::load_filter;
use tests::near::assert_within;
use tests::root;

use super::{blur, busy_picture, largest_difference};
use crate::filter_files::FilterFiles;

const GUIDE: &str = include_str!("../../../docs/add-a-filter.md");

/// Folders whose compiler not every machine has, with its name.
const OPTIONAL: [(&str, &str); 2] = [("bevy_wesl", "wesl"), ("slang", "slangc")];

/// Returns the block of code after a sentence of the guide.
fn block(sentence: &str) -> &'static str {
    let after = GUIDE.split_once(sentence).unwrap().1;
    let block = after.split_once("```").unwrap().1;
    let text = block.split_once('\n').unwrap().1;
    text.split_once("```").unwrap().0
}

/// Asserts that a filter blurs as the guide's kernel does.
fn assert_blurs_as_the_guide(filter: &Filter) {
    let kernel = load_filter(
        "my_blur",
        block("`my_blur/filter.toml` says what it is:"),
        block("`my_blur/my_blur.wgsl` says what it does:"),
    );
    let picture = busy_picture();
    let [expected, found] = [&kernel.unwrap(), filter]
        .map(|filter| blur(filter, &filter.settings(None).unwrap(), &picture));
    // Halves have 11 binary digits: 0.003 of 7 pixels, where neighbours differ by up to 2.5, and 0.001 of colours below 4.
    let difference = largest_difference(&expected, &found);
    assert_within(difference, f64::MIN_POSITIVE..0.02);
}

#[test]
fn the_guide_s_shader_of_godot_s_kind_blurs_as_the_guide_s_kernel_does() {
    let manifest = block("`godot_blur/filter.toml` says what its bindings are:");
    let shader = block("`godot_blur/blur.glsl` is a shader of Godot's kind:");
    let files = FilterFiles::default().with("filter.toml", manifest);
    assert_blurs_as_the_guide(&files.with("blur.glsl", shader).load().unwrap());
}

#[test]
fn every_example_of_the_guide_blurs_as_its_kernel_does() {
    let folders = root().join("examples/first_blur");
    let mut names: Vec<String> = fs::read_dir(&folders)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names.len(), 8, "{names:?}");
    for name in names {
        let link = format!("(../examples/first_blur/{name}/)");
        assert!(GUIDE.contains(&link), "the guide lacks {link}");
        println!("{name}");
        let optional = OPTIONAL.iter().find(|(known, _)| *known == name);
        let missing = optional.map(|(_, compiler)| format!("needs {compiler} on the PATH"));
        match (Filter::load(&folders.join(&name)), missing) {
            (Ok(filter), _) => assert_blurs_as_the_guide(&filter),
            (Err(error), Some(missing)) if error.to_string().contains(&missing) => {
                println!("{missing}, and was not tried");
            }
            (Err(error), _) => panic!("{error}"),
        }
    }
}
