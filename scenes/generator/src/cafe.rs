//! A café's front in the plane z = 0, its pavement, its sign, a table with chairs, and planters.
//! The ground is y = 0.

use glam::{DAffine3, DVec2, DVec3};

use crate::cuboid::add_cuboid;
use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::ground::{ground_files, slabs};
use crate::mesh::Mesh;
use crate::prism::add_face;
use crate::revolution::{revolve, revolve_upright};
use crate::tube::{add_rod, add_tube, sample_curve};

const MATERIALS: &str = "\
newmtl plaster
Kd 0.78 0.68 0.5
newmtl timber
Kd 0.13 0.3 0.26
newmtl glass
Kd 0.09 0.12 0.14
newmtl curtain
Kd 0.8 0.76 0.68
newmtl awning
Kd 0.75 0.12 0.1
newmtl awning_light
Kd 0.9 0.88 0.82
newmtl metal
Kd 0.1 0.1 0.11
newmtl board
Kd 0.93 0.88 0.72
newmtl coffee
Kd 0.28 0.13 0.06
newmtl clay
Kd 0.6 0.3 0.18
newmtl slate
Kd 0.1 0.13 0.13
";

pub(crate) fn files() -> Files {
    let mut front = Mesh::default();
    add_front(&mut front);
    add_awning(&mut front);
    let mut sign = Mesh::default();
    add_sign(&mut sign);
    let mut table = Mesh::default();
    add_table(&mut table);
    let mut planter = Mesh::default();
    add_cuboid(
        &mut planter,
        "clay",
        DVec3::new(0.0, 0.2, 0.0),
        DVec3::new(0.95, 0.4, 0.4),
        1,
    );
    add_cuboid(
        &mut planter,
        "timber",
        DVec3::new(0.0, 0.38, 0.0),
        DVec3::new(1.02, 0.06, 0.46),
        1,
    );
    let mut files = [
        model_files("front", &front, MATERIALS),
        model_files("sign", &sign, MATERIALS),
        model_files("table", &table, MATERIALS),
        model_files("planter", &planter, MATERIALS),
    ]
    .concat();
    let corners = [DVec2::new(-8.0, 0.0), DVec2::new(8.0, 8.0)];
    files.extend(ground_files("pavement", corners, 2.0, slabs));
    files
}

/// Adds the wall, a door, two windows with bars and curtains, a plinth and a moulding.
fn add_front(mesh: &mut Mesh) {
    let mut add = |material, [x, y, z]: [f64; 3], size: [f64; 3]| {
        add_cuboid(mesh, material, DVec3::new(x, y, z), size.into(), 1);
    };
    add("plaster", [0.0, 2.5, -0.15], [16.0, 5.0, 0.3]);
    add("timber", [0.0, 0.2, 0.03], [16.0, 0.4, 0.06]);
    add("timber", [0.0, 2.95, 0.06], [16.0, 0.16, 0.12]);
    for x in [-2.6, 2.3] {
        add("glass", [x, 1.55, 0.02], [2.3, 1.9, 0.06]);
        for side in [-1.0, 1.0] {
            add("timber", [x + 1.2 * side, 1.55, 0.06], [0.12, 2.1, 0.12]);
            add("timber", [x, 1.55 + 1.0 * side, 0.06], [2.5, 0.12, 0.12]);
            add("timber", [x + 0.4 * side, 1.55, 0.06], [0.05, 1.9, 0.08]);
            add(
                "curtain",
                [x + 0.95 * side, 1.75, 0.055],
                [0.32, 1.45, 0.02],
            );
        }
        add("timber", [x, 2.05, 0.06], [2.3, 0.05, 0.08]);
        add("curtain", [x, 0.95, 0.055], [2.2, 0.45, 0.02]);
    }
    add("timber", [-0.15, 1.15, 0.04], [1.1, 2.3, 0.08]);
    add("glass", [-0.15, 1.45, 0.07], [0.75, 1.4, 0.05]);
    add("metal", [0.28, 1.05, 0.12], [0.04, 0.18, 0.06]);
}

/// Adds stripes of cloth over both windows, with a hanging edge.
fn add_awning(mesh: &mut Mesh) {
    for (from, count) in [(-4.0, 14), (1.0, 13)] {
        for stripe in 0..count {
            let x = from + 0.2 * f64::from(stripe);
            let material = if stripe % 2 == 0 {
                "awning"
            } else {
                "awning_light"
            };
            let at = |dx: f64, y: f64, z: f64| DVec3::new(x + dx, y, z);
            add_face(
                mesh,
                material,
                &[
                    at(0.0, 2.5, 0.95),
                    at(0.2, 2.5, 0.95),
                    at(0.2, 2.86, 0.1),
                    at(0.0, 2.86, 0.1),
                ],
            );
            add_face(
                mesh,
                material,
                &[
                    at(0.0, 2.34, 0.96),
                    at(0.1, 2.3, 0.96),
                    at(0.2, 2.34, 0.96),
                    at(0.2, 2.5, 0.95),
                ],
            );
            add_face(
                mesh,
                material,
                &[at(0.0, 2.34, 0.96), at(0.2, 2.5, 0.95), at(0.0, 2.5, 0.95)],
            );
        }
    }
}

/// Adds a round board on an arm beside the door, with a cup on it.
fn add_sign(mesh: &mut Mesh) {
    add_rod(
        mesh,
        "metal",
        [DVec3::new(0.75, 2.55, 0.0), DVec3::new(0.75, 2.55, 0.75)],
        0.025,
    );
    let mut board = Mesh::default();
    let outline = [
        (0.0, -0.03),
        (0.36, -0.03),
        (0.36, 0.03),
        (0.31, 0.035),
        (0.0, 0.035),
    ];
    revolve(&mut board, |_| "board", 36, &outline);
    for (x, y, size) in [
        (0.0, -0.03, [0.28, 0.2, 0.03]),
        (0.0, -0.17, [0.4, 0.035, 0.03]),
    ] {
        add_cuboid(&mut board, "coffee", DVec3::new(x, y, 0.04), size.into(), 1);
    }
    let handle = sample_curve(8, |part| {
        let angle = 1.4 - 2.8 * part;
        DVec3::new(
            0.15 + 0.07 * f64::cos(angle),
            -0.02 + 0.07 * f64::sin(angle),
            0.045,
        )
    });
    add_tube(&mut board, "coffee", 6, &handle, |_| 0.016);
    for steam in [-0.07, 0.0, 0.07] {
        let wisp = sample_curve(8, |part| {
            DVec3::new(
                steam + 0.02 * f64::sin(9.0 * part),
                0.1 + 0.16 * part,
                0.045,
            )
        });
        add_tube(&mut board, "coffee", 6, &wisp, |_| 0.01);
    }
    mesh.append(
        &board,
        DAffine3::from_translation(DVec3::new(0.75, 2.16, 0.7)),
    );
}

/// Adds a round table, two chairs, and a slate with the day's cake.
fn add_table(mesh: &mut Mesh) {
    let top = [(0.05, 0.72), (0.36, 0.72), (0.36, 0.75), (0.0, 0.75)];
    revolve_upright(mesh, "board", 28, &top, DVec3::ZERO);
    revolve_upright(
        mesh,
        "metal",
        10,
        &[(0.22, 0.0), (0.2, 0.03), (0.03, 0.05), (0.03, 0.72)],
        DVec3::ZERO,
    );
    add_ellipsoid(
        mesh,
        "awning_light",
        DVec3::new(0.12, 0.79, 0.1),
        DVec3::new(0.05, 0.04, 0.05),
        [12, 6],
    );
    for side in [-1.0, 1.0] {
        let at = |x: f64, y: f64, z: f64| DVec3::new(side * x, y, z);
        revolve_upright(
            mesh,
            "timber",
            18,
            &[(0.0, 0.43), (0.2, 0.43), (0.2, 0.47), (0.0, 0.47)],
            at(0.62, 0.0, 0.0),
        );
        for z in [-0.15, 0.15] {
            add_rod(mesh, "metal", [at(0.5, 0.0, z), at(0.52, 0.45, z)], 0.014);
            add_rod(mesh, "metal", [at(0.8, 0.0, z), at(0.8, 0.9, z)], 0.014);
        }
        add_rod(
            mesh,
            "timber",
            [at(0.8, 0.86, -0.17), at(0.8, 0.86, 0.17)],
            0.03,
        );
        add_rod(
            mesh,
            "timber",
            [at(0.8, 0.7, -0.17), at(0.8, 0.7, 0.17)],
            0.02,
        );
    }
    add_cuboid(
        mesh,
        "timber",
        DVec3::new(1.5, 0.42, -0.1),
        DVec3::new(0.5, 0.84, 0.05),
        1,
    );
    add_cuboid(
        mesh,
        "slate",
        DVec3::new(1.5, 0.46, -0.06),
        DVec3::new(0.42, 0.66, 0.04),
        1,
    );
    for line in 0..4 {
        let width = 0.3 - 0.05 * f64::from(line % 3);
        let y = 0.68 - 0.13 * f64::from(line);
        add_cuboid(
            mesh,
            "awning_light",
            DVec3::new(1.5, y, -0.035),
            DVec3::new(width, 0.03, 0.01),
            1,
        );
    }
}
