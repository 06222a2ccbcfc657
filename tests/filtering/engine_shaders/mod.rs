//! Unmodified engine shaders: other languages, other bindings, other conventions.

mod camera;
mod constants;
mod conventions;
mod flows;
mod fragment;
mod further_inputs;
mod guide;
mod in_place;
mod manners;
mod mips;
mod origin;
mod resources;
mod routes;
mod texture_sizes;
mod vertex;

use filters::{Blur, Filter, Input, Settings};
use frame::Image;
use tests::near::assert_within;
use tests::picture::{Picture, Surface};
use tests::shared_gpu;

use super::folders::{documented, example};
use crate::filter_files::FilterFiles;

/// Makes the documented example with these passes over the shaders in tests/fixtures/shaders.
fn with_passes(passes: &str) -> FilterFiles {
    let head = example("toml").split_once("[[pass]]").unwrap().0;
    FilterFiles::fixture("shaders").with("filter.toml", format!("{head}{passes}"))
}

/// Makes a filter from these declarations and the shaders of a folder in tests/fixtures/filters.
fn make(folder: &str, declarations: &str) -> FilterFiles {
    let head = "name = \"made\"\nsummary = \"Made for a test.\"\nalignment = \"centred\"\n";
    let files = FilterFiles::fixture(&format!("filters/{folder}"));
    files.with("filter.toml", format!("{head}{declarations}"))
}

/// Makes a filter from the declarations in a file of such a folder.
fn make_declared(folder: &str, file: &str) -> FilterFiles {
    make(folder, &make(folder, "").text(file))
}

/// Makes a picture with two objects that move in front of a pattern, and one that turns.
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

/// Blurs the busy picture with the first preset.
pub fn blur_busy(files: &FilterFiles) -> Image {
    let filter = files.load().unwrap();
    blur(&filter, &filter.settings(None).unwrap(), &busy_picture())
}

fn blur(filter: &Filter, settings: &Settings, picture: &Picture) -> Image {
    let (width, height) = (picture.color.width, picture.color.height);
    let mut blur = Blur::new(shared_gpu(), filter, settings, width, height).unwrap();
    let colors = [&picture.color];
    let input = Input {
        frame_index: 3,
        ..picture.input(&colors)
    };
    blur.run(&input).unwrap().remove(0)
}

/// Fails unless a filter blurs the busy picture like the documented example, with each preset.
fn assert_as_documented(filter: &Filter, tolerance: f32) {
    let (documented, picture) = (documented().load().unwrap(), busy_picture());
    for preset in ["fast", "fine"] {
        let [expected, actual] = [&documented, filter].map(|filter| {
            let settings = filter.settings(Some(preset)).unwrap();
            blur(filter, &settings, &picture)
        });
        // The picture has something to blur.
        assert_within(largest_difference(&expected, &picture.color), 0.5..);
        let difference = largest_difference(&expected, &actual);
        assert!(difference < tolerance, "{preset}: {difference}");
    }
}

fn largest_difference(a: &Image, b: &Image) -> f32 {
    let pixels = a.pixels.iter().zip(&b.pixels);
    let channels = pixels.flat_map(|(a, b)| [0, 1, 2].map(|i| (a[i] - b[i]).abs()));
    channels.fold(0.0, f32::max)
}
