//! The cockpit of a car around the driver's eye, which is the origin and looks along -Z.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};

use crate::cuboid::add_cuboid;
use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::{add_ring, revolve};
use crate::tube::{add_rod, add_tube};

const MATERIALS: &str = "\
newmtl plastic
Kd 0.16 0.16 0.17
newmtl wood
Kd 0.42 0.22 0.1
newmtl dial
Kd 0.02 0.02 0.02
newmtl mark
Kd 0.9 0.9 0.86
newmtl needle
Kd 0.9 0.12 0.04
newmtl leather
Kd 0.1 0.07 0.05
newmtl chrome
Kd 0.6 0.6 0.62
newmtl bonnet
Kd 0.12 0.34 0.2
newmtl trim
Kd 0.3 0.29 0.27
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    add_board(&mut mesh);
    for (x, turn) in [(-0.37, 0.62), (-0.17, 0.3)] {
        mesh.append(
            &dial(turn),
            DAffine3::from_translation(DVec3::new(x, -0.275, -0.56)),
        );
    }
    add_steering_wheel(&mut mesh);
    add_window_frame(&mut mesh);
    add_ellipsoid(
        &mut mesh,
        "bonnet",
        DVec3::new(0.1, -0.74, -1.75),
        DVec3::new(0.85, 0.3, 0.95),
        [40, 16],
    );
    model_files("dashboard", &mesh, MATERIALS)
}

fn add_board(mesh: &mut Mesh) {
    // Outline (y, z) from the knees over the edge to the windscreen.
    let outline = [
        (-0.7, -0.4),
        (-0.4, -0.44),
        (-0.33, -0.5),
        (-0.31, -0.6),
        (-0.32, -1.0),
    ];
    for (index, piece) in outline.windows(2).enumerate() {
        let material = if index == 1 { "wood" } else { "plastic" };
        mesh.add_surface(
            [16, 1],
            |_, _| material,
            |u, v| {
                let (y, z) = (
                    piece[0].0 + v * (piece[1].0 - piece[0].0),
                    piece[0].1 + v * (piece[1].1 - piece[0].1),
                );
                DVec3::new(1.6 * (u - 0.5), y, z)
            },
        );
    }
    add_ellipsoid(
        mesh,
        "plastic",
        DVec3::new(-0.27, -0.3, -0.66),
        DVec3::new(0.26, 0.15, 0.1),
        [24, 10],
    );
    for vent in 0..2 {
        for slat in 0..4 {
            let at = DVec3::new(
                0.12 + 0.24 * f64::from(vent),
                -0.345 - 0.016 * f64::from(slat),
                -0.475,
            );
            add_cuboid(mesh, "trim", at, DVec3::new(0.16, 0.006, 0.02), 1);
        }
    }
    add_cuboid(
        mesh,
        "trim",
        DVec3::new(0.24, -0.46, -0.44),
        DVec3::new(0.34, 0.09, 0.03),
        1,
    );
    for knob in [0.1, 0.24, 0.38] {
        add_ellipsoid(
            mesh,
            "chrome",
            DVec3::new(knob, -0.46, -0.42),
            DVec3::splat(0.02),
            [12, 8],
        );
    }
}

/// Round instrument that faces the driver; `turn` is the angle of its needle in full turns.
fn dial(turn: f64) -> Mesh {
    let mut mesh = Mesh::default();
    revolve(&mut mesh, |_| "dial", 28, &[(0.075, 0.0), (0.0, 0.0)]);
    add_ring(&mut mesh, "chrome", [0.078, 0.006], 0.0, [28, 6]);
    for mark in 0..10 {
        let angle = TAU * (0.1 + 0.8 * f64::from(mark) / 9.0) - 0.25 * TAU;
        let out = DVec3::new(angle.cos(), angle.sin(), 0.0);
        add_rod(
            &mut mesh,
            "mark",
            [
                0.055 * out + 0.002 * DVec3::Z,
                0.07 * out + 0.002 * DVec3::Z,
            ],
            0.003,
        );
    }
    let angle = TAU * turn;
    let tip = DVec3::new(0.06 * angle.cos(), 0.06 * angle.sin(), 0.006);
    add_rod(
        &mut mesh,
        "needle",
        [DVec3::new(0.0, 0.0, 0.006), tip],
        0.003,
    );
    mesh
}

fn add_steering_wheel(mesh: &mut Mesh) {
    let mut wheel = Mesh::default();
    add_ring(&mut wheel, "leather", [0.2, 0.017], 0.0, [48, 8]);
    for angle in [0.0, 0.5 * TAU, 0.75 * TAU] {
        let out = DVec3::new(f64::cos(angle), f64::sin(angle), 0.0);
        add_rod(&mut wheel, "chrome", [0.03 * out, 0.19 * out], 0.012);
    }
    add_ellipsoid(
        &mut wheel,
        "leather",
        DVec3::ZERO,
        DVec3::new(0.06, 0.06, 0.025),
        [20, 8],
    );
    let place = DAffine3::from_translation(DVec3::new(-0.27, -0.4, -0.48));
    mesh.append(&wheel, place * DAffine3::from_rotation_x(-0.35));
}

/// Adds pillars, the edge of the roof and the mirror.
fn add_window_frame(mesh: &mut Mesh) {
    for side in [-1.0, 1.0] {
        let pillar = [
            DVec3::new(0.78 * side, -0.36, -0.95),
            DVec3::new(0.62 * side, 0.4, -0.66),
        ];
        add_tube(mesh, "plastic", 8, &pillar, |_| 0.035);
    }
    add_cuboid(
        mesh,
        "plastic",
        DVec3::new(0.0, 0.36, -0.66),
        DVec3::new(1.5, 0.12, 0.1),
        1,
    );
    add_cuboid(
        mesh,
        "trim",
        DVec3::new(0.14, 0.21, -0.6),
        DVec3::new(0.2, 0.06, 0.03),
        1,
    );
    add_rod(
        mesh,
        "trim",
        [DVec3::new(0.14, 0.23, -0.61), DVec3::new(0.14, 0.32, -0.64)],
        0.008,
    );
}
