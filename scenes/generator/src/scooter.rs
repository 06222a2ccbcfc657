//! A parked motor scooter that faces +X, on the ground y = 0, its middle at z = 0.

use glam::{DAffine3, DVec3};

use crate::ellipsoid::add_ellipsoid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::{add_ring, revolve};
use crate::tube::{add_rod, add_tube};

const MATERIALS: &str = "\
newmtl paint
Kd 0.35 0.65 0.62
newmtl seat
Kd 0.3 0.15 0.08
newmtl tyre
Kd 0.05 0.05 0.05
newmtl rim
Kd 0.75 0.75 0.75
newmtl chrome
Kd 0.6 0.6 0.62
newmtl lamp
Kd 0.9 0.9 0.8
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    for x in [-0.55, 0.62] {
        let mut wheel = Mesh::default();
        add_ring(&mut wheel, "tyre", [0.17, 0.05], 0.0, [28, 8]);
        revolve(
            &mut wheel,
            |_| "rim",
            20,
            &[(0.0, -0.03), (0.14, -0.02), (0.14, 0.02), (0.0, 0.03)],
        );
        mesh.append(&wheel, DAffine3::from_translation(DVec3::new(x, 0.22, 0.0)));
    }
    let mut blob = |material, at: [f64; 3], radii: [f64; 3]| {
        add_ellipsoid(&mut mesh, material, at.into(), radii.into(), [18, 10]);
    };
    blob("paint", [-0.5, 0.46, 0.0], [0.36, 0.22, 0.19]);
    blob("paint", [0.62, 0.36, 0.0], [0.25, 0.11, 0.09]);
    blob("paint", [0.02, 0.25, 0.0], [0.42, 0.05, 0.16]);
    blob("seat", [-0.42, 0.71, 0.0], [0.36, 0.07, 0.13]);
    blob("lamp", [0.5, 1.0, 0.0], [0.07, 0.08, 0.08]);
    blob("lamp", [-0.86, 0.5, 0.0], [0.03, 0.05, 0.06]);
    let shield = [
        DVec3::new(0.3, 0.24, 0.0),
        DVec3::new(0.4, 0.45, 0.0),
        DVec3::new(0.42, 0.75, 0.0),
        DVec3::new(0.4, 0.98, 0.0),
    ];
    // Three tubes side by side make it wider than deep.
    for z in [-0.1, 0.0, 0.1] {
        let path = shield.map(|point| point + z * DVec3::Z);
        add_tube(&mut mesh, "paint", 8, &path, |_| 0.065);
    }
    add_rod(
        &mut mesh,
        "chrome",
        [DVec3::new(0.62, 0.22, 0.08), DVec3::new(0.44, 0.95, 0.04)],
        0.025,
    );
    add_rod(
        &mut mesh,
        "chrome",
        [DVec3::new(0.4, 1.02, -0.3), DVec3::new(0.4, 1.02, 0.3)],
        0.018,
    );
    for side in [-1.0, 1.0] {
        let at = |x: f64, y: f64| DVec3::new(x, y, 0.27 * side);
        add_rod(&mut mesh, "tyre", [at(0.4, 1.02), at(0.34, 1.02)], 0.028);
        add_rod(&mut mesh, "chrome", [at(0.4, 1.02), at(0.44, 1.2)], 0.008);
        add_ellipsoid(
            &mut mesh,
            "chrome",
            at(0.44, 1.22),
            DVec3::new(0.02, 0.05, 0.06),
            [10, 8],
        );
    }
    add_rod(
        &mut mesh,
        "chrome",
        [DVec3::new(-0.1, 0.25, 0.1), DVec3::new(-0.2, 0.0, 0.2)],
        0.014,
    );
    model_files("scooter", &mesh, MATERIALS)
}
