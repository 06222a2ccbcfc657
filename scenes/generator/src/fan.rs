//! A fan of five twisted blades, and its stand.

use std::f64::consts::TAU;

use glam::{DAffine3, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::{add_ring, revolve};

const BLADES: u32 = 5;

/// Radii at which blades begin and end, in metres from the Z axis.
const SPAN: [f64; 2] = [0.2, 1.25];

const FAN_MATERIALS: &str = "\
newmtl blade
Kd 0.55 0.72 0.85
newmtl marked
Kd 0.9 0.4 0.08
newmtl hub
Kd 0.12 0.13 0.15
";

const STAND_MATERIALS: &str = "\
newmtl motor
Kd 0.2 0.22 0.25
newmtl guard
Kd 0.85 0.85 0.85
";

pub(crate) fn files() -> Files {
    [
        model_files("fan", &fan(), FAN_MATERIALS),
        model_files("stand", &stand(), STAND_MATERIALS),
    ]
    .concat()
}

fn fan() -> Mesh {
    let mut mesh = Mesh::default();
    for index in 0..BLADES {
        // One blade differs: without it the fan looks the same after each fifth of a turn.
        let material = if index == 0 { "marked" } else { "blade" };
        let angle = TAU * f64::from(index) / f64::from(BLADES);
        mesh.append(&blade(material), DAffine3::from_rotation_z(angle));
    }
    let outline = [
        (0.0, -0.14),
        (0.24, -0.14),
        (0.24, 0.1),
        (0.17, 0.18),
        (0.0, 0.21),
    ];
    revolve(&mut mesh, |_| "hub", 32, &outline);
    mesh
}

/// Blade along +X of elliptic sections, less twisted towards its rounded tip.
fn blade(material: &'static str) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.add_surface(
        [20, 20],
        |_, _| material,
        |u, v| {
            let rounded = (1.0 - ((v - 0.85) / 0.15).clamp(0.0, 1.0).powi(2)).sqrt();
            let half_chord = (0.15 + 0.13 * (v * TAU / 2.0).sin()) * rounded;
            let half_thickness = 0.02 * rounded;
            let twist = (42.0 - 24.0 * v).to_radians();
            let (rise, along) = (u * TAU).sin_cos();
            let (across, up) = (half_chord * along, half_thickness * rise);
            DVec3::new(
                SPAN[0] + v * (SPAN[1] - SPAN[0]),
                across * twist.cos() - up * twist.sin(),
                across * twist.sin() + up * twist.cos(),
            )
        },
    );
    mesh
}

fn stand() -> Mesh {
    let mut mesh = Mesh::default();
    let outline = [(0.0, -0.6), (0.2, -0.6), (0.22, -0.2), (0.0, -0.2)];
    revolve(&mut mesh, |_| "motor", 32, &outline);
    add_cuboid(
        &mut mesh,
        "motor",
        DVec3::new(0.0, -1.25, -0.4),
        DVec3::new(0.14, 2.5, 0.14),
        2,
    );
    add_ring(&mut mesh, "guard", [1.4, 0.03], 0.0, [96, 10]);
    mesh
}
