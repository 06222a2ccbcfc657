//! A neon sign that says BAR beside a glass, on a dark board in the plane z = 0.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DVec2, DVec3};

use crate::cuboid::add_cuboid;
use crate::files::{Files, model_files};
use crate::mesh::Mesh;
use crate::tube::{add_tube, sample_curve};

/// Radius of the tubes, in metres.
const RADIUS: f64 = 0.022;

/// Height of a letter, in metres.
const HEIGHT: f64 = 0.7;

const MATERIALS: &str = "\
# The tubes emit 100 times what the wall beside them gives back.
newmtl pink
Kd 0 0 0
Ke 4 0.8 1.8
newmtl cyan
Kd 0 0 0
Ke 0.6 3.4 4
newmtl board
Kd 0.03 0.03 0.035
newmtl bracket
Kd 0.2 0.2 0.22
";

pub(crate) fn files() -> Files {
    let mut mesh = Mesh::default();
    add_cuboid(
        &mut mesh,
        "board",
        DVec3::new(0.0, 0.0, -0.1),
        DVec3::new(2.9, 1.2, 0.06),
        1,
    );
    for x in [-1.2, 1.2] {
        add_cuboid(
            &mut mesh,
            "bracket",
            DVec3::new(x, 0.0, -0.2),
            DVec3::new(0.1, 0.1, 0.2),
            1,
        );
    }
    let mut line = |material, path: Vec<DVec2>| {
        let path: Vec<DVec3> = path.into_iter().map(|point| point.extend(0.0)).collect();
        add_tube(&mut mesh, material, 8, &path, |_| RADIUS);
    };
    // Letters begin at (x, -0.35).
    let at = |x: f64, y: f64| DVec2::new(x, y - 0.5 * HEIGHT);
    for x in [-1.2, 0.2] {
        line("pink", vec![at(x, 0.0), at(x, 0.5 * HEIGHT), at(x, HEIGHT)]);
    }
    line("pink", bow([-1.2, 0.0], 0.53 * HEIGHT));
    line("pink", bow([-1.2, 0.53 * HEIGHT], 0.47 * HEIGHT));
    line(
        "pink",
        vec![at(-0.65, 0.0), at(-0.4, HEIGHT), at(-0.15, 0.0)],
    );
    line("pink", vec![at(-0.56, 0.25), at(-0.24, 0.25)]);
    line("pink", bow([0.2, 0.5 * HEIGHT], 0.5 * HEIGHT));
    line("pink", vec![at(0.3, 0.5 * HEIGHT), at(0.58, 0.0)]);
    line(
        "cyan",
        vec![
            at(0.75, HEIGHT),
            at(1.0, 0.4),
            at(1.25, HEIGHT),
            at(0.75, HEIGHT),
        ],
    );
    line("cyan", vec![at(1.0, 0.4), at(1.0, 0.02)]);
    line("cyan", vec![at(0.85, 0.0), at(1.15, 0.0)]);
    line("cyan", frame());
    model_files("neon_sign", &mesh, MATERIALS)
}

/// Round part of a B or an R, to the right of (x, y), with a height.
fn bow([x, y]: [f64; 2], height: f64) -> Vec<DVec2> {
    let middle = DVec2::new(x + 0.16, y + 0.5 * height - 0.5 * HEIGHT);
    let round = sample_curve(10, |part| {
        let (sine, cosine) = (PI * part - FRAC_PI_2).sin_cos();
        (middle + 0.5 * height * DVec2::new(0.95 * cosine, sine)).extend(0.0)
    });
    let ends = [0.0, height].map(|up| DVec2::new(x, y + up - 0.5 * HEIGHT));
    let round = round.into_iter().map(|point| point.truncate());
    [ends[0]]
        .into_iter()
        .chain(round)
        .chain([ends[1]])
        .collect()
}

/// Rounded rectangle around everything.
fn frame() -> Vec<DVec2> {
    let corner = |part: f64| {
        let angle = TAU * part;
        let direction = DVec2::from_angle(angle);
        let side = DVec2::new(direction.x.signum() * 1.2, direction.y.signum() * 0.4);
        side + 0.13 * direction
    };
    (0..=32)
        .map(|point| corner((f64::from(point) + 0.5) / 32.0))
        .collect()
}
