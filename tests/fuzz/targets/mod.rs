//! Targets: everything that the program reads.

mod answers;
mod bounds;
mod capture;
mod command_line;
mod exr;
mod filter;
mod includes;
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
mod verify;

pub use planted::PLANTED;
pub use serve::Service;

use crate::target::Target;

/// All targets.
pub static ALL: [&Target; 33] = [
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
    &verify::TARGET,
    &capture::CAPTURE,
    &capture::INGESTED,
    &filter::MANIFEST,
    &filter::WGSL,
    &kernels::TARGET,
    &spirv::TARGET,
    &includes::TARGET,
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
