//! An airliner that flies towards +X, its middle at the origin.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DAffine3, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::revolve;

/// Length and radius of the hull, in metres.
const LENGTH: f64 = 16.0;
const RADIUS: f64 = 1.0;

const MATERIALS: &str = "\
newmtl hull
Kd 0.8 0.8 0.82
newmtl fin
Kd 0.1 0.2 0.6
newmtl engine
Kd 0.3 0.3 0.32
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    mesh.add_surface(
        [20, 32],
        |_, _| "hull",
        |u, v| {
            let (sine, cosine) = (u * TAU).sin_cos();
            let radius = RADIUS * fullness(v);
            // The tail rises, as that of an aeroplane does to clear the runway.
            let lift = 0.7 * (0.3 - v).max(0.0) / 0.3;
            DVec3::new(LENGTH * (v - 0.5), radius * cosine + lift, radius * sine)
        },
    );
    for side in [1.0, -1.0] {
        add_wing(
            &mut mesh,
            "hull",
            side,
            DVec3::new(1.0, -0.4, 0.0),
            8.5,
            [3.0, 1.0],
        );
        add_wing(
            &mut mesh,
            "hull",
            side,
            DVec3::new(-6.8, 0.9, 0.0),
            3.0,
            [1.6, 0.7],
        );
        let mut engine = Mesh::default();
        let outline = [
            (0.0, -1.1),
            (0.45, -1.1),
            (0.55, 0.0),
            (0.5, 1.1),
            (0.0, 1.1),
        ];
        revolve(&mut engine, |_| "engine", 16, &outline);
        let place = DAffine3::from_translation(DVec3::new(0.9, -1.1, side * 3.0));
        mesh.append(&engine, place * DAffine3::from_rotation_y(FRAC_PI_2));
    }
    add_cuboid(
        &mut mesh,
        "fin",
        DVec3::new(-6.9, 2.1, 0.0),
        DVec3::new(1.7, 2.6, 0.15),
        1,
    );
    model_files("aeroplane", &mesh, MATERIALS)
}

/// Relative radius of the hull at `v`, from 0 at the tail to 1 at the nose.
fn fullness(v: f64) -> f64 {
    let tail = (v / 0.35).clamp(0.0, 1.0).powf(0.7);
    let nose = (1.0 - ((v - 0.85) / 0.15).clamp(0.0, 1.0).powi(2)).sqrt();
    tail * nose
}

/// Adds a swept wing of lens-shaped sections from `root` outwards; chords at root and tip in
/// metres.
fn add_wing(
    mesh: &mut Mesh,
    material: &'static str,
    side: f64,
    root: DVec3,
    span: f64,
    [root_chord, tip_chord]: [f64; 2],
) {
    mesh.add_surface(
        [12, 6],
        |_, _| material,
        |u, v| {
            let (rise, along) = (side * u * TAU).sin_cos();
            let chord = root_chord + v * (tip_chord - root_chord);
            let swept = -0.45 * span * v;
            root + DVec3::new(
                swept + chord / 2.0 * along,
                0.05 * chord * rise,
                side * span * v,
            )
        },
    );
}
