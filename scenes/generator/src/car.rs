//! A saloon car that heads for +X, without its wheels. The ground is y = 0, z = 0 its middle.

use glam::DVec3;

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::wheel;

/// Distance from the middle to either end, in metres.
const HALF_LENGTH: f64 = 2.1;

/// Distance from the middle to either axle, in metres.
const AXLE: f64 = 1.3;

/// Height of the floor above the ground, in metres.
const CLEARANCE: f64 = 0.26;

/// Height of the lower edge of the windows above the ground, in metres.
const SILL: f64 = 0.94;

/// Upper outline, as (position along, height) from rear to front, in metres.
const TOP: [(f64, f64); 10] = [
    (-2.1, 0.6),
    (-2.04, 0.86),
    (-1.5, 0.93),
    (-0.95, 1.36),
    (-0.2, 1.43),
    (0.35, 1.38),
    (1.0, 0.95),
    (1.8, 0.8),
    (2.04, 0.7),
    (2.1, 0.5),
];

const MATERIALS: &str = "\
newmtl paint
Kd 0.7 0.07 0.05
newmtl glass
Kd 0.05 0.07 0.09
newmtl trim
Kd 0.04 0.04 0.04
newmtl headlight
Kd 0.9 0.9 0.8
newmtl tail_light
Kd 0.5 0.02 0.02
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    for side in [1.0, -1.0] {
        add_side(&mut mesh, side);
        add_end(&mut mesh, side);
        add_lights(&mut mesh, side);
    }
    add_top(&mut mesh);
    add_floor(&mut mesh);
    model_files("car", &mesh, MATERIALS)
}

/// Position along the car at `u` of its length, in metres; 0 is the end at -`direction`.
fn along(u: f64, direction: f64) -> f64 {
    direction * HALF_LENGTH * (2.0 * u.clamp(0.0, 1.0) - 1.0)
}

fn top(x: f64) -> f64 {
    let next = TOP
        .partition_point(|point| point.0 < x)
        .clamp(1, TOP.len() - 1);
    let [from, to] = [TOP[next - 1], TOP[next]];
    from.1 + (x - from.0) / (to.0 - from.0) * (to.1 - from.1)
}

/// Height of the lower edge, cut out above the wheels.
fn bottom(x: f64) -> f64 {
    let from_axle = x.abs() - AXLE;
    let arch = wheel::RADIUS + 0.06;
    let cut = (arch * arch - from_axle * from_axle).max(0.0).sqrt();
    if cut > 0.0 {
        wheel::RADIUS + cut
    } else {
        CLEARANCE
    }
}

/// Distance from the middle to the side at a height: widest at the doors, narrower towards the
/// roof.
fn half_width(y: f64) -> f64 {
    if y < 0.9 {
        0.85 - 0.3 * (y - 0.65).powi(2)
    } else {
        0.83 - 0.45 * (y - 0.9)
    }
}

/// Adds a flank: rows below the windows, then rows of windows, which shrink to nothing at bonnet
/// and boot.
fn add_side(mesh: &mut Mesh, side: f64) {
    let (columns, rows, rows_below) = (60, 14, 8);
    let position = |u: f64, v: f64| {
        let x = along(u, side);
        let belt = SILL.min(top(x) - 0.02);
        let row = v * rows as f64;
        let y = if row < rows_below as f64 {
            bottom(x) + row / rows_below as f64 * (belt - bottom(x))
        } else {
            belt + (row - rows_below as f64) / (rows - rows_below) as f64 * (top(x) - belt)
        };
        DVec3::new(x, y, side * half_width(y))
    };
    let material = |column, row| {
        let x = along((column as f64 + 0.5) / columns as f64, side);
        let pillar = (x + 0.3).abs() < 0.06;
        let cabin = (-1.3..0.85).contains(&x);
        if row == 0 {
            "trim"
        } else if cabin && !pillar && (rows_below..rows - 1).contains(&row) {
            "glass"
        } else {
            "paint"
        }
    };
    mesh.add_surface([columns, rows], material, position);
}

/// Adds bonnet, windscreen, roof and boot.
fn add_top(mesh: &mut Mesh) {
    let size = [60, 8];
    let position = |u: f64, v: f64| {
        let x = along(u, 1.0);
        DVec3::new(x, top(x), half_width(top(x)) * (1.0 - 2.0 * v))
    };
    let material = |column, row| {
        let x = along((column as f64 + 0.5) / size[0] as f64, 1.0);
        let screen = (0.42..0.95).contains(&x) || (-1.42..-1.02).contains(&x);
        if screen && (1..size[1] - 1).contains(&row) {
            "glass"
        } else {
            "paint"
        }
    };
    mesh.add_surface(size, material, position);
}

fn add_floor(mesh: &mut Mesh) {
    mesh.add_surface(
        [60, 1],
        |_, _| "trim",
        |u, v| {
            let x = along(u, 1.0);
            DVec3::new(x, bottom(x), half_width(bottom(x)) * (2.0 * v - 1.0))
        },
    );
}

/// Adds the front (1) or the rear (-1).
fn add_end(mesh: &mut Mesh, end: f64) {
    let x = end * HALF_LENGTH;
    mesh.add_surface(
        [4, 4],
        |_, row| if row < 2 { "trim" } else { "paint" },
        |u, v| {
            let y = bottom(x) + v * (top(x) - bottom(x));
            DVec3::new(x, y, end * half_width(y) * (1.0 - 2.0 * u))
        },
    );
}

/// Adds the lamps of both ends on one side, set into the corners.
fn add_lights(mesh: &mut Mesh, side: f64) {
    let size = DVec3::new(0.2, 0.12, 0.2);
    add_cuboid(
        mesh,
        "headlight",
        DVec3::new(1.98, 0.63, side * 0.74),
        size,
        1,
    );
    add_cuboid(
        mesh,
        "tail_light",
        DVec3::new(-2.0, 0.75, side * 0.74),
        size,
        1,
    );
}
