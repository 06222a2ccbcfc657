//! Scenes: reading and refusing folders, and the shipped scenes.

mod appearance;
mod audit;
mod built_in;
mod catalogue;
mod frame_rates;
mod given_variants;
mod gltf;
mod reading;
mod refusals;
mod scene_folder;

use tests::scenes;
use tracer::{Scene, list_scenes, load_scene};

/// Loads a shipped scene, `name` or `name@variant`.
fn load_shipped(name: &str) -> Scene {
    let (name, variant) = match name.split_once('@') {
        Some((name, variant)) => (name, Some(variant)),
        None => (name, None),
    };
    load_scene(scenes().join(name), variant).unwrap_or_else(|error| panic!("{error}"))
}

/// Lists the names of all shipped scenes.
fn shipped() -> Vec<String> {
    let listings = list_scenes(scenes()).unwrap_or_else(|error| panic!("{error}"));
    listings.into_iter().map(|listing| listing.name).collect()
}

/// Lists them with all their variants, `name@variant`.
fn shipped_with_variants() -> Vec<String> {
    let listings = list_scenes(scenes()).unwrap().into_iter();
    let all = listings.flat_map(|listing| {
        let of = |variant: &String| format!("{}@{variant}", listing.name);
        let variants: Vec<String> = listing.variants.iter().map(of).collect();
        std::iter::once(listing.name).chain(variants)
    });
    all.collect()
}
