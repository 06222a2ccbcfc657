//! The commands of `engine`, as their user sees them. A part of tests/command_line, which is linked
//! with the program once.

use crate::sandbox::Sandbox;

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

/// Exports a shipped scene to glTF; returns the folder in the sandbox.
fn export_gltf(sandbox: &Sandbox, scene: &str, more: &[&str]) -> String {
    let folder = tests::scenes().display().to_string();
    let words = ["engine", "export", "--gltf", "gltf", "--scenes-dir"];
    sandbox.execute(&[&words[..], &[folder.as_str(), scene], more].concat());
    format!("gltf/{scene}")
}
