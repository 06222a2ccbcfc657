//! The parts of a jointed mannequin that heads for +X, each with its joint at the origin.

use glam::DVec3;

use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::tube::add_tube;

const MATERIALS: &str = "\
newmtl skin
Kd 0.72 0.5 0.36
newmtl shirt
Kd 0.85 0.5 0.1
newmtl trousers
Kd 0.12 0.16 0.3
newmtl shoe
Kd 0.3 0.08 0.05
newmtl hair
Kd 0.12 0.07 0.04
newmtl eye
Kd 0.05 0.05 0.06
";

/// Lengths of limbs, in metres.
const UPPER_ARM: f64 = 0.3;
const FOREARM: f64 = 0.27;
const THIGH: f64 = 0.44;
const SHIN: f64 = 0.43;

pub(crate) fn files() -> Files {
    [
        ("torso", torso()),
        ("head", head()),
        ("upper_arm", limb("shirt", UPPER_ARM, [0.062, 0.05])),
        ("forearm", forearm()),
        ("thigh", limb("trousers", THIGH, [0.095, 0.07])),
        ("shin", shin()),
    ]
    .into_iter()
    .flat_map(|(name, mesh)| model_files(name, &mesh, MATERIALS))
    .collect()
}

/// Torso from the hips, the origin, up to the neck.
fn torso() -> Mesh {
    let mut mesh = Mesh::default();
    add_ellipsoid(
        &mut mesh,
        "trousers",
        DVec3::new(0.0, 0.04, 0.0),
        DVec3::new(0.13, 0.12, 0.17),
        [20, 12],
    );
    add_ellipsoid(
        &mut mesh,
        "shirt",
        DVec3::new(0.0, 0.22, 0.0),
        DVec3::new(0.115, 0.2, 0.155),
        [20, 12],
    );
    add_ellipsoid(
        &mut mesh,
        "shirt",
        DVec3::new(0.01, 0.42, 0.0),
        DVec3::new(0.135, 0.17, 0.2),
        [20, 12],
    );
    add_tube(
        &mut mesh,
        "skin",
        10,
        &[DVec3::new(0.0, 0.54, 0.0), DVec3::new(0.01, 0.64, 0.0)],
        |_| 0.05,
    );
    mesh
}

/// Head above the neck, the origin.
fn head() -> Mesh {
    let mut mesh = Mesh::default();
    add_ellipsoid(
        &mut mesh,
        "skin",
        DVec3::new(0.02, 0.13, 0.0),
        DVec3::new(0.1, 0.13, 0.08),
        [20, 14],
    );
    add_ellipsoid(
        &mut mesh,
        "hair",
        DVec3::new(-0.015, 0.165, 0.0),
        DVec3::new(0.105, 0.115, 0.09),
        [20, 12],
    );
    add_ellipsoid(
        &mut mesh,
        "skin",
        DVec3::new(0.125, 0.12, 0.0),
        DVec3::new(0.022, 0.025, 0.016),
        [8, 6],
    );
    for side in [-1.0, 1.0] {
        add_ellipsoid(
            &mut mesh,
            "eye",
            DVec3::new(0.1, 0.15, 0.035 * side),
            DVec3::splat(0.013),
            [8, 6],
        );
        add_ellipsoid(
            &mut mesh,
            "skin",
            DVec3::new(0.0, 0.13, 0.085 * side),
            DVec3::new(0.02, 0.032, 0.012),
            [8, 6],
        );
    }
    mesh
}

/// Limb from the joint downwards, rounded, with a thickness at either end.
fn limb(material: &'static str, length: f64, thickness: [f64; 2]) -> Mesh {
    let mut mesh = Mesh::default();
    let ends = [DVec3::ZERO, DVec3::new(0.0, -length, 0.0)];
    let middle = ends[0].lerp(ends[1], 0.5);
    add_tube(
        &mut mesh,
        material,
        14,
        &[ends[0], middle, ends[1]],
        |part| thickness[0] + part * (thickness[1] - thickness[0]),
    );
    for (end, radius) in ends.into_iter().zip(thickness) {
        add_ellipsoid(&mut mesh, material, end, DVec3::splat(radius), [14, 8]);
    }
    mesh
}

fn forearm() -> Mesh {
    let mut mesh = limb("skin", FOREARM, [0.048, 0.035]);
    add_ellipsoid(
        &mut mesh,
        "shirt",
        DVec3::ZERO,
        DVec3::splat(0.055),
        [12, 8],
    );
    let hand = DVec3::new(0.01, -FOREARM - 0.07, 0.0);
    add_ellipsoid(
        &mut mesh,
        "skin",
        hand,
        DVec3::new(0.045, 0.085, 0.028),
        [12, 8],
    );
    mesh
}

/// Shin with its foot, whose sole is 0.08 m below the ankle.
fn shin() -> Mesh {
    let mut mesh = limb("trousers", SHIN, [0.068, 0.055]);
    let ankle = DVec3::new(0.0, -SHIN, 0.0);
    add_ellipsoid(
        &mut mesh,
        "shoe",
        ankle + DVec3::new(0.065, -0.035, 0.0),
        DVec3::new(0.135, 0.045, 0.05),
        [16, 8],
    );
    add_ellipsoid(
        &mut mesh,
        "shoe",
        ankle,
        DVec3::new(0.065, 0.08, 0.055),
        [12, 8],
    );
    mesh
}
