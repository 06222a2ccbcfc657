//! A polygon mesh under construction, and its OBJ text.

use std::fmt::Write;

use glam::{DVec2, DVec3, Vec2Swizzles};

/// Point of a surface.
#[derive(Clone, Copy)]
pub(crate) struct Vertex {
    /// Position, in metres.
    pub(crate) position: DVec3,
    /// Unit normal, outward.
    pub(crate) normal: DVec3,
    /// Texture coordinate, v up.
    pub(crate) texcoord: DVec2,
}

/// Polygons with their materials.
#[derive(Default)]
pub(crate) struct Mesh {
    vertices: Vec<Vertex>,
    faces: Vec<Face>,
}

struct Face {
    material: &'static str,
    corners: Vec<usize>,
}

impl Mesh {
    /// Adds a polygon, counter-clockwise seen from outside, with vertices of its own.
    pub(crate) fn add_polygon(&mut self, material: &'static str, vertices: &[Vertex]) {
        let first = self.vertices.len();
        self.vertices.extend_from_slice(vertices);
        self.faces.push(Face {
            material,
            corners: (first..first + vertices.len()).collect(),
        });
    }

    /// Adds the surface `position(u, v)` over the unit square as `columns` x `rows` quads, with
    /// smooth normals and the texture coordinates (u, v). Its outside is the side from which u runs
    /// right and v up.
    pub(crate) fn add_surface(
        &mut self,
        [columns, rows]: [usize; 2],
        material: impl Fn(usize, usize) -> &'static str,
        position: impl Fn(f64, f64) -> DVec3,
    ) {
        let first = self.vertices.len();
        for row in 0..=rows {
            for column in 0..=columns {
                let (u, v) = (column as f64 / columns as f64, row as f64 / rows as f64);
                self.vertices.push(Vertex {
                    position: position(u, v),
                    normal: normal(&position, u, v),
                    texcoord: DVec2::new(u, v),
                });
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                let corner = first + row * (columns + 1) + column;
                let above = corner + columns + 1;
                self.faces.push(Face {
                    material: material(column, row),
                    corners: vec![corner, corner + 1, above + 1, above],
                });
            }
        }
    }

    /// Repeats textures `times` along u and v.
    pub(crate) fn repeat_texture(&mut self, times: DVec2) {
        for vertex in &mut self.vertices {
            vertex.texcoord *= times;
        }
    }

    /// Swaps u and v.
    pub(crate) fn turn_texture(&mut self) {
        for vertex in &mut self.vertices {
            vertex.texcoord = vertex.texcoord.yx();
        }
    }

    /// Adds a transformed copy of another mesh.
    pub(crate) fn append(&mut self, other: &Mesh, place: glam::DAffine3) {
        let first = self.vertices.len();
        self.vertices
            .extend(other.vertices.iter().map(|vertex| Vertex {
                position: place.transform_point3(vertex.position),
                normal: place.transform_vector3(vertex.normal).normalize(),
                texcoord: vertex.texcoord,
            }));
        self.faces.extend(other.faces.iter().map(|face| Face {
            material: face.material,
            corners: face.corners.iter().map(|corner| first + corner).collect(),
        }));
    }

    /// Writes the mesh as OBJ text with the materials of the file `library`.
    pub(crate) fn to_obj(&self, library: &str) -> String {
        let mut text = format!("# Made by `cargo run -p generator`.\nmtllib {library}\n");
        for vertex in &self.vertices {
            write_statement(&mut text, "v", &vertex.position.to_array(), 5);
        }
        for vertex in &self.vertices {
            write_statement(&mut text, "vt", &vertex.texcoord.to_array(), 5);
        }
        for vertex in &self.vertices {
            write_statement(&mut text, "vn", &vertex.normal.to_array(), 4);
        }
        let mut material = "";
        for face in &self.faces {
            if face.material != material {
                material = face.material;
                text += &format!("usemtl {material}\n");
            }
            text += "f";
            for corner in &face.corners {
                let index = corner + 1;
                write!(text, " {index}/{index}/{index}").expect("text takes text");
            }
            text += "\n";
        }
        text
    }
}

/// Writes a statement. Rounding hides differences between the sines of machines; for the same
/// reason -0 becomes 0.
fn write_statement(text: &mut String, keyword: &str, numbers: &[f64], decimals: i32) {
    let unit = 10f64.powi(decimals);
    *text += keyword;
    for number in numbers {
        let rounded = (number * unit).round() / unit + 0.0;
        write!(text, " {rounded}").expect("text takes text");
    }
    *text += "\n";
}

/// Normal of a surface from its slopes; where the surface shrinks to a point, from the slopes a
/// little inside.
fn normal(position: impl Fn(f64, f64) -> DVec3, u: f64, v: f64) -> DVec3 {
    const STEP: f64 = 1e-4;
    // Less than a slope of millimetres, more than the rounding of a sine.
    const FLAT: f64 = 1e-14;
    let cross = |u: f64, v: f64| {
        let along_u = position(u + STEP, v) - position(u - STEP, v);
        let along_v = position(u, v + STEP) - position(u, v - STEP);
        along_u.cross(along_v)
    };
    let inside = |x: f64| x.clamp(0.01, 0.99);
    let here = cross(u, v);
    let there = if here.length() > FLAT {
        here
    } else {
        cross(inside(u), inside(v))
    };
    there.normalize_or(DVec3::Y)
}
