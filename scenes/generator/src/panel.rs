//! The moving panel of the panel scenes: a thin square box that emits light.

use glam::DVec3;

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::texture::encode_png;

/// Edge of the front face, in metres.
const EDGE: f64 = 0.8;

/// Thickness behind the front face at z = 0, in metres. The sides appear as less than a tenth of a
/// pixel, so that the smear is that of a square.
const THICKNESS: f64 = 0.004;

/// Texels along an edge.
const TEXELS: u32 = 128;

const MATERIALS: &str = "\
# Unlit: it calibrates without light noise.
newmtl panel
Kd 0 0 0
Ke 1 1 1
map_Ke panel.png
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    let centre = DVec3::new(0.0, 0.0, -THICKNESS / 2.0);
    add_cuboid(
        &mut mesh,
        "panel",
        centre,
        DVec3::new(EDGE, EDGE, THICKNESS),
        8,
    );
    let mut files = model_files("panel", &mesh, MATERIALS);
    files.push(("panel.png".into(), encode_png(TEXELS, color)));
    files
}

/// Color of a warm checkerboard with a light frame and a disc, brighter than the walls so that its
/// smear shows.
fn color(x: u32, y: u32) -> [f64; 3] {
    let border = x.min(y).min(TEXELS - 1 - x).min(TEXELS - 1 - y);
    let middle = f64::from(TEXELS - 1) / 2.0;
    let radius = (f64::from(x) - middle).hypot(f64::from(y) - middle);
    if border < 6 {
        [1.0, 0.97, 0.85]
    } else if radius < 20.0 {
        [0.98, 0.55, 0.35]
    } else if (x / 16 + y / 16).is_multiple_of(2) {
        [1.0, 0.86, 0.45]
    } else {
        [0.85, 0.68, 0.4]
    }
}
