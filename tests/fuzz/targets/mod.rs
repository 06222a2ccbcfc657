//! Targets: everything that the program reads.

mod answers;
mod bounds;
mod command_line;
mod exr;
mod filter;
mod kernels;
mod pack;
mod planted;
mod records;
mod run_json;
mod scene;
mod serve;
mod sky;
mod spirv;
mod tuning;

pub use planted::PLANTED;
pub use serve::Service;

use crate::target::Target;

/// All targets.
pub static ALL: [&Target; 29] = [
    &scene::SCENE,
    &scene::OBJ,
    &scene::MTL,
    &scene::IMPORT,
    &scene::RENDER,
    &scene::TEXTURE,
    &sky::HDR,
    &sky::EXR,
    &exr::EXR,
    &exr::MERGE,
    &exr::PICTURE,
    &filter::MANIFEST,
    &filter::WGSL,
    &kernels::TARGET,
    &spirv::TARGET,
    &run_json::RUN,
    &run_json::BASELINE,
    &run_json::BENCH,
    &run_json::JUDGEMENT,
    &tuning::JOURNAL,
    &tuning::TUNE,
    &answers::TARGET,
    &pack::MANIFEST,
    &pack::ARCHIVE,
    &bounds::TARGET,
    &records::TARGET,
    &serve::TARGET,
    &command_line::TARGET,
    &planted::TARGET,
];

/// Returns no tokens.
const fn none() -> &'static [&'static str] {
    &[]
}
