//! A grindstone, the sparks that fly from it, and the smoke above it: cards with soft textures, as
//! particle systems draw them.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec2, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::{Mesh, Vertex};
use crate::noise::{noise, soft_noise};
use crate::revolution::revolve;
use crate::texture::encode_png;

/// Radius of the stone, in metres.
const RADIUS: f64 = 0.55;
/// Sparks of one flight.
const SPARKS: u32 = 36;
/// Side of the textures, in texels.
const TEXELS: u32 = 64;

/// Everything is unlit, so that a truth takes no light noise and little time.
const STONE: &str = "\
newmtl stone
Kd 0 0 0
Ke 0.2 0.18 0.17
newmtl mark
Kd 0 0 0
Ke 0.6 0.5 0.1
newmtl hub
Kd 0 0 0
Ke 0.06 0.07 0.09
";
const SPARK: &str = "newmtl spark\nKd 0 0 0\nKe 1.6 0.9 0.3\nmap_d spark.png\n";
const SMOKE: &str = "newmtl smoke\nKd 0 0 0\nKe 0.5 0.5 0.53\nd 0.7\nmap_d smoke.png\n";

pub(crate) fn files() -> Files {
    let mut files = model_files("stone", &stone(), STONE);
    for flight in 0..3 {
        let name = format!("sparks_{}", flight + 1);
        let library = model_files(&name, &sparks(flight), SPARK);
        files.extend(library);
    }
    files.extend(model_files("smoke", &smoke(), SMOKE));
    files.push(("spark.png".into(), encode_png(TEXELS, spark_opacity)));
    files.push(("smoke.png".into(), encode_png(TEXELS, smoke_opacity)));
    files
}

/// The stone about the Z axis.
fn stone() -> Mesh {
    let mut mesh = Mesh::default();
    let outline = [(0.0, -0.1), (RADIUS, -0.1), (RADIUS, 0.1), (0.12, 0.1)];
    revolve(&mut mesh, |_| "stone", 48, &outline);
    revolve(
        &mut mesh,
        |_| "hub",
        24,
        &[(0.0, 0.13), (0.12, 0.13), (0.12, 0.1)],
    );
    for mark in 0..5 {
        let mut bar = Mesh::default();
        let place = DVec3::new(0.62 * RADIUS, 0.0, 0.105);
        add_cuboid(&mut bar, "mark", place, DVec3::new(0.28, 0.07, 0.02), 1);
        mesh.append(&bar, DAffine3::from_rotation_z(TAU * f64::from(mark) / 5.0));
    }
    mesh
}

/// Adds a square card that faces +Z and shows the whole texture.
fn add_card(mesh: &mut Mesh, material: &'static str, centre: DVec3, side: f64) {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let vertex = |[u, v]: [f64; 2]| Vertex {
        position: centre + side * DVec3::new(u - 0.5, v - 0.5, 0.0),
        normal: DVec3::Z,
        texcoord: DVec2::new(u, v),
    };
    mesh.add_polygon(material, &corners.map(vertex));
}

/// Sparks of one flight: a slice of a cone from the origin to the right.
fn sparks(flight: u32) -> Mesh {
    let mut mesh = Mesh::default();
    for spark in 0..SPARKS {
        let chance = |which: u32| noise(SPARKS * flight + spark, 40 + which);
        let distance = 0.4 + 3.4 * chance(0);
        let slope = 0.42 - 0.33 * f64::from(flight) + 0.3 * (chance(1) - 0.5);
        let place = DVec3::new(distance, slope * distance, 0.4 * (chance(2) - 0.5));
        add_card(&mut mesh, "spark", place, 0.1 + 0.07 * chance(3));
    }
    mesh
}

/// Puffs around the origin, one before the other.
fn smoke() -> Mesh {
    let mut mesh = Mesh::default();
    for puff in 0..6 {
        let chance = |which: u32| noise(puff, 80 + which) - 0.5;
        let height = 0.28 * f64::from(puff);
        let place = DVec3::new(0.7 * chance(0), height, 0.2 + 0.03 * f64::from(puff));
        add_card(&mut mesh, "smoke", place, 0.9 + 0.2 * f64::from(puff));
    }
    mesh
}

/// Distance from a texture's middle, as a part of half its side.
fn radius(x: u32, y: u32) -> f64 {
    let from_middle = |texel: u32| (f64::from(texel) + 0.5) / f64::from(TEXELS) * 2.0 - 1.0;
    from_middle(x).hypot(from_middle(y))
}

/// A bright core with a soft rim, as grey.
fn spark_opacity(x: u32, y: u32) -> [f64; 3] {
    [(1.6 * (1.0 - radius(x, y))).clamp(0.0, 1.0); 3]
}

/// A ragged puff that fades outwards, as grey.
fn smoke_opacity(x: u32, y: u32) -> [f64; 3] {
    let ragged = 0.5 * soft_noise(x, y, 16, TEXELS) + 0.3 * soft_noise(x, y, 8, TEXELS);
    [(1.25 * (1.0 - radius(x, y)) * (0.55 + ragged)).clamp(0.0, 1.0); 3]
}
