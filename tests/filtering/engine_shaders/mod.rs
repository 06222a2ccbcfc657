//! Shaders of engines as they are: other languages, other bindings, other conventions.

mod camera;
mod constants;
mod conventions;
mod fragment;
mod guide;
mod mips;
mod refusals;
mod resources;
mod routes;
mod texture_sizes;
mod vertex;

use std::fs;
use std::path::{Path, PathBuf};

use filters::{Blur, Filter, FilterError, Input, Settings};
use frame::Image;
use tests::picture::{Picture, Surface};
use tests::text::assert_contains;
use tests::{open_gpu, root};

use super::folders::example;

/// Returns the folder of the shaders that these tests bind.
fn fixtures() -> PathBuf {
    root().join("tests/fixtures/shaders")
}

/// Returns what filter.toml of the documented example says before its passes.
fn head() -> &'static str {
    example("toml").split_once("[[pass]]").unwrap().0
}

/// Writes the documented example with these passes, and copies the files beside it.
fn write_folder(folder: &Path, passes: &str, files: &[&str]) {
    fs::write(folder.join("filter.toml"), format!("{}{passes}", head())).unwrap();
    for file in files {
        fs::copy(fixtures().join(file), folder.join(file)).unwrap();
    }
}

/// Loads the documented example with these passes and files.
fn load(passes: &str, files: &[&str]) -> Result<Filter, FilterError> {
    let folder = tempfile::tempdir().unwrap();
    write_folder(folder.path(), passes, files);
    Filter::load(folder.path())
}

/// Writes a filter with these declarations and files, and loads it.
fn make(declarations: &str, files: &[(&str, &str)]) -> Result<Filter, FilterError> {
    let folder = tempfile::tempdir().unwrap();
    let head = "name = \"made\"\nsummary = \"Made for a test.\"\nalignment = \"centred\"\n";
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("filter.toml", &format!("{head}{declarations}"));
    for (name, text) in files {
        write(name, text);
    }
    Filter::load(folder.path())
}

/// Asserts that each change of the declarations is refused with these words. A change is (text, replacement, words).
fn assert_refused(declarations: &str, files: &[(&str, &str)], changes: &[(&str, &str, &[&str])]) {
    for (from, to, parts) in changes {
        assert!(declarations.contains(from), "no \"{from}\" to be changed");
        let Err(error) = make(&declarations.replacen(from, to, 1), files) else {
            panic!("\"{from}\" -> \"{to}\" was accepted");
        };
        assert_contains(&format!("\"{from}\" -> \"{to}\": {error}"), parts);
    }
}

/// Makes a picture in which two things move before a pattern, and one turns.
fn busy_picture() -> Picture {
    Picture {
        exposure: 0.7,
        ..Picture::new(61, 43, |x, y| Surface {
            gray: ((x * 7 + y * 3) % 11) as f32 / 4.0,
            velocity: match (x, y) {
                (10..25, 8..30) => [9.5, -4.25],
                (30.., 20..) => [0.1 * y as f32 - 3.0, 3.0 - 0.1 * x as f32],
                _ => [0.0, 0.0],
            },
            depth: 2.0 + x as f32,
        })
    }
}

/// Blurs the picture.
fn blur(filter: &Filter, settings: &Settings, picture: &Picture) -> Image {
    let gpu = open_gpu();
    let size = (picture.color.width, picture.color.height);
    let mut blur = Blur::new(&gpu, filter, settings, size.0, size.1).unwrap();
    let colors = [&picture.color];
    let input = Input {
        frame_index: 3,
        ..picture.input(&colors)
    };
    blur.run(&input).unwrap().remove(0)
}

/// Returns the largest difference of a channel.
fn largest_difference(a: &Image, b: &Image) -> f32 {
    let pixels = a.pixels.iter().zip(&b.pixels);
    let channels = pixels.flat_map(|(a, b)| [0, 1, 2].map(|i| (a[i] - b[i]).abs()));
    channels.fold(0.0, f32::max)
}
