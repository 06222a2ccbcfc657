//! A crossing of two roads at y = 0, seen from above: asphalt, lines, zebra crossings and
//! pavements.

use glam::{DVec2, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::ground::{asphalt, ground_files, slabs};
use crate::mesh::Mesh;
use crate::texture::encode_png;

/// Distance from the middle of a road to its edge, in metres.
const HALF_WIDTH: f64 = 3.6;

/// Distance from the middle of the crossing to the end of the ground, in metres.
const END: f64 = 20.0;

const MATERIALS: &str = "\
newmtl paint
Kd 0.85 0.85 0.82
newmtl slabs
Kd 1 1 1
map_Kd slabs.png
newmtl kerb
Kd 0.6 0.6 0.58
newmtl cover
Kd 0.12 0.12 0.12
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    // Paint lies a little above the asphalt, so that rays tell them apart.
    let mut patch = |material, x: f64, z: f64, length: f64, width: f64| {
        let size = DVec3::new(length, 0.01, width);
        add_cuboid(&mut mesh, material, DVec3::new(x, 0.005, z), size, 1);
    };
    for side in [-1.0, 1.0] {
        let edge = side * HALF_WIDTH;
        for stripe in 0..6 {
            let across = 1.2 * (f64::from(stripe) - 2.5);
            patch("paint", edge + side * 1.8, across, 2.6, 0.55);
            patch("paint", across, edge + side * 1.8, 0.55, 2.6);
        }
        for dash in 0..5 {
            let along = side * (9.0 + 2.6 * f64::from(dash));
            patch("paint", along, 0.0, 1.4, 0.15);
            patch("paint", 0.0, along, 0.15, 1.4);
        }
        patch("cover", 2.2 * side, 1.4 * side, 0.6, 0.6);
    }
    for (x, z) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
        add_pavement(&mut mesh, DVec2::new(x, z));
    }
    let mut files = model_files("crossroads", &mesh, MATERIALS);
    files.push(("slabs.png".into(), encode_png(128, slabs)));
    files.extend(ground_files(
        "asphalt",
        [DVec2::splat(-END), DVec2::splat(END)],
        2.0,
        asphalt,
    ));
    files
}

/// Adds the corner between two roads, higher by a kerb, with slabs of half a metre.
fn add_pavement(mesh: &mut Mesh, quarter: DVec2) {
    let height = 0.12;
    let middle = 0.5 * (END + HALF_WIDTH) * quarter;
    let width = END - HALF_WIDTH;
    let size = DVec3::new(width, height, width);
    add_cuboid(
        mesh,
        "kerb",
        DVec3::new(middle.x, 0.5 * height, middle.y),
        size,
        1,
    );
    let from = middle - 0.5 * width + 0.15;
    let mut top = Mesh::default();
    top.add_surface(
        [4, 4],
        |_, _| "slabs",
        |u, v| {
            let place = from + (width - 0.3) * DVec2::new(u, 1.0 - v);
            DVec3::new(place.x, height + 0.002, place.y)
        },
    );
    top.repeat_texture(DVec2::splat(8.0));
    mesh.append(&top, glam::DAffine3::IDENTITY);
}
