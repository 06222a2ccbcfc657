//! OBJ text of a piece.

use std::fmt::Write;

use glam::{DVec3, Vec3};

use super::geometry::Primitive;
use super::look::Look;
use super::pose::{Placement, pose_normals, pose_positions};

/// A piece's primitives with what they look like.
pub type Dressed<'a> = [(&'a Primitive, Look)];

/// Writes the text of a piece, placed and morphed. Positions are rounded to 32 bits.
pub fn obj_text(parts: &Dressed, weights: &[f64], placement: &Placement) -> String {
    let mut text = String::from("mtllib materials.mtl\no piece\n");
    // Numbers of the next vertex, texture coordinate and normal.
    let mut next = [1; 3];
    for (primitive, look) in parts {
        let positions = pose_positions(primitive, weights, placement);
        let normals = pose_normals(primitive, weights, placement);
        next = write_part(
            &mut text,
            &Part {
                primitive,
                look,
                positions,
                normals,
            },
            next,
        );
    }
    text
}

/// A primitive at one time.
struct Part<'a> {
    primitive: &'a Primitive,
    look: &'a Look,
    positions: Vec<DVec3>,
    normals: Vec<Vec3>,
}

/// Writes a primitive; returns the next numbers.
fn write_part(text: &mut String, part: &Part, [v, t, n]: [usize; 3]) -> [usize; 3] {
    let Part {
        primitive,
        look,
        positions,
        normals,
    } = part;
    let line = "text takes text";
    for position in positions {
        let [x, y, z] = position.as_vec3().to_array();
        writeln!(text, "v {x} {y} {z}").expect(line);
    }
    let texcoords = look.texcoords(primitive);
    for [s, t] in &texcoords {
        // Down from the top there, up from the bottom here.
        writeln!(text, "vt {s} {}", 1.0 - t).expect(line);
    }
    for normal in normals {
        let [x, y, z] = normal.to_array();
        writeln!(text, "vn {x} {y} {z}").expect(line);
    }
    writeln!(text, "usemtl {}", look.name).expect(line);
    for triangle in &primitive.triangles {
        let [a, b, c] = triangle.map(|corner| {
            let corner = corner as usize;
            match (texcoords.is_empty(), normals.is_empty()) {
                (true, true) => format!("{}", v + corner),
                (false, true) => format!("{}/{}", v + corner, t + corner),
                (true, false) => format!("{}//{}", v + corner, n + corner),
                (false, false) => format!("{}/{}/{}", v + corner, t + corner, n + corner),
            }
        });
        writeln!(text, "f {a} {b} {c}").expect(line);
    }
    [v + positions.len(), t + texcoords.len(), n + normals.len()]
}
