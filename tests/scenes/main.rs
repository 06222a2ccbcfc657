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
