//! Samplers by every route: combined with a texture or not, bound by name or by number, in every
//! language.

use frame::Image;

use crate::engine_shaders::blur_busy;
use crate::filter_files::FilterFiles;

/// Makes the filter of another file of the folder.
pub fn declare(file: &str) -> FilterFiles {
    let files = FilterFiles::fixture("filters/keys");
    let text = files.text(file);
    files.with("filter.toml", text)
}

/// Shows a picture through a sampler with these keys. `image` and `sampler` are the places of the
/// two; an empty one is the other's.
fn show(shader: &str, image: &str, sampler: &str, keys: &str) -> Image {
    let head = "name = \"shown\"\nsummary = \"Shows a picture through a sampler.\"\nalignment = \"trailing\"\n";
    let sampled = if sampler.is_empty() {
        format!("{image}\ntexture = \"color\"\n{keys}\n")
    } else {
        format!("{image}\ntexture = \"color\"\n[[pass.binding]]\n{sampler}\n{keys}\n")
    };
    let text = format!(
        "{head}[[pass]]\nshader = \"{shader}\"\nstage = \"fragment\"\n[[pass.binding]]\n{sampled}"
    );
    blur_busy(&FilterFiles::fixture("filters/keys").with("filter.toml", text))
}

#[test]
fn a_sampler_does_what_filter_toml_says_by_every_route() {
    let routes = [
        ("combined.frag", "binding = 0", ""),
        ("combined.frag", "name = \"image\"", ""),
        ("separate.frag", "binding = 0", "binding = 1"),
        ("separate.frag", "name = \"image\"", "name = \"chosen\""),
        ("separate.wgsl", "binding = 0", "binding = 1"),
        ("separate.wgsl", "name = \"image\"", "name = \"chosen\""),
        ("separate.hlsl", "binding = 100", "binding = 301"),
        ("separate.hlsl", "name = \"image\"", "name = \"chosen\""),
    ];
    let mut pictures: Vec<Image> = Vec::new();
    for filter in ["nearest", "linear"] {
        for wrap in ["clamp", "repeat", "mirror"] {
            let keys = format!("sampler = \"{filter}\"\nwrap = \"{wrap}\"");
            let shown = routes.map(|(shader, image, sampler)| show(shader, image, sampler, &keys));
            for (shown_so, route) in shown.iter().zip(routes) {
                assert_eq!(*shown_so, shown[0], "{route:?}, {keys}");
            }
            let [first, ..] = shown;
            assert!(!pictures.contains(&first), "{keys} changes nothing");
            pictures.push(first);
        }
    }
}

#[test]
fn keys_that_mean_nothing_to_a_variable_are_refused() {
    let files = FilterFiles::fixture("filters/keys");
    files.assert_refused("idle_keys");
    let separate = "[[pass]]\nshader = \"separate.wgsl\"\nstage = \"fragment\"\n\
                    [[pass.binding]]\nname = \"image\"\ntexture = \"color\"\n\
                    [[pass.binding]]\nname = \"chosen\"\nwrap = \"clamp\"\n";
    let text = declare("lab.toml").text("filter.toml");
    let text = text.split_once("[[pass]]").unwrap().0.to_owned() + separate;
    files
        .with("filter.toml", text)
        .assert_refused("idle_keys_apart");
}
