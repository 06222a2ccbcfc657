//! A road along the X axis with painted lanes.

use glam::{DVec2, DVec3};

use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::noise::noise;
use crate::texture::encode_png;

/// Half the length, and half the width about z = 0, in metres.
const HALF_LENGTH: f64 = 60.0;
pub(crate) const HALF_WIDTH: f64 = 3.2;

/// Length of a texture in metres: a dash and a gap.
pub(crate) const TILE: f64 = 4.0;

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    mesh.add_surface(
        [30, 2],
        |_, _| "asphalt",
        |u, v| {
            DVec3::new(
                HALF_LENGTH * (2.0 * u - 1.0),
                0.0,
                HALF_WIDTH * (1.0 - 2.0 * v),
            )
        },
    );
    mesh.repeat_texture(DVec2::new(2.0 * HALF_LENGTH / TILE, 1.0));
    let mut files = model_files("road", &mesh, "newmtl asphalt\nKd 1 1 1\nmap_Kd road.png\n");
    files.push(("road.png".into(), encode_png(256, color)));
    files
}

/// Color of asphalt with lines at the edges and dashes in the middle.
pub(crate) fn color(x: u32, y: u32) -> [f64; 3] {
    let edge = (8..14).contains(&y) || (242..248).contains(&y);
    let dash = (125..131).contains(&y) && x < 128;
    let grain = 0.09 * (noise(x / 2, y / 2) - 0.5) + 0.05 * (noise(x, y + 999) - 0.5);
    let light = if edge || dash { 0.9 } else { 0.38 };
    [light + grain; 3]
}
