//! Two ledges of a garden wall along the X axis, one above the other, with their tops at y = 0 and
//! y = `STOREY`.

use glam::{DVec2, DVec3};

use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::noise::{noise, soft_noise};
use crate::texture::encode_png;

/// Distance from ledge to ledge, in metres.
const STOREY: f64 = 1.4;

const TEXELS: u32 = 128;

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    // Outline (z, y) from below the lower ledge to above the upper one.
    let outline = [
        (0.5, -1.2),
        (0.5, 0.0),
        (-0.3, 0.0),
        (-0.3, STOREY),
        (-1.1, STOREY),
        (-1.1, STOREY + 2.0),
    ];
    for piece in outline.windows(2) {
        let [from, to] = [piece[0], piece[1]];
        let mut strip = Mesh::default();
        strip.add_surface(
            [12, 2],
            |_, _| "stone",
            |u, v| {
                let (z, y) = (from.0 + v * (to.0 - from.0), from.1 + v * (to.1 - from.1));
                DVec3::new(5.0 * (2.0 * u - 1.0), y, z)
            },
        );
        let length = (to.0 - from.0).hypot(to.1 - from.1);
        strip.repeat_texture(DVec2::new(10.0, length));
        mesh.append(&strip, glam::DAffine3::IDENTITY);
    }
    let mut files = model_files("ledge", &mesh, "newmtl stone\nKd 1 1 1\nmap_Kd stone.png\n");
    files.push(("stone.png".into(), encode_png(TEXELS, color)));
    files
}

/// Color of moss on stone.
fn color(x: u32, y: u32) -> [f64; 3] {
    let soft = |size: u32| soft_noise(x, y, size, TEXELS);
    let grain = 0.2 * (noise(x, y) - 0.5) + 0.2 * (soft(4) - 0.5);
    let moss = (4.0 * (soft(32) - 0.62)).clamp(0.0, 1.0);
    let mix = |stone: f64, green: f64| stone + moss * (green - stone) + grain;
    [mix(0.62, 0.32), mix(0.6, 0.46), mix(0.56, 0.22)]
}
