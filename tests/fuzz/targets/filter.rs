//! Filter folders, read and checked but not run.

use std::path::PathBuf;

use cli::{Programs, select_filters};
use filters::Filter;

use crate::place::Place;
use crate::seeds::{Seed, read_shipped};
use crate::target::{Shape, Target};
use crate::{huge, tokens};

/// filter.toml.
pub static MANIFEST: Target = Target {
    name: "filter",
    share: 2_000,
    batch: 500,
    shape: Shape::Text,
    tokens: tokens::FILTER,
    seeds: |_| {
        let mut seeds = read_shipped("shaders", "filter.toml");
        seeds.extend([Seed::Made(huge::deep_toml), Seed::Made(huge::long_key)]);
        seeds
    },
    run: |place, input| {
        let folder = place.folder.join("filter");
        if !folder.exists() {
            for name in Filter::builtin_names() {
                place.write(&format!("filter/{name}.wgsl"), kernels(&name));
            }
        }
        place.write("filter/filter.toml", input);
        if let Ok(filter) = Filter::load(&folder) {
            for preset in &filter.presets {
                let settings = filter.settings(Some(&preset.name)).unwrap();
                for width in [1, 320, 16_384] {
                    drop(settings.clone().scaled_to(&filter, width));
                }
            }
            let word = folder.display().to_string();
            drop(select_filters(&[word], None, &[], Programs::Refused));
        }
    },
};

/// WGSL.
pub static WGSL: Target = Target {
    name: "wgsl",
    share: 1_200,
    batch: 250,
    shape: Shape::Text,
    tokens: tokens::WGSL,
    seeds: |_| {
        let mut seeds = sources();
        seeds.extend(hostile());
        seeds
    },
    run: |place, input| drop(Filter::load(&write(place, input))),
};

/// Returns the kernels of all built-in filters, each with a line that names its filter.
pub fn sources() -> Vec<Seed> {
    let names = Filter::builtin_names();
    let sources = names.iter().map(|name| {
        let text = format!("{MARK}{name}\n{}", kernels(name));
        Seed::Bytes(text.into_bytes())
    });
    sources.collect()
}

/// Returns kernels for the identity that are deeper than a stack.
pub fn hostile() -> [Seed; 6] {
    [
        Seed::Made(huge::long_sum),
        Seed::Made(huge::deep_brackets),
        Seed::Made(huge::deep_blocks),
        Seed::Made(huge::long_condition),
        Seed::Made(huge::many_signs),
        Seed::Made(huge::deep_type),
    ]
}

const MARK: &str = "// filter: ";

/// Makes a filter folder of kernels, with the manifest of the filter that their first line names, or the identity's.
pub fn write(place: &Place, input: &[u8]) -> PathBuf {
    let line = input
        .split(|byte| *byte == b'\n')
        .next()
        .unwrap_or_default();
    let line = String::from_utf8_lossy(line);
    let name = line.strip_prefix(MARK).unwrap_or_default();
    let names = Filter::builtin_names();
    let name = (names.iter().find(|known| *known == name)).map_or("identity", String::as_str);
    place.write(&format!("{name}/{name}.wgsl"), input);
    let manifest = read_shipped(&format!("shaders/{name}"), "filter.toml");
    let [Seed::Bytes(manifest)] = manifest.as_slice() else {
        panic!("{name} has a filter.toml");
    };
    let manifest = String::from_utf8_lossy(manifest);
    place.write(
        &format!("{name}/filter.toml"),
        // No pass may run longer.
        format!("time_limit = 5\n{manifest}"),
    );
    place.folder.join(name)
}

fn kernels(name: &str) -> String {
    let found = read_shipped(&format!("shaders/{name}"), ".wgsl");
    let [Seed::Bytes(kernels)] = found.as_slice() else {
        panic!("{name} has one file of kernels");
    };
    String::from_utf8_lossy(kernels).into_owned()
}
