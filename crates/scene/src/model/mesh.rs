//! Meshes in object space.

use std::path::PathBuf;

use glam::{Vec2, Vec3};

/// Triangles in object space.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// The OBJ file.
    pub path: PathBuf,
    /// Metres.
    pub positions: Vec<Vec3>,
    /// Unit normals, one per position; empty if the file has none (then facets are flat).
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one per position, v up; empty if the file has none.
    pub texcoords: Vec<Vec2>,
    /// Indices into `positions`.
    pub triangles: Vec<[u32; 3]>,
    /// Index into the object's `materials`, per triangle.
    pub slots: Vec<u32>,
    /// Key shapes at strictly rising times: none for a rigid mesh, else at least two, the first
    /// being `positions` and `normals`. Vertices move in straight lines between them, and beyond
    /// the ends as between the nearest two.
    pub shapes: Vec<Shape>,
}

/// A mesh's vertices at one time.
#[derive(Clone, Debug)]
pub struct Shape {
    /// Frames relative to the instant.
    pub time: f64,
    /// Metres, as many as the mesh has.
    pub positions: Vec<Vec3>,
    /// Unit normals, or zero where the face is flat; as many as the mesh has.
    pub normals: Vec<Vec3>,
}
