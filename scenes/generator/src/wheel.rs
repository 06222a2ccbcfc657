//! The wheel of a car, whose rim shows that it turns.

use glam::{DAffine3, DVec3};

use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::revolution::revolve;

/// Radius about the axle, the Z axis, in metres.
pub(crate) const RADIUS: f64 = 0.32;

const HALF_WIDTH: f64 = 0.11;

const MATERIALS: &str = "\
newmtl tyre
Kd 0.03 0.03 0.03
newmtl rim
Kd 0.75 0.75 0.78
newmtl gap
Kd 0.05 0.05 0.05
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    let tread = [
        (0.22, -HALF_WIDTH),
        (RADIUS - 0.02, -HALF_WIDTH),
        (RADIUS, -HALF_WIDTH + 0.02),
        (RADIUS, HALF_WIDTH - 0.02),
        (RADIUS - 0.02, HALF_WIDTH),
        (0.22, HALF_WIDTH),
    ];
    revolve(&mut mesh, |_| "tyre", 40, &tread);
    let mut rim = Mesh::default();
    let face = [(0.22, HALF_WIDTH - 0.02), (0.05, HALF_WIDTH - 0.02)];
    let spokes = |column: usize| if column % 8 < 4 { "rim" } else { "gap" };
    revolve(&mut rim, spokes, 40, &face);
    revolve(
        &mut rim,
        |_| "rim",
        40,
        &[(0.05, HALF_WIDTH - 0.02), (0.0, HALF_WIDTH)],
    );
    mesh.append(&rim, DAffine3::IDENTITY);
    let half_turn = DAffine3::from_axis_angle(DVec3::Y, std::f64::consts::PI);
    mesh.append(&rim, half_turn);
    model_files("wheel", &mesh, MATERIALS)
}
