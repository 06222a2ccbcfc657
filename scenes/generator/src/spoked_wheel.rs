//! The wheel of a motorbike about the Z axis, the still cover on its hub, and its fork.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};

use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::prism::{add_prism, star_outline};
use crate::revolution::{add_ring, revolve};
use crate::tube::{add_rod, add_tube};

/// Outer radius of the tyre, in metres.
const RADIUS: f64 = 0.32;

const SPOKES: u32 = 14;

const MATERIALS: &str = "\
newmtl tyre
Kd 0.05 0.05 0.05
newmtl tread
Kd 0.13 0.13 0.13
newmtl rim
Kd 0.62 0.62 0.64
newmtl spoke
Kd 0.75 0.62 0.2
newmtl marked
Kd 0.8 0.1 0.06
newmtl cover
Kd 0.12 0.2 0.42
newmtl star
Kd 0.92 0.9 0.84
newmtl fork
Kd 0.5 0.52 0.54
newmtl mudguard
Kd 0.45 0.06 0.05
";

pub(crate) fn files() -> Files {
    [
        model_files("wheel", &wheel(), MATERIALS),
        model_files("cover", &cover(), MATERIALS),
        model_files("fork", &fork(), MATERIALS),
    ]
    .concat()
}

fn wheel() -> Mesh {
    let mut mesh = Mesh::default();
    add_ring(&mut mesh, "tyre", [RADIUS - 0.045, 0.042], 0.0, [56, 10]);
    add_ring(&mut mesh, "rim", [RADIUS - 0.09, 0.018], 0.0, [56, 8]);
    for block in 0..40 {
        let turn = DAffine3::from_rotation_z(TAU * f64::from(block) / 40.0);
        let mut lug = Mesh::default();
        let size = DVec3::new(0.014, 0.02, 0.08);
        crate::cuboid::add_cuboid(
            &mut lug,
            "tread",
            DVec3::new(RADIUS - 0.006, 0.0, 0.0),
            size,
            1,
        );
        mesh.append(&lug, turn);
    }
    for spoke in 0..SPOKES {
        let angle = TAU * f64::from(spoke) / f64::from(SPOKES);
        let out = DVec3::new(angle.cos(), angle.sin(), 0.0);
        // One spoke differs, so that a turn by one spoke shows.
        let material = if spoke == 0 { "marked" } else { "spoke" };
        add_rod(
            &mut mesh,
            material,
            [0.05 * out, (RADIUS - 0.1) * out],
            0.009,
        );
    }
    mesh
}

/// Disc with a star that faces +Z.
fn cover() -> Mesh {
    let mut mesh = Mesh::default();
    let outline = [
        (0.0, 0.03),
        (0.085, 0.03),
        (0.085, 0.055),
        (0.07, 0.065),
        (0.0, 0.065),
    ];
    revolve(&mut mesh, |_| "cover", 40, &outline);
    add_prism(
        &mut mesh,
        "star",
        &star_outline(5, 0.024, 0.058),
        [0.065, 0.07],
    );
    mesh
}

/// Two legs towards -X and up, and a mudguard over the tyre.
fn fork() -> Mesh {
    let mut mesh = Mesh::default();
    for z in [-0.09, 0.09] {
        add_rod(
            &mut mesh,
            "fork",
            [DVec3::new(0.0, 0.0, z), DVec3::new(-0.32, 0.8, z)],
            0.022,
        );
    }
    let arc = crate::tube::sample_curve(16, |part| {
        let angle = 0.55 + 2.3 * part;
        let radius = RADIUS + 0.045;
        DVec3::new(radius * f64::cos(angle), radius * f64::sin(angle), 0.0)
    });
    add_tube(&mut mesh, "mudguard", 6, &arc, |_| 0.03);
    mesh
}
