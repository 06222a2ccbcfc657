//! A shader as filter.toml names it.

use std::path::PathBuf;

/// Stage of a shader.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// One invocation per texel writes storage textures.
    #[default]
    Compute,
    /// A triangle over the whole picture; each fragment writes the render targets.
    Fragment,
    /// Corners of the triangle of a fragment shader. Not a stage of a pass by itself.
    #[serde(skip)]
    Vertex,
}

/// A file with a shader, and how to compile it.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaderFile {
    /// The file, relative to the filter's folder.
    pub path: PathBuf,
    /// Pass of a ShaderLab file, if it has several.
    pub shader_pass: Option<LabPass>,
    /// Entry point.
    pub entry: String,
    /// Stage of the entry point.
    pub stage: Stage,
    /// Conditions of WESL that are true.
    pub conditions: Vec<String>,
    /// Macros of its compiler, each as `NAME=value`.
    pub defines: Vec<String>,
    /// Program that compiles it; the first that can if left out.
    pub compiler: Option<String>,
}

/// Pass of a file in Unity's ShaderLab.
#[derive(Clone, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(untagged)]
pub enum LabPass {
    /// Its place, from 0.
    Place(usize),
    /// Its `Name`.
    Name(String),
}

/// Facts about the pictures of a shader, by which GLSL of OpenGL is told from Vulkan's.
#[derive(Clone, Copy, Debug)]
pub struct Pictures {
    /// True if filter.toml says where they begin.
    pub have_origin: bool,
    /// True if velocities point up.
    pub velocity_is_up: bool,
}
