//! Set of an imported scene: stand, floor and wall, all patterned, so that blur over them is
//! visible.

use std::fmt::Write;
use std::path::Path;

use frame::{FileError, Raster, write_atomically, write_png};

use crate::import::model::Model;

/// Height of the stand, in radii of the model.
pub const STAND_HEIGHT: f64 = 0.04;

/// Distance from the middle of the model to the wall, in its radii.
pub const WALL_DISTANCE: f64 = 4.0;

/// Half a side of the floor and of the wall, in radii of the model.
const EXTENT: f64 = 40.0;

/// Side of the floor's and the wall's squares, in radii of the model.
const SQUARE: f64 = 0.5;

/// Corners of the stand's disc.
const CORNERS: u32 = 96;

const MATERIALS: &str = "\
newmtl floor
map_Kd floor.png
newmtl wall
map_Kd wall.png
newmtl light
Kd 0.62 0.6 0.55
newmtl dark
Kd 0.25 0.24 0.23
";

/// Writes the set's meshes, materials and textures.
pub fn write_set(scene: &Path, model: &Model) -> Result<(), FileError> {
    let radius = model.radius();
    write_backdrop(scene, radius)?;
    write_atomically(&scene.join("stand.obj"), stand(model).as_bytes())
}

/// Writes floor and wall around a model of a radius.
pub fn write_backdrop(scene: &Path, radius: f64) -> Result<(), FileError> {
    for (name, text) in [
        ("set.mtl", MATERIALS.to_owned()),
        ("floor.obj", plane("floor", EXTENT * radius, radius)),
        ("wall.obj", plane("wall", EXTENT * radius, radius)),
    ] {
        write_atomically(&scene.join(name), text.as_bytes())?;
    }
    let floor = squares([0.55, 0.52, 0.5], [0.72, 0.7, 0.66]);
    write_png(&scene.join("floor.png"), &floor)?;
    let wall = squares([0.5, 0.6, 0.68], [0.62, 0.72, 0.8]);
    write_png(&scene.join("wall.png"), &wall)
}

/// Writes a square that faces +Z, its texture repeated every two squares.
fn plane(material: &str, half: f64, radius: f64) -> String {
    let repeats = half / (SQUARE * radius);
    format!(
        "mtllib set.mtl\nusemtl {material}\nv {l} {l} 0\nv {h} {l} 0\nv {h} {h} 0\nv {l} {h} 0\n\
         vt 0 0\nvt {r} 0\nvt {r} {r}\nvt 0 {r}\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n",
        l = -half,
        h = half,
        r = repeats
    )
}

/// Writes a disc of alternating colours around the origin, with its upper face at height 0, wide
/// enough for the model in any rotation.
fn stand(model: &Model) -> String {
    let half = model.half_size();
    let disc = 1.1 * half.x.hypot(half.z).max(0.25 * model.radius());
    let height = STAND_HEIGHT * model.radius();
    let mut text = String::from("mtllib set.mtl\nv 0 0 0\n");
    for corner in 0..CORNERS {
        let angle = f64::from(corner) / f64::from(CORNERS) * std::f64::consts::TAU;
        let (x, z) = (disc * angle.cos(), disc * angle.sin());
        for y in [0.0, -height] {
            writeln!(text, "v {x} {y} {z}").expect("text takes text");
        }
    }
    for (material, odd) in [("light", 0), ("dark", 1)] {
        writeln!(text, "usemtl {material}").expect("text takes text");
        // Twelve stripes around, eight corners each.
        for corner in (0..CORNERS).filter(|corner| corner / 8 % 2 == odd) {
            let [here, next] = [corner, (corner + 1) % CORNERS].map(|corner| 2 + 2 * corner);
            writeln!(text, "f 1 {next} {here}").expect("text takes text");
            writeln!(text, "f {here} {next} {} {}", next + 1, here + 1).expect("text takes text");
        }
    }
    text
}

/// Paints two by two squares of display colours, each with a frame.
fn squares(dark: [f32; 3], light: [f32; 3]) -> Raster<[f32; 3]> {
    const TEXELS: u32 = 64;
    Raster::from_fn(2 * TEXELS, 2 * TEXELS, |x, y| {
        let edge = [x % TEXELS, y % TEXELS].map(|at| at.min(TEXELS - 1 - at));
        let color = match (x / TEXELS + y / TEXELS) % 2 {
            0 => dark,
            _ => light,
        };
        let shade = if edge[0].min(edge[1]) < 3 { 0.7 } else { 1.0 };
        color.map(|value| value * shade)
    })
}
