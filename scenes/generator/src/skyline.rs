//! A skyline of towers across -Z, with windows, masts and a river front before it.

use glam::{DVec2, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::noise::noise;
use crate::revolution::revolve_upright;
use crate::texture::encode_png;

/// Texels along an edge of a texture, and of a window.
const TEXELS: u32 = 128;
const WINDOW: u32 = 8;

/// Length of wall that a texture covers, in metres.
const TILE: f64 = 48.0;

const MATERIALS: &str = "\
newmtl stone
Kd 0.8 0.72 0.6
map_Kd windows.png
newmtl glass
Kd 0.45 0.6 0.72
map_Kd windows.png
newmtl brick
Kd 0.72 0.42 0.34
map_Kd windows.png
newmtl concrete
Kd 0.62 0.62 0.62
map_Kd windows.png
newmtl roof
Kd 0.25 0.25 0.27
newmtl water
Kd 0.12 0.17 0.2
newmtl quay
Kd 0.42 0.4 0.36
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    let walls = ["stone", "glass", "brick", "concrete"];
    for index in 0..34u32 {
        let random = |seed: u32| noise(index, 40 + seed);
        // Two rows of towers on an arc of 140 degrees around the viewer.
        let angle = (140.0 * (f64::from(index) + 0.3 * random(0)) / 34.0 - 70.0).to_radians();
        let distance = if index.is_multiple_of(2) {
            260.0
        } else {
            380.0
        };
        let middle = distance * DVec2::new(angle.sin(), -angle.cos());
        let size = DVec3::new(
            26.0 + 18.0 * random(1),
            35.0 + 110.0 * random(2).powi(2) + 0.08 * (distance - 260.0),
            24.0 + 10.0 * random(3),
        );
        add_tower(&mut mesh, walls[index as usize % 4], middle, size);
        if random(4) > 0.6 {
            let foot = DVec3::new(middle.x, size.y + 4.0, middle.y);
            revolve_upright(
                &mut mesh,
                "roof",
                6,
                &[(0.9, 0.0), (0.2, 26.0), (0.0, 26.5)],
                foot,
            );
        }
    }
    let mut flat = |material, half: [f64; 2], z: f64, y: f64| {
        mesh.add_surface(
            [8, 2],
            |_, _| material,
            |u, v| DVec3::new(half[0] * (2.0 * u - 1.0), y, z + half[1] * (1.0 - 2.0 * v)),
        );
    };
    flat("quay", [900.0, 260.0], -380.0, 0.0);
    flat("water", [900.0, 120.0], 0.0, -1.0);
    let mut files = model_files("skyline", &mesh, MATERIALS);
    files.push(("windows.png".into(), encode_png(TEXELS, window_color)));
    files
}

/// Adds a tower of three parts, each narrower than the one below, with windows of one size.
fn add_tower(mesh: &mut Mesh, wall: &'static str, middle: DVec2, size: DVec3) {
    let mut foot = 0.0;
    for (part, width) in [(0.6, 1.0), (0.3, 0.78), (0.1, 0.5)] {
        let (height, [x, z]) = (part * size.y, [width * size.x, width * size.z]);
        let mut block = Mesh::default();
        let centre = DVec3::new(middle.x, foot + 0.5 * height, middle.y);
        add_cuboid(&mut block, wall, centre, DVec3::new(x, height, z), 1);
        // A whole number of windows, so that no edge cuts one.
        let windows = f64::from(TEXELS / WINDOW);
        let whole = |length: f64| (length / TILE * windows).round() / windows;
        block.repeat_texture(DVec2::new(whole(x), whole(height)));
        mesh.append(&block, glam::DAffine3::IDENTITY);
        foot += height;
    }
    let roof = DVec3::new(0.52 * size.x, 1.0, 0.52 * size.z);
    add_cuboid(
        mesh,
        "roof",
        DVec3::new(middle.x, foot + 0.5, middle.y),
        roof,
        1,
    );
}

/// Color of a light wall with dark panes, some with blinds.
fn window_color(x: u32, y: u32) -> [f64; 3] {
    let pane = (2..7).contains(&(x % WINDOW)) && (2..6).contains(&(y % WINDOW));
    let random = noise(x / WINDOW, y / WINDOW);
    match (pane, random > 0.75) {
        (true, true) => [0.85; 3],
        (true, false) => [0.25 + 0.2 * random; 3],
        _ => [0.95; 3],
    }
}
