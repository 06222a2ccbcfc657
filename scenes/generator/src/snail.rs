//! A snail that heads for +X, its sole at y = 0.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::tube::{add_tube, sample_curve};

const MATERIALS: &str = "\
newmtl body
Kd 0.6 0.46 0.3
newmtl shell
Kd 0.78 0.5 0.22
newmtl band
Kd 0.3 0.14 0.07
newmtl eye
Kd 0.04 0.03 0.03
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    let back = sample_curve(14, |part| {
        let neck = ((part - 0.75) / 0.25).max(0.0);
        DVec3::new(1.0 * part - 0.55, 0.06 + 0.2 * neck * neck, 0.0)
    });
    // Pointed at the tail, round at the head.
    add_tube(&mut mesh, "body", 12, &back, |part| {
        0.09 * (part / 0.3).min(1.0) * ((1.0 - part) / 0.08).clamp(0.0, 1.0).sqrt()
    });
    for side in [-1.0, 1.0] {
        let stalk = sample_curve(4, |part| {
            DVec3::new(
                0.42 + 0.1 * part,
                0.28 + 0.2 * part,
                side * (0.03 + 0.06 * part),
            )
        });
        add_tube(&mut mesh, "body", 6, &stalk, |_| 0.016);
        let eye = DVec3::new(0.52, 0.49, side * 0.09);
        add_ellipsoid(&mut mesh, "eye", eye, DVec3::splat(0.028), [8, 6]);
        let feeler = [
            DVec3::new(0.45, 0.2, side * 0.03),
            DVec3::new(0.56, 0.16, side * 0.06),
        ];
        add_tube(&mut mesh, "body", 6, &feeler, |_| 0.012);
    }
    add_shell(&mut mesh);
    model_files("snail", &mesh, MATERIALS)
}

/// Adds a spiral in the plane of the body, with a dark line along its outside.
fn add_shell(mesh: &mut Mesh) {
    let shrink = |part: f64| 0.12f64.powf(part);
    let turns = 2.3;
    let spiral = |lift: f64| {
        move |part: f64| {
            let (sine, cosine) = (-0.6 - turns * TAU * part).sin_cos();
            let reach = (0.2 + lift) * shrink(part);
            DVec3::new(-0.08 + reach * cosine, 0.36 + reach * sine, 0.06 * part)
        }
    };
    for side in [-1.0, 1.0] {
        let fold = |lift| {
            sample_curve(48, move |part| {
                spiral(lift)(part) * DVec3::new(1.0, 1.0, side)
            })
        };
        add_tube(mesh, "shell", 12, &fold(0.0), move |part| {
            0.125 * shrink(part)
        });
        add_tube(mesh, "band", 6, &fold(0.095), move |part| {
            0.045 * shrink(part)
        });
    }
}
