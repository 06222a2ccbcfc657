//! A CPU path tracer: from a scene of moving OBJ meshes to the frame of one instant and the truth of a shutter interval.
//!
//! The conventions are those of the [`frame`] crate.

mod approach;
mod background;
mod bounds;
mod brdf;
mod bvh;
mod camera;
mod canvas;
mod curve;
mod environment;
mod extent;
mod eye;
mod film;
mod folding;
mod fresnel;
mod geometry;
mod ggx;
mod gloss;
mod glossy;
mod growth;
mod instant;
mod joining;
mod ladder;
mod lanes;
mod lights;
pub mod limits;
mod load;
mod lobe;
mod mesh_tree;
mod motion;
mod moving;
mod opening;
mod pages;
mod path;
mod poses;
mod progress;
mod provenance;
mod ray;
mod recall;
mod sampler;
mod scene;
mod screw;
mod settings;
mod shape;
mod shape_tree;
mod slices;
mod stage;
mod support;
mod surface;
mod swept;
mod texture;
mod triangle;
mod truth;
mod velocity;
mod walks;
mod world_tree;

pub use camera::View;
pub use instant::trace_frame;
pub use ladder::trace_ladder;
pub use load::{
    SceneError, SceneListing, list_scene, list_scenes, load_scene, load_scene_and_files,
};
pub use motion::{Interpolation, Key, Motion, Turn};
pub use poses::Poses;
pub use progress::{Progress, Watch};
pub use provenance::{frame_hash, ladder_hash, replicate_hash, truth_hash};
pub use ray::Ray;
pub use sampler::MOST_SAMPLES;
pub use scene::{
    Background, Camera, Display, EnvironmentMap, Family, Finish, FlipExposures, Material, Mesh,
    Object, Parent, Scene, Shape, Sun, Texture,
};
pub use settings::{FrameSettings, TraceError, TruthSettings};
pub use stage::{Hit, Stage};
pub use truth::{TruthTracer, trace_truth};
