//! A village among fields, seen from a low aeroplane.

use glam::{DAffine3, DVec2, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::noise::{noise, soft_noise};
use crate::prism::{add_face, add_prism};
use crate::texture::encode_png;
use crate::tree;

/// Half the length of the ground, in metres.
const HALF_LENGTH: f64 = 1600.0;

const MATERIALS: &str = "\
newmtl fields
Kd 1 1 1
map_Kd fields.png
newmtl plaster
Kd 0.82 0.76 0.66
newmtl tiles
Kd 0.6 0.22 0.13
newmtl window
Kd 0.1 0.12 0.16
newmtl road
Kd 0.4 0.4 0.42
newmtl spire
Kd 0.2 0.26 0.3
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    mesh.add_surface(
        [16, 16],
        |_, _| "fields",
        |u, v| HALF_LENGTH * DVec3::new(2.0 * u - 1.0, 0.0, 1.0 - 2.0 * v),
    );
    mesh.repeat_texture(DVec2::splat(8.0));
    add_cuboid(
        &mut mesh,
        "road",
        DVec3::new(0.0, 0.2, -300.0),
        DVec3::new(9.0, 0.4, 1800.0),
        1,
    );
    add_cuboid(
        &mut mesh,
        "road",
        DVec3::new(0.0, 0.2, -190.0),
        DVec3::new(1800.0, 0.4, 8.0),
        1,
    );
    for index in 0..24u32 {
        let random = |seed: u32| noise(index, 70 + seed);
        let side = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        let at = DVec3::new(
            side * (16.0 + 75.0 * random(1).powi(2)),
            0.0,
            -80.0 - 13.0 * f64::from(index),
        );
        let turn = DAffine3::from_rotation_y(0.4 * random(2) + 1.57 * f64::from(index % 2));
        let size = DVec3::new(12.0 + 6.0 * random(3), 6.0 + 3.0 * random(4), 9.0);
        mesh.append(&house(size), DAffine3::from_translation(at) * turn);
        if index.is_multiple_of(2) {
            let beside = at + DVec3::new(side * 14.0, 0.0, 5.0 - 10.0 * random(5));
            tree::add_tree(&mut mesh, beside, 7.0 + 6.0 * random(6), index);
        }
    }
    mesh.append(
        &church(),
        DAffine3::from_translation(DVec3::new(-30.0, 0.0, -170.0)),
    );
    let mut files = model_files("village", &mesh, &format!("{MATERIALS}{}", tree::MATERIALS));
    files.push(("fields.png".into(), encode_png(128, field_color)));
    files
}

/// House with windows and a gabled roof, its ridge along X.
fn house(size: DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    add_cuboid(
        &mut mesh,
        "plaster",
        DVec3::new(0.0, 0.5 * size.y, 0.0),
        size,
        1,
    );
    for side in [-1.0, 1.0] {
        for window in -1..=1 {
            let x = 0.3 * size.x * f64::from(window);
            let pane = [(-0.8, -1.0), (0.8, -1.0), (0.8, 1.0), (-0.8, 1.0)].map(|(dx, dy)| {
                DVec3::new(
                    x + side * dx,
                    0.55 * size.y + dy,
                    side * (0.5 * size.z + 0.1),
                )
            });
            add_face(&mut mesh, "window", &pane);
        }
    }
    add_roof(&mut mesh, size, 0.65 * size.z);
    mesh
}

fn add_roof(mesh: &mut Mesh, size: DVec3, height: f64) {
    let at = |x: f64, y: f64, z: f64| DVec3::new(0.54 * size.x * x, size.y + y, 0.58 * size.z * z);
    for side in [-1.0, 1.0] {
        let slope = [
            at(-side, -0.4, side),
            at(side, -0.4, side),
            at(side, height, 0.0),
            at(-side, height, 0.0),
        ];
        add_face(mesh, "tiles", &slope);
        let gable = [
            at(0.93 * side, 0.0, side),
            at(0.93 * side, 0.0, -side),
            at(0.93 * side, height, 0.0),
        ];
        add_face(mesh, "plaster", &gable);
    }
}

fn church() -> Mesh {
    let mut mesh = house(DVec3::new(30.0, 10.0, 13.0));
    add_cuboid(
        &mut mesh,
        "plaster",
        DVec3::new(-18.0, 13.0, 0.0),
        DVec3::new(8.0, 26.0, 8.0),
        1,
    );
    let corners = [(-4.5, 0.0), (4.5, 0.0), (0.0, 18.0)].map(DVec2::from);
    let mut gable = Mesh::default();
    add_prism(&mut gable, "spire", &corners, [-4.5, 4.5]);
    mesh.append(
        &gable,
        DAffine3::from_translation(DVec3::new(-18.0, 26.0, 0.0)),
    );
    mesh
}

/// Color of patches of 32 texels, each with furrows of its own.
fn field_color(x: u32, y: u32) -> [f64; 3] {
    let [column, row] = [x / 32, y / 32];
    let kind = noise(column + 3, row + 8);
    let furrow = if kind < 0.5 { x % 4 < 2 } else { y % 4 < 2 };
    let light = if furrow { 1.0 } else { 0.82 } + 0.2 * (soft_noise(x, y, 4, 128) - 0.5);
    let color = match (4.0 * noise(column, row)) as u32 {
        0 => [0.42, 0.56, 0.24],
        1 => [0.8, 0.7, 0.34],
        2 => [0.52, 0.4, 0.28],
        _ => [0.34, 0.48, 0.22],
    };
    let hedge = x.is_multiple_of(32) || y.is_multiple_of(32);
    if hedge {
        [0.14, 0.24, 0.1]
    } else {
        color.map(|part| part * light)
    }
}
