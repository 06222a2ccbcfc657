//! The same blur for each engine: the folders named by the guide and the engines' pages.

use std::fs;

use filters::Filter;
use tests::near::assert_within;
use tests::picture::{Picture, Surface};
use tests::root;

use super::{blur, busy_picture, largest_difference};

const GUIDE: &str = include_str!("../../../docs/add-a-filter.md");

/// Folders with a compiler that not every machine has, with its name.
const OPTIONAL: [(&str, &str); 2] = [("bevy_wesl", "wesl"), ("slang", "slangc")];

/// Makes a picture that moves as a whole, so that the longest motion near a pixel is its own.
fn uniform_motion() -> Picture {
    Picture {
        exposure: 0.7,
        ..Picture::new(61, 43, |x, y| Surface {
            gray: ((x * 7 + y * 3) % 11) as f32 / 4.0,
            velocity: [9.5, -4.25],
            depth: 2.0,
        })
    }
}

/// Asserts that a filter blurs a picture like the guide's kernel.
pub(super) fn assert_blurs_as_the_guide(filter: &Filter, picture: &Picture) {
    let kernel = Filter::load(&root().join("examples/first_blur/wgsl"));
    let [expected, actual] = [&kernel.unwrap(), filter]
        .map(|filter| blur(filter, &filter.settings(None).unwrap(), picture));
    // Halves have 11 binary digits: 0.003 of 7 pixels, where neighbours differ by up to 2.5, and
    // 0.001 of colours below 4.
    let difference = largest_difference(&expected, &actual);
    assert_within(difference, f64::MIN_POSITIVE..0.02);
}

#[test]
fn every_example_of_the_guide_blurs_as_its_kernel_does() {
    let folders = root().join("examples/first_blur");
    let mut names: Vec<String> = fs::read_dir(&folders)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    assert_eq!(names.len(), 13, "{names:?}");
    let pages = fs::read_dir(root().join("docs/engines")).unwrap();
    let pages = pages.map(|page| fs::read_to_string(page.unwrap().path()).unwrap());
    let pages: String = pages.collect::<String>() + GUIDE;
    for name in names {
        let shown = [format!("--from {name}"), format!("`{name}`")];
        let is_shown = shown.iter().any(|shown| pages.contains(shown));
        assert!(is_shown, "no page names {name}");
        println!("{name}");
        // The kernel itself.
        if name == "wgsl" {
            continue;
        }
        let picture = match name.as_str() {
            "godot_tiles" => uniform_motion(),
            _ => busy_picture(),
        };
        let optional = OPTIONAL.iter().find(|(known, _)| *known == name);
        let missing = optional.map(|(_, compiler)| format!("needs {compiler} on the PATH"));
        match (Filter::load(&folders.join(&name)), missing) {
            (Ok(filter), _) => assert_blurs_as_the_guide(&filter, &picture),
            (Err(error), Some(missing)) if error.to_string().contains(&missing) => {
                println!("{missing}, and was not tried");
            }
            (Err(error), _) => panic!("{error}"),
        }
    }
}
