//! A motorbike with its rider that heads for +X, on the ground y = 0, its middle at z = 0.

use glam::{DAffine3, DVec3};

use crate::cuboid::add_cuboid;
use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::add_ring;
use crate::tube::{add_rod, add_tube};

const MATERIALS: &str = "\
newmtl paint
Kd 0.8 0.1 0.06
newmtl tyre
Kd 0.04 0.04 0.04
newmtl chrome
Kd 0.6 0.6 0.62
newmtl leather
Kd 0.1 0.1 0.14
newmtl helmet
Kd 0.95 0.85 0.1
newmtl visor
Kd 0.03 0.03 0.04
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    for x in [-0.68, 0.72] {
        let mut wheel = Mesh::default();
        add_ring(&mut wheel, "tyre", [0.26, 0.07], 0.0, [24, 8]);
        add_ring(&mut wheel, "chrome", [0.19, 0.02], 0.0, [24, 6]);
        mesh.append(&wheel, DAffine3::from_translation(DVec3::new(x, 0.33, 0.0)));
    }
    add_body(&mut mesh);
    add_rider(&mut mesh);
    model_files("motorbike", &mesh, MATERIALS)
}

fn add_body(mesh: &mut Mesh) {
    let mut blob = |material, at: [f64; 3], radii: [f64; 3]| {
        add_ellipsoid(mesh, material, at.into(), radii.into(), [14, 8]);
    };
    blob("paint", [0.22, 0.82, 0.0], [0.34, 0.17, 0.17]);
    blob("paint", [0.62, 0.85, 0.0], [0.2, 0.2, 0.14]);
    blob("leather", [-0.3, 0.8, 0.0], [0.42, 0.09, 0.15]);
    blob("paint", [-0.72, 0.86, 0.0], [0.2, 0.08, 0.1]);
    blob("chrome", [0.05, 0.45, 0.0], [0.32, 0.2, 0.18]);
    for side in [-1.0, 1.0] {
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z * side);
        add_rod(
            mesh,
            "chrome",
            [at(0.72, 0.33, 0.1), at(0.5, 1.0, 0.12)],
            0.03,
        );
        add_rod(
            mesh,
            "tyre",
            [at(0.45, 1.02, 0.08), at(0.38, 1.02, 0.38)],
            0.025,
        );
        add_rod(
            mesh,
            "chrome",
            [at(0.0, 0.35, 0.18), at(-0.8, 0.4, 0.2)],
            0.05,
        );
    }
    add_cuboid(
        mesh,
        "tyre",
        DVec3::new(-0.9, 0.75, 0.0),
        DVec3::new(0.06, 0.14, 0.18),
        1,
    );
}

fn add_rider(mesh: &mut Mesh) {
    let spine = [
        DVec3::new(-0.35, 0.85, 0.0),
        DVec3::new(-0.1, 1.2, 0.0),
        DVec3::new(0.1, 1.4, 0.0),
    ];
    add_tube(mesh, "leather", 12, &spine, |v| {
        0.17 + 0.05 * (3.0 * v).sin()
    });
    add_ellipsoid(
        mesh,
        "leather",
        DVec3::new(-0.02, 1.32, 0.0),
        DVec3::new(0.16, 0.14, 0.27),
        [14, 8],
    );
    add_ellipsoid(
        mesh,
        "helmet",
        DVec3::new(0.2, 1.55, 0.0),
        DVec3::new(0.17, 0.16, 0.14),
        [16, 10],
    );
    add_ellipsoid(
        mesh,
        "visor",
        DVec3::new(0.28, 1.54, 0.0),
        DVec3::new(0.1, 0.06, 0.12),
        [12, 6],
    );
    for side in [-1.0, 1.0] {
        let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z * side);
        let arm = [
            at(0.0, 1.35, 0.24),
            at(0.12, 1.08, 0.36),
            at(0.4, 1.03, 0.33),
        ];
        add_tube(mesh, "leather", 8, &arm, |_| 0.06);
        let leg = [
            at(-0.35, 0.85, 0.14),
            at(0.12, 0.75, 0.25),
            at(-0.15, 0.38, 0.22),
        ];
        add_tube(mesh, "leather", 8, &leg, |v| 0.1 - 0.03 * v);
    }
}
