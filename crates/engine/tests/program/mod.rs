//! The commands of `engine`, as their user sees them. A part of tests/command_line, which is linked
//! with the program once.

mod audit;
mod audit_self;
#[cfg(unix)]
mod blender;
mod foreign_pictures;
mod further_inputs;
mod import;
mod import_gltf;
mod import_series;
mod ingest;
#[cfg(unix)]
mod threejs;
#[cfg(unix)]
mod threejs_import;
