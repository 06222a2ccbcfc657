//! A goods train of box wagons along the X axis, its rails' top at y = 0, its middle at z = 0.

use glam::{DAffine3, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::noise::noise;
use crate::revolution::revolve;
use crate::texture::encode_png;

/// Length of a wagon from coupling to coupling, in metres.
const WAGON: f64 = 8.0;

/// Number of wagons on either side of the middle one.
const NEIGHBOURS: i32 = 2;

const MATERIALS: &str = "\
newmtl red
Kd 0.85 0.3 0.2
map_Kd planks.png
newmtl green
Kd 0.35 0.62 0.32
map_Kd planks.png
newmtl ochre
Kd 0.95 0.72 0.3
map_Kd planks.png
newmtl door
Kd 0.55 0.58 0.62
map_Kd planks.png
newmtl roof
Kd 0.32 0.32 0.34
newmtl iron
Kd 0.07 0.07 0.08
newmtl tread
Kd 0.5 0.5 0.52
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    for index in -NEIGHBOURS..=NEIGHBOURS {
        let body = ["red", "green", "ochre"][(index + 3) as usize % 3];
        let place = DAffine3::from_translation(DVec3::new(WAGON * f64::from(index), 0.0, 0.0));
        mesh.append(&wagon(body), place);
    }
    let mut files = model_files("train", &mesh, MATERIALS);
    files.push(("planks.png".into(), encode_png(128, plank_color)));
    files
}

fn wagon(body: &'static str) -> Mesh {
    let mut mesh = Mesh::default();
    let mut add = |material, [x, y, z]: [f64; 3], [length, height, width]: [f64; 3]| {
        let size = DVec3::new(length, height, width);
        add_cuboid(&mut mesh, material, DVec3::new(x, y, z), size, 1);
    };
    add(body, [0.0, 2.2, 0.0], [7.3, 2.4, 2.5]);
    add("roof", [0.0, 3.44, 0.0], [7.5, 0.1, 2.7]);
    add("iron", [0.0, 0.9, 0.0], [7.4, 0.2, 2.3]);
    add("iron", [0.5 * WAGON, 0.85, 0.0], [0.9, 0.14, 0.14]);
    for side in [1.0, -1.0] {
        add("door", [0.0, 2.15, 1.28 * side], [1.9, 2.1, 0.06]);
        add("iron", [0.0, 3.25, 1.3 * side], [4.0, 0.08, 0.08]);
        for end in [-3.6, 3.6] {
            // Bars are on the side of the body and not in it, so that their ends share no place.
            add("iron", [end, 2.2, 1.27 * side], [0.1, 2.4, 0.04]);
        }
        for axle in [-2.5, 2.5] {
            add("iron", [axle, 0.62, 1.0 * side], [0.5, 0.4, 0.1]);
        }
    }
    for axle in [-2.5, 2.5] {
        mesh.append(
            &wheels(),
            DAffine3::from_translation(DVec3::new(axle, 0.46, 0.0)),
        );
    }
    mesh
}

/// Two wheels on an axle along Z.
fn wheels() -> Mesh {
    let mut mesh = Mesh::default();
    for z in [-0.75, 0.75] {
        let rim = [
            (0.0, z - 0.06),
            (0.46, z - 0.06),
            (0.46, z + 0.06),
            (0.38, z + 0.06),
        ];
        revolve(&mut mesh, |_| "tread", 20, &rim);
        revolve(
            &mut mesh,
            |_| "iron",
            20,
            &[(0.38, z + 0.06), (0.0, z + 0.09)],
        );
    }
    mesh
}

/// Color of upright planks of 8 texels, and a white band with marks like a number.
fn plank_color(x: u32, y: u32) -> [f64; 3] {
    let marks = (70..92).contains(&y) && (18..46).contains(&x) && noise(x / 7, 3 + y / 8) < 0.6;
    let light = if x.is_multiple_of(8) {
        0.4
    } else {
        0.82 + 0.25 * (noise(x / 8, 1) - 0.5)
    };
    let rust = if y > 108 { 0.85 } else { 1.0 };
    [if marks {
        1.0
    } else {
        light * rust + 0.06 * (noise(x, y) - 0.5)
    }; 3]
}
