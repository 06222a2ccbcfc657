//! Scenes: reading and refusing folders, and the shipped scenes.

mod appearance;
mod audit;
mod audit_buffers;
mod audit_planted;
mod built_in;
mod catalogue;
mod frame_rates;
mod gltf;
mod reading;
mod refusals;
mod scene_folder;
mod sealed;
mod unlit;
