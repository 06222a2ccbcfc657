//! A leafy bush about 1.6 m high that stands on y = 0, and a smooth body of the same outline.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::noise::noise;
use crate::prism::add_face;
use crate::tube::{add_tube, sample_curve};

/// Centre and radii of the crown, in metres.
const MIDDLE: DVec3 = DVec3::new(0.0, 0.95, 0.0);
const RADII: DVec3 = DVec3::new(0.95, 0.75, 0.8);

const MATERIALS: &str = "\
newmtl leaf
Kd 0.14 0.32 0.07
newmtl leaf_light
Kd 0.3 0.5 0.14
newmtl leaf_dark
Kd 0.07 0.19 0.06
newmtl bark
Kd 0.2 0.14 0.09
";

/// Bush with a number of leaves.
pub(crate) fn files(leaves: u32) -> Files {
    let mut mesh = Mesh::default();
    for leaf in 0..leaves {
        add_leaf(&mut mesh, leaf);
    }
    for branch in 0..7 {
        let random = |seed: u32| noise(branch, 300 + seed) - 0.5;
        let end = MIDDLE + RADII * DVec3::new(1.3 * random(1), 0.5 + random(2), 1.3 * random(3));
        let bend = DVec3::new(0.3 * random(4), 0.5, 0.3 * random(5));
        let path = sample_curve(5, |part| {
            let bent = (0.12 * end).lerp(bend.lerp(end, part), part);
            bent * DVec3::new(1.0, part, 1.0)
        });
        add_tube(&mut mesh, "bark", 6, &path, |part| {
            0.035 * (1.0 - 0.8 * part)
        });
    }
    model_files("bush", &mesh, MATERIALS)
}

/// Bush without gaps between its leaves: one closed body.
pub(crate) fn smooth() -> Files {
    let mut mesh = Mesh::default();
    add_ellipsoid(&mut mesh, "leaf", MIDDLE, RADII, [40, 20]);
    model_files("smooth_bush", &mesh, MATERIALS)
}

/// Adds a folded leaf near the outside of the crown, which points outwards and down.
fn add_leaf(mesh: &mut Mesh, leaf: u32) {
    let random = |seed: u32| noise(leaf, seed);
    let (height, around) = (2.0 * random(1) - 1.0, TAU * random(2));
    let ring = (1.0 - height * height).sqrt();
    let out = DVec3::new(ring * around.cos(), height, ring * around.sin());
    // Lumps keep the outline from being a ball's.
    let lump = 0.86 + 0.16 * (5.0 * out.x + 1.0).sin() * (4.0 * out.y + 2.0 * out.z).cos();
    let foot = MIDDLE + RADII * out * lump * (0.55 + 0.45 * random(3).sqrt());
    let turn = |seed: u32| random(seed) - 0.5;
    let along = (out + DVec3::new(turn(4), turn(5) - 0.35, turn(6))).normalize();
    let across = along
        .cross(DVec3::new(turn(7), 0.6, turn(8)))
        .normalize_or(DVec3::X);
    let length = 0.12 + 0.09 * random(9);
    let half = 0.3 * length * across;
    let fold = 0.12 * length * along.cross(across);
    let material = ["leaf", "leaf_light", "leaf", "leaf_dark"][(4.0 * random(10)) as usize];
    let [middle, tip] = [foot + 0.45 * length * along, foot + length * along];
    add_face(mesh, material, &[foot, middle - half + fold, tip]);
    add_face(mesh, material, &[foot, tip, middle + half + fold]);
}
