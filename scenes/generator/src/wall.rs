//! Walls that stand behind moving objects.

use glam::{DAffine3, DVec2, DVec3};

use crate::files::{Files, model_files};
use crate::mesh::{Mesh, Vertex};
use crate::noise::noise;
use crate::texture::encode_png;

/// Plain mid-grey wall, unlit.
pub(crate) fn plain() -> Files {
    let materials = "newmtl wall\nKd 0 0 0\nKe 0.2 0.2 0.2\n";
    model_files("wall", &wall(), materials)
}

/// Wall of small patches, each with a fine pattern of its own, unlit.
pub(crate) fn patchwork() -> Files {
    let materials = "newmtl wall\nKd 0 0 0\nKe 0.6 0.6 0.6\nmap_Ke wall.png\n";
    let mut files = model_files("wall", &wall(), materials);
    files.push(("wall.png".into(), encode_png(256, patch_color)));
    files
}

/// Brick wall.
pub(crate) fn brick() -> Files {
    let materials = "newmtl wall\nKd 1 1 1\nmap_Kd wall.png\n";
    let mut files = model_files("wall", &wall(), materials);
    files.push(("wall.png".into(), encode_png(256, brick_color)));
    files
}

/// Wall of boards.
pub(crate) fn boards() -> Files {
    let materials = "newmtl wall\nKd 1 1 1\nmap_Kd wall.png\n";
    let mut files = model_files("wall", &wall(), materials);
    files.push(("wall.png".into(), encode_png(128, crate::ground::boards)));
    files
}

/// Wall of 12 m x 8 m about the origin that faces +Z; the texture covers 2 m.
fn wall() -> Mesh {
    let mut tile = Mesh::default();
    tile.add_polygon(
        "wall",
        &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| Vertex {
            position: DVec3::new(2.0 * u, 2.0 * v, 0.0),
            normal: DVec3::Z,
            texcoord: DVec2::new(u, v),
        }),
    );
    let mut mesh = Mesh::default();
    for row in 0..4 {
        for column in 0..6 {
            let corner = DVec3::new(
                2.0 * f64::from(column) - 6.0,
                2.0 * f64::from(row) - 4.0,
                0.0,
            );
            mesh.append(&tile, DAffine3::from_translation(corner));
        }
    }
    mesh
}

/// Color of patches of 32 texels (a quarter of a metre) with features of 2 to 6 texels.
fn patch_color(x: u32, y: u32) -> [f64; 3] {
    let (column, row) = (x / 32, y / 32);
    let period = 4 + 2 * (noise(column + 9, row + 5) * 4.0) as u32;
    let light = match (noise(column, row) * 6.0) as u32 {
        0 => x % period < period / 2,
        1 => y % period < period / 2,
        2 => (x + y) % period < period / 2,
        3 => (x + 256 - y) % period < period / 2,
        4 => (x % period < period / 2) ^ (y % period < period / 2),
        _ => noise(x / 2 + 1000, y / 2) < 0.5,
    };
    let hue = |channel: u32| 0.35 + 0.6 * noise(column + 17 * channel, row + 31);
    let color = [hue(1), hue(2), hue(3)];
    color.map(|component| if light { component } else { component * 0.3 })
}

/// Color of bricks of 64 x 32 texels with mortar of 4 texels, every second course shifted by half a
/// brick.
fn brick_color(x: u32, y: u32) -> [f64; 3] {
    let course = y / 32;
    let along = (x + 32 * (course % 2)) % 256;
    let grain = 0.06 * (noise(x, y) - 0.5);
    let color = if y % 32 < 4 || along % 64 < 4 {
        [0.78, 0.76, 0.72]
    } else {
        let shade = 0.75 + 0.35 * noise(along / 64, course);
        [0.66 * shade, 0.36 * shade, 0.28 * shade]
    };
    color.map(|component| component + grain)
}
