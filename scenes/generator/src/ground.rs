//! Level ground at y = 0 with a repeated texture.

use std::f64::consts::FRAC_PI_8;

use glam::{DVec2, DVec3};

use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::noise::{noise, soft_noise};
use crate::texture::encode_png;

/// Texels along an edge of a texture.
const TEXELS: u32 = 128;

/// Ground from corner `from` to corner `to`, as (x, z) in metres; a texture covers `tile` metres.
pub(crate) fn ground_files(
    name: &'static str,
    [from, to]: [DVec2; 2],
    tile: f64,
    color: impl Fn(u32, u32) -> [f64; 3],
) -> Files {
    let tiles = ((to - from) / tile).round();
    let mut mesh = Mesh::default();
    mesh.add_surface(
        [16, 16],
        |_, _| name,
        |u, v| {
            let place = from + (to - from) * DVec2::new(u, 1.0 - v);
            DVec3::new(place.x, 0.0, place.y)
        },
    );
    mesh.repeat_texture(tiles);
    let materials = format!("newmtl {name}\nKd 1 1 1\nmap_Kd {name}.png\n");
    let mut files = model_files(name, &mesh, &materials);
    files.push((format!("{name}.png"), encode_png(TEXELS, color)));
    files
}

/// Brightness of grains of several sizes, sRGB-encoded.
fn grains(x: u32, y: u32) -> f64 {
    let soft = |size: u32| soft_noise(x, y, size, TEXELS) - 0.5;
    0.5 * soft(32) + 0.6 * soft(8) + 0.8 * soft(2)
}

pub(crate) fn grass(x: u32, y: u32) -> [f64; 3] {
    let light = 1.0 + 0.5 * grains(x, y);
    [0.36 * light, 0.46 * light, 0.2 * light]
}

pub(crate) fn gravel(x: u32, y: u32) -> [f64; 3] {
    let light = 0.5 + 0.35 * (noise(x / 3, y / 3) - 0.5) + 0.2 * grains(x, y);
    [light, 0.96 * light, 0.9 * light]
}

pub(crate) fn sand(x: u32, y: u32) -> [f64; 3] {
    let ripple = 0.06 * (FRAC_PI_8 * f64::from(y) + 3.0 * soft_noise(x, y, 32, TEXELS)).sin();
    let light = 0.82 + ripple + 0.12 * grains(x, y);
    [light, 0.88 * light, 0.66 * light]
}

pub(crate) fn asphalt(x: u32, y: u32) -> [f64; 3] {
    [0.36 + 0.1 * grains(x, y); 3]
}

/// Color of boards along x, 16 texels wide.
pub(crate) fn boards(x: u32, y: u32) -> [f64; 3] {
    let board = y / 16;
    let joint = y.is_multiple_of(16) || (x + 40 * board).is_multiple_of(TEXELS);
    let vein = 0.1 * (soft_noise(x, 8 * y % TEXELS, 16, TEXELS) - 0.5);
    let light = if joint {
        0.35
    } else {
        0.8 + 0.25 * (noise(board, 5) - 0.5) + vein
    };
    [0.86 * light, 0.62 * light, 0.4 * light]
}

/// Color of slabs of 32 texels with joints.
pub(crate) fn slabs(x: u32, y: u32) -> [f64; 3] {
    let joint = x % 32 < 2 || y % 32 < 2;
    let shade = 0.12 * (noise(x / 32, y / 32) - 0.5);
    let light = if joint {
        0.36
    } else {
        0.62 + shade + 0.08 * grains(x, y)
    };
    [light, 0.97 * light, 0.92 * light]
}
