//! Surfaces of different materials in one place, where rounding decides which one a ray sees.

use std::collections::BTreeMap;

use rayon::prelude::*;
use scene::Scene;

use crate::error::TraceError;
use crate::hit::Hit;
use crate::motion::view::View;
use crate::stage::Stage;

/// Number of rays through the picture of the instant: about three of them meet a ten-thousandth of
/// the picture.
const RAYS: u32 = 32_768;
/// Rays that must see a pair before it counts: one may meet the edge at which two surfaces touch.
const LEAST_RAYS: usize = 3;
/// Steps of the R2 sequence, which fills the unit square evenly (Roberts 2018, "The unreasonable
/// effectiveness of quasirandom sequences").
const STEPS: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];

/// An object, and a material of the scene.
type Painted = (usize, usize);

/// Finds surfaces of different materials that the camera sees in one place at the instant, and
/// describes each pair of objects.
///
/// # Errors
/// An object is too far away.
pub fn find_coincident_surfaces(scene: &Scene) -> Result<Vec<String>, TraceError> {
    let stage = Stage::try_new(scene, 0.0, 0.0)?;
    let view = View::new(&scene.camera, 0.0, scene.width, scene.height);
    let size = [scene.width, scene.height].map(f64::from);
    let painted = |object: usize, triangle: u32| -> Painted {
        let object_of = &scene.objects[object];
        let slot = scene.meshes[object_of.mesh].slots[triangle as usize];
        (object, object_of.materials[slot as usize])
    };
    let seen: Vec<([Painted; 2], [f64; 2])> = (0..RAYS)
        .into_par_iter()
        .map_init(
            || stage.poses(),
            |poses, index| {
                let place =
                    [0, 1].map(|axis| (0.5 + f64::from(index) * STEPS[axis]).fract() * size[axis]);
                let ray = view.ray(place[0], place[1]);
                let first: Hit = stage.closest(poses.at(0.0), &ray)?;
                let surface = painted(first.object, first.triangle);
                let is_other = |object, triangle| painted(object, triangle).1 != surface.1;
                let other = stage.coincident(poses, &ray, &first, &is_other)?;
                let mut pair = [surface, painted(other.object, other.triangle)];
                pair.sort_unstable();
                Some((pair, place))
            },
        )
        .flatten()
        .collect();
    let mut pairs: BTreeMap<[Painted; 2], Vec<[f64; 2]>> = BTreeMap::new();
    for (pair, place) in seen {
        pairs.entry(pair).or_default().push(place);
    }
    let counted = pairs
        .iter()
        .filter(|(_, places)| places.len() >= LEAST_RAYS);
    Ok(counted
        .map(|(pair, places)| describe(scene, pair, places[0]))
        .collect())
}

fn describe(scene: &Scene, pair: &[Painted; 2], [x, y]: [f64; 2]) -> String {
    let [one, other] = pair.map(|(object, material)| {
        let name = &scene.objects[object].name;
        format!("\"{name}\" (material {})", scene.materials[material].name)
    });
    format!(
        "{}: {one} and {other} have surfaces in one place, seen at ({x:.0}, {y:.0}) of {}x{} pixels; rounding decides which one is \
         seen: cut one of them, or move it by a millimetre",
        scene.id, scene.width, scene.height
    )
}
