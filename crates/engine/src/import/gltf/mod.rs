//! Import of a glTF file: its meshes, materials, cameras, lights and animation as a scene folder.
//!
//! [`file::File`] reads, [`stage::Stage`] knows where everything is at a time, [`keys`] chooses how
//! many keys are needed, and [`objects`] and [`document`] write.

mod accessor;
mod animation;
mod choice;
mod data_uri;
mod document;
mod extensions;
mod file;
mod frame_model;
mod geometry;
mod images;
mod import;
mod keys;
mod light;
mod list;
mod look;
mod lost;
mod material;
mod material_schema;
mod moment;
mod obj;
mod objects;
mod picture;
mod piece;
mod pieces;
mod plan;
mod pose;
mod reading;
mod schema;
mod stage;
mod tree;
mod view;

pub use self::import::import_gltf;
pub use self::plan::GltfPlan;
