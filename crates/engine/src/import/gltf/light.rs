//! Lights of a file.

use std::fmt::Write;

use glam::{DVec3, Vec3};

use super::file::File;
use super::lost::Lost;
use super::moment::Moment;
use super::stage::Stage;

/// The sun of a file.
pub struct SunLight {
    /// Towards the sun.
    pub direction: DVec3,
    pub irradiance: Vec3,
}

/// A light that shines from a point.
pub struct PointLight {
    pub node: usize,
    /// Radiant intensity, in the unit of the sun's irradiance times square metres.
    pub intensity: Vec3,
}

/// Lights that have a counterpart.
#[derive(Default)]
pub struct Lights {
    pub sun: Option<SunLight>,
    pub points: Vec<PointLight>,
    /// Lights of any kind.
    pub count: usize,
}

impl Lights {
    /// Reads the lights that are shown. The strongest sun counts.
    pub fn read(stage: &Stage, moment: Moment, lost: &mut Lost) -> Result<Self, String> {
        let json = &stage.file.json;
        let lights = json
            .extensions
            .lights
            .as_ref()
            .map_or(&[][..], |lights| &lights.lights);
        let mut read = Self::default();
        let (mut suns, mut spots, mut others) = (0, 0, 0);
        for node in &stage.tree.shown {
            let Some(named) = &json.nodes[*node].extensions.light else {
                continue;
            };
            let light = File::entry(lights, "lights", named.light)?;
            let strength = light.intensity * Vec3::from(light.color);
            if !strength.is_finite() || strength.min_element() < 0.0 {
                return Err(format!(
                    "light \"{}\" has the intensity {} and the colour {:?}; allowed: 0 and more",
                    light.name, light.intensity, light.color
                ));
            }
            if strength == Vec3::ZERO {
                continue;
            }
            read.count += 1;
            match light.kind.as_str() {
                "directional" => {
                    suns += 1;
                    let back = stage.world(*node, moment.seconds).z_axis.truncate();
                    let is_stronger =
                        |sun: &SunLight| strength.element_sum() > sun.irradiance.element_sum();
                    if read.sun.as_ref().is_none_or(is_stronger) {
                        read.sun = Some(SunLight {
                            direction: back.normalize_or(DVec3::Y),
                            irradiance: strength,
                        });
                    }
                }
                "point" => read.points.push(PointLight {
                    node: *node,
                    intensity: strength,
                }),
                "spot" => spots += 1,
                _ => others += 1,
            }
        }
        lost.count(spots, "spot light", "spot lights");
        lost.count(
            others,
            "light of an unknown kind",
            "lights of unknown kinds",
        );
        lost.count(
            usize::max(suns, 1) - 1,
            "further sun (the strongest is used)",
            "further suns (the strongest is used)",
        );
        Ok(read)
    }
}

/// Writes a small ball of a radius, in metres, of a material; returns its surface's area too.
pub fn ball_text(radius: f64, material: &str) -> (String, f32) {
    const AROUND: usize = 16;
    const ROWS: usize = 8;
    let point = |row: usize, column: usize| {
        let down = std::f64::consts::PI * row as f64 / ROWS as f64;
        let around = std::f64::consts::TAU * (column % AROUND) as f64 / AROUND as f64;
        DVec3::new(
            around.cos() * down.sin(),
            down.cos(),
            around.sin() * down.sin(),
        ) * radius
    };
    let mut text = String::from("mtllib materials.mtl\no ball\n");
    let (mut area, mut next) = (0.0, 1);
    let mut faces = String::new();
    let line = "text takes text";
    for row in 0..ROWS {
        for column in 0..AROUND {
            let corners = [
                (row, column),
                (row, column + 1),
                (row + 1, column + 1),
                (row + 1, column),
            ];
            let points = corners.map(|(row, column)| point(row, column));
            for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                let doubled = (points[b] - points[a])
                    .cross(points[c] - points[a])
                    .length();
                if doubled < 1e-9 * radius * radius {
                    continue;
                }
                area += 0.5 * doubled;
                for p in [points[a], points[b], points[c]] {
                    let [x, y, z] = p.as_vec3().to_array();
                    writeln!(text, "v {x} {y} {z}").expect(line);
                }
                writeln!(faces, "f {next} {} {}", next + 1, next + 2).expect(line);
                next += 3;
            }
        }
    }
    (format!("{text}usemtl {material}\n{faces}"), area as f32)
}

/// Returns the radiance of a convex body with a surface that shines like a point on average: a
/// direction sees a quarter of the surface on average (Cauchy).
pub fn radiance(intensity: Vec3, area: f32) -> Vec3 {
    intensity / (0.25 * area)
}
