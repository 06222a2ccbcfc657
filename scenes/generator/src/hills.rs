//! Hills behind a road at z = 0, and the verge before it.

use glam::{DVec2, DVec3};

use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::noise::soft_noise;
use crate::texture::encode_png;

/// Half the width of the hills, and their length away from the road, in metres.
const HALF_WIDTH: f64 = 170.0;
const LENGTH: f64 = 200.0;

/// Length of the verge across the road, in metres; it ends where the road begins, and a texture on
/// it is 4 m long.
const VERGE: f64 = 7.8;

/// Texels along an edge of the texture.
const TEXELS: u32 = 256;

pub(crate) fn files() -> Files {
    let materials = "newmtl grass\nKd 1 1 1\nmap_Kd grass.png\n";
    let mut hills = Mesh::default();
    hills.add_surface(
        [72, 32],
        |_, _| "grass",
        |u, v| {
            // Finer near the road, where it appears larger.
            let (x, distance) = (HALF_WIDTH * (2.0 * u - 1.0), LENGTH * v * v.abs());
            DVec3::new(x, height(x, distance), -distance)
        },
    );
    hills.repeat_texture(DVec2::new(17.0, 14.0));
    let mut verge = Mesh::default();
    verge.add_surface(
        [16, 2],
        |_, _| "grass",
        |u, v| DVec3::new(16.0 * (2.0 * u - 1.0), 0.0, 4.0 - VERGE * v),
    );
    verge.repeat_texture(DVec2::new(8.0, VERGE / 4.0));
    let mut files = model_files("hills", &hills, materials);
    files.extend(model_files("verge", &verge, materials));
    files.push(("grass.png".into(), encode_png(TEXELS, color)));
    files
}

/// Height above the road in metres, at a position along it and a distance from it.
fn height(x: f64, distance: f64) -> f64 {
    let near = (distance / 130.0).clamp(0.0, 1.0);
    let rise = near * near * (3.0 - 2.0 * near);
    let broad = 15.0 + 9.0 * (0.03 * x + 1.0).sin() + 5.0 * (0.071 * x + 0.02 * distance).sin();
    let rough = 1.6 * (0.23 * x + 0.4).sin() * (0.11 * distance).cos();
    rise * (broad + rough)
}

/// Color of meadows, tufts and blades.
fn color(x: u32, y: u32) -> [f64; 3] {
    let soft = |size: u32| soft_noise(x, y, size, TEXELS) - 0.5;
    let light = 1.0 + 0.25 * soft(64) + 0.3 * soft(16) + 0.4 * soft(4) + 0.25 * soft(2);
    [0.38 * light + 0.06 * soft(32), 0.46 * light, 0.2 * light]
}
