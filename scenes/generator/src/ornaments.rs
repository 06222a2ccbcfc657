//! Small ornaments on strings, in the plane z = 0: balls, stars, moons and bells.

use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DVec2, DVec3};

use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::prism::{add_face, add_prism, star_outline};
use crate::revolution::revolve_upright;
use crate::tube::add_rod;

/// Positions of the ornaments from left to right, in metres.
const PLACES: [(f64, f64); 9] = [
    (-2.4, 0.3),
    (-1.85, -0.55),
    (-1.25, 0.1),
    (-0.6, -0.75),
    (0.0, 0.35),
    (0.55, -0.35),
    (1.15, 0.2),
    (1.75, -0.65),
    (2.35, 0.0),
];

const MATERIALS: &str = "\
newmtl red
Kd 0.75 0.05 0.05
newmtl blue
Kd 0.06 0.2 0.6
newmtl gold
Kd 0.95 0.7 0.15
newmtl silver
Kd 0.85 0.86 0.9
newmtl string
Kd 0.12 0.1 0.08
";

pub(crate) fn files() -> Files {
    let mut ornaments = Mesh::default();
    let mut strings = Mesh::default();
    for (index, (x, y)) in PLACES.into_iter().enumerate() {
        let place = DVec3::new(x, y, 0.0);
        let ornament = match index % 4 {
            0 => ball(if index == 4 { "blue" } else { "red" }),
            1 => flat(&star_outline(5, 0.07, 0.17)),
            2 => bell(),
            _ => moon(),
        };
        ornaments.append(&ornament, DAffine3::from_translation(place));
        let hook = place + 0.15 * DVec3::Y;
        add_rod(
            &mut strings,
            "string",
            [hook, DVec3::new(x, 4.5, 0.0)],
            0.008,
        );
    }
    let mut files = model_files("ornaments", &ornaments, MATERIALS);
    files.extend(model_files("strings", &strings, MATERIALS));
    files
}

fn ball(material: &'static str) -> Mesh {
    let mut mesh = Mesh::default();
    add_ellipsoid(
        &mut mesh,
        material,
        DVec3::ZERO,
        DVec3::splat(0.14),
        [24, 14],
    );
    revolve_upright(
        &mut mesh,
        "silver",
        12,
        &[(0.03, 0.13), (0.03, 0.17), (0.0, 0.17)],
        DVec3::ZERO,
    );
    mesh
}

fn flat(outline: &[DVec2]) -> Mesh {
    let mut mesh = Mesh::default();
    add_prism(&mut mesh, "gold", outline, [-0.02, 0.02]);
    mesh
}

fn bell() -> Mesh {
    let mut mesh = Mesh::default();
    let outline = [
        (0.0, -0.11),
        (0.15, -0.13),
        (0.11, -0.03),
        (0.09, 0.08),
        (0.03, 0.14),
        (0.0, 0.15),
    ];
    revolve_upright(&mut mesh, "gold", 20, &outline, DVec3::ZERO);
    add_ellipsoid(
        &mut mesh,
        "silver",
        DVec3::new(0.0, -0.14, 0.0),
        DVec3::splat(0.035),
        [10, 6],
    );
    mesh
}

/// Crescent: an outer circle without an inner one to its right.
fn moon() -> Mesh {
    let mut mesh = Mesh::default();
    let point = |part: f64, inner: bool| {
        let angle = TAU * (0.18 + 0.64 * part);
        let outer = 0.16 * DVec2::from_angle(angle);
        let thick = 0.004 + 0.106 * (PI * part).sin();
        if inner {
            outer * (1.0 - thick / 0.16)
        } else {
            outer
        }
    };
    for piece in 0..18 {
        let parts = [f64::from(piece) / 18.0, f64::from(piece + 1) / 18.0];
        let outline = [
            point(parts[0], true),
            point(parts[0], false),
            point(parts[1], false),
            point(parts[1], true),
        ];
        for (z, order) in [(0.02, [0, 1, 2, 3]), (-0.02, [3, 2, 1, 0])] {
            add_face(
                &mut mesh,
                "silver",
                &order.map(|corner: usize| outline[corner].extend(z)),
            );
        }
    }
    mesh
}
