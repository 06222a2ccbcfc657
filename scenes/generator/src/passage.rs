//! A tiled passage along the X axis, open above: floor at y = 0, the wall with posters at z = -2.5.

use glam::{DVec2, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::noise::noise;
use crate::texture::encode_png;

/// Half the length of the passage, z of its wall and the wall's height, in metres.
const HALF_LENGTH: f64 = 40.0;
const WALL: f64 = -2.5;
const HEIGHT: f64 = 2.8;

const MATERIALS: &str = "\
newmtl tiles
Kd 1 1 1
map_Kd tiles.png
newmtl slabs
Kd 1 1 1
map_Kd slabs.png
newmtl coping
Kd 0.6 0.6 0.58
newmtl rail
Kd 0.6 0.3 0.08
newmtl poster_red
Kd 0.75 0.15 0.12
newmtl poster_blue
Kd 0.12 0.3 0.65
newmtl poster_yellow
Kd 0.9 0.7 0.15
newmtl paper
Kd 0.88 0.88 0.84
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    let strip = |material, [from, to]: [DVec3; 2], across: f64| {
        let mut strip = Mesh::default();
        strip.add_surface(
            [40, 2],
            |_, _| material,
            |u, v| from.lerp(to, v) + HALF_LENGTH * (2.0 * u - 1.0) * DVec3::X,
        );
        strip.repeat_texture(DVec2::new(2.0 * HALF_LENGTH, across));
        strip
    };
    let corner = |y: f64, z: f64| DVec3::new(0.0, y, z);
    for part in [
        strip("slabs", [corner(0.0, 2.5), corner(0.0, WALL)], 5.0),
        strip("tiles", [corner(0.0, WALL), corner(HEIGHT, WALL)], 2.8),
    ] {
        mesh.append(&part, glam::DAffine3::IDENTITY);
    }
    let rail = DVec3::new(2.0 * HALF_LENGTH, 0.06, 0.05);
    add_cuboid(
        &mut mesh,
        "rail",
        DVec3::new(0.0, 0.95, WALL + 0.08),
        rail,
        1,
    );
    let coping = DVec3::new(2.0 * HALF_LENGTH, 0.15, 0.4);
    add_cuboid(
        &mut mesh,
        "coping",
        DVec3::new(0.0, HEIGHT, WALL - 0.1),
        coping,
        1,
    );
    for index in -9..=9 {
        let x = 4.0 * f64::from(index);
        add_poster(&mut mesh, x + 2.8, index);
    }
    let mut files = model_files("passage", &mesh, MATERIALS);
    files.push(("tiles.png".into(), encode_png(128, tile_color)));
    files.push(("slabs.png".into(), encode_png(128, crate::ground::slabs)));
    files
}

/// Adds a framed poster with a headline.
fn add_poster(mesh: &mut Mesh, x: f64, index: i32) {
    let material = ["poster_red", "poster_blue", "poster_yellow"][(index + 9) as usize % 3];
    let mut sheet = |material, dx: f64, y: f64, size: [f64; 2], lift: f64| {
        let at = DVec3::new(x + dx, y, WALL + lift);
        add_cuboid(mesh, material, at, DVec3::new(size[0], size[1], 0.01), 1);
    };
    sheet("paper", 0.0, 1.65, [0.9, 1.2], 0.01);
    sheet(material, 0.0, 1.65, [0.8, 1.1], 0.02);
    for line in 0..3 {
        let width = 0.6 - 0.12 * f64::from(line);
        sheet(
            "paper",
            -0.03,
            1.95 - 0.14 * f64::from(line),
            [width, 0.07],
            0.03,
        );
    }
    sheet("paper", 0.1, 1.32, [0.36, 0.26], 0.03);
}

/// Color of square tiles of 16 texels, with a coloured course in each metre.
fn tile_color(x: u32, y: u32) -> [f64; 3] {
    let shade = 0.12 * (noise(x / 16, y / 16) - 0.5);
    if x.is_multiple_of(16) || y.is_multiple_of(16) {
        [0.42, 0.4, 0.38]
    } else if y / 16 == 5 {
        [0.15 + shade, 0.42 + shade, 0.5 + shade]
    } else {
        [0.86 + shade, 0.85 + shade, 0.76 + shade]
    }
}
