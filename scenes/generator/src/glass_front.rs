//! The glass front of a glasshouse: its bars, its panes with frosted stripes, and a sliding door.
//! The front stands at z = 0 and faces +Z.

use glam::DVec3;

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::{Mesh, Vertex};

/// Middles of the upright bars, in metres.
const UPRIGHTS: [f64; 5] = [-3.2, -1.6, 0.0, 1.6, 3.2];
/// Middles of the level bars.
const RAILS: [f64; 3] = [-1.5, 0.0, 1.5];
/// Width of a bar.
const BAR: f64 = 0.07;
/// Height and width of the door.
const DOOR: [f64; 2] = [1.1, 2.6];

/// Everything is unlit, so that a truth takes no light noise and little time.
const BARS: &str = "newmtl paint\nKd 0 0 0\nKe 0.62 0.64 0.6\n";
/// Clean glass of a greenish tint, and stripes that are etched into it or printed on it.
const GLASS: &str = "\
newmtl glass
Kd 0 0 0
Tf 0.9 0.97 0.92
Ni 1.5
d 0
illum 4
newmtl frost
Kd 0 0 0
Ke 0.75 0.8 0.78
d 0.6
newmtl print
Kd 0 0 0
Ke 0.7 0.12 0.06
d 0.7
";

pub(crate) fn files() -> Files {
    [
        model_files("bars", &bars(), BARS),
        model_files("panes", &panes(), GLASS),
        model_files("door", &door(), GLASS),
        model_files("door_frame", &door_frame(), BARS),
    ]
    .concat()
}

/// Adds an upright rectangle that faces +Z, from corner to corner.
fn add_sheet(mesh: &mut Mesh, material: &'static str, [from, to]: [[f64; 2]; 2], z: f64) {
    let corners = [
        [from[0], from[1]],
        [to[0], from[1]],
        [to[0], to[1]],
        [from[0], to[1]],
    ];
    let vertex = |[x, y]: [f64; 2]| Vertex {
        position: DVec3::new(x, y, z),
        normal: DVec3::Z,
        texcoord: glam::DVec2::ZERO,
    };
    mesh.add_polygon(material, &corners.map(vertex));
}

fn bars() -> Mesh {
    let mut mesh = Mesh::default();
    let [low, high] = [RAILS[0], RAILS[2]];
    for x in UPRIGHTS {
        let size = DVec3::new(BAR, high - low + BAR, BAR);
        add_cuboid(&mut mesh, "paint", DVec3::new(x, 0.0, 0.0), size, 1);
    }
    for y in RAILS {
        let size = DVec3::new(UPRIGHTS[4] - UPRIGHTS[0], BAR, BAR);
        add_cuboid(&mut mesh, "paint", DVec3::new(0.0, y, 0.0), size, 1);
    }
    mesh
}

/// Panes in all fields, with upright stripes of frost in the upper ones and a row of level ones
/// below.
fn panes() -> Mesh {
    let mut mesh = Mesh::default();
    for column in UPRIGHTS.windows(2) {
        for row in RAILS.windows(2) {
            let corners = [[column[0], row[0]], [column[1], row[1]]];
            add_sheet(&mut mesh, "glass", corners, 0.0);
        }
        for stripe in 0..5 {
            let x = column[0] + 0.25 + 0.25 * f64::from(stripe);
            add_sheet(&mut mesh, "frost", [[x, 0.3], [x + 0.1, 1.2]], 0.004);
        }
        for stripe in 0..3 {
            let y = -1.2 + 0.35 * f64::from(stripe);
            let corners = [[column[0] + 0.2, y], [column[1] - 0.2, y + 0.1]];
            add_sheet(&mut mesh, "frost", corners, 0.004);
        }
    }
    mesh
}

/// The glass of the door around the origin, with printed bars.
fn door() -> Mesh {
    let mut mesh = Mesh::default();
    let [x, y] = DOOR.map(|side| 0.5 * side);
    add_sheet(&mut mesh, "glass", [[-x, -y], [x, y]], 0.0);
    for bar in 0..4 {
        let left = -0.42 + 0.23 * f64::from(bar);
        add_sheet(
            &mut mesh,
            "print",
            [[left, -0.9], [left + 0.13, 0.9]],
            0.004,
        );
    }
    mesh
}

fn door_frame() -> Mesh {
    let mut mesh = Mesh::default();
    let [width, height] = DOOR;
    for side in [-0.5, 0.5] {
        let upright = DVec3::new(BAR, height + BAR, BAR);
        add_cuboid(
            &mut mesh,
            "paint",
            DVec3::new(side * width, 0.0, 0.0),
            upright,
            1,
        );
        let level = DVec3::new(width, BAR, BAR);
        add_cuboid(
            &mut mesh,
            "paint",
            DVec3::new(0.0, side * height, 0.0),
            level,
            1,
        );
    }
    mesh
}
