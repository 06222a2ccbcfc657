//! The overhead line of a railway along the X axis: masts, posts and wires from 2 to 16 cm thick.

use glam::DVec3;

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::tube::{add_rod, add_tube, sample_curve};

/// Distance from mast to mast in metres, and the number of masts on either side of the middle one.
const SPAN: f64 = 6.0;
const MASTS: i32 = 2;

/// Heights above the ground, in metres.
const CONTACT_WIRE: f64 = 4.6;
const SUPPORT: f64 = 5.9;

const MATERIALS: &str = "\
newmtl steel
Kd 0.16 0.2 0.19
newmtl wire
Kd 0.1 0.07 0.05
newmtl insulator
Kd 0.45 0.2 0.12
newmtl wood
Kd 0.3 0.22 0.15
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    for index in -MASTS..=MASTS {
        let x = SPAN * f64::from(index);
        add_mast(&mut mesh, x);
        if index < MASTS {
            add_wires(&mut mesh, x);
            // Posts of a fence beside the line, each thinner than the one before.
            for (post, width) in [(1.5, 0.08), (3.0, 0.04), (4.5, 0.02)] {
                let size = DVec3::new(width, 2.6, width);
                add_cuboid(&mut mesh, "wood", DVec3::new(x + post, 1.3, 0.3), size, 1);
            }
        }
    }
    model_files("overhead_line", &mesh, MATERIALS)
}

fn add_mast(mesh: &mut Mesh, x: f64) {
    let at = |dx: f64, y: f64, z: f64| DVec3::new(x + dx, y, z);
    add_cuboid(
        mesh,
        "steel",
        at(0.0, 3.3, -0.2),
        DVec3::new(0.16, 6.6, 0.16),
        1,
    );
    // Arm that holds the wires, its strut, and a stay against their pull.
    add_rod(
        mesh,
        "steel",
        [at(0.0, SUPPORT + 0.3, -0.1), at(0.0, SUPPORT, 0.1)],
        0.03,
    );
    add_rod(
        mesh,
        "steel",
        [at(0.0, 5.0, -0.1), at(0.7, SUPPORT, 0.0)],
        0.03,
    );
    add_rod(
        mesh,
        "steel",
        [at(0.0, SUPPORT + 0.3, -0.1), at(0.7, SUPPORT, 0.0)],
        0.02,
    );
    add_rod(
        mesh,
        "wire",
        [at(0.0, 6.4, -0.2), at(-2.4, 0.0, -0.2)],
        0.02,
    );
    for y in [5.1, SUPPORT + 0.25] {
        add_rod(
            mesh,
            "insulator",
            [at(0.08, y, -0.1), at(0.25, y + 0.1, -0.05)],
            0.06,
        );
    }
}

/// Adds a sagging wire, droppers from it, and the straight wire that they hold.
fn add_wires(mesh: &mut Mesh, x: f64) {
    let support = |part: f64| {
        let sag = 0.8 * 4.0 * part * (1.0 - part);
        DVec3::new(x + SPAN * part, SUPPORT - sag, 0.0)
    };
    add_tube(mesh, "wire", 6, &sample_curve(16, support), |_| 0.015);
    let contact = |part: f64| DVec3::new(x + SPAN * part, CONTACT_WIRE, 0.0);
    add_rod(mesh, "wire", [contact(0.0), contact(1.0)], 0.02);
    for dropper in 0..6 {
        let part = (f64::from(dropper) + 0.5) / 6.0;
        add_rod(mesh, "wire", [support(part), contact(part)], 0.01);
    }
}
