//! Synthetic scenes, and blurs of them: with one mistake each, and some correct ones.

use std::f64::consts::FRAC_PI_2;

use frame::{Frame, Picture, Plane, Raster, Size, regions};
use tests::synthetic::{Blur, EXPOSURE, Object, Sampling, Scene, Shape, constant};

use super::touches::touch;
use crate::{bar, dilated, mix, shifted, smear};

/// Samples of a render with other noise than the truth's.
pub const APART: Sampling = Sampling {
    samples: 512,
    seed: Some(99),
};

/// Makes wrong pictures of a scene, with their names, some of them from the `right` blur.
pub fn decoys(scene: &Scene, frame: &Frame, right: &Picture) -> Vec<(&'static str, Picture)> {
    let blurred = |blur: Blur| scene.render(&blur, APART);
    let instant = frame.picture();
    let wide = blurred(dilated(6.0));
    let rescaled = rescale(right, &wide, &instant);
    let mut decoys = vec![
        ("identity", instant.clone()),
        ("constant", constant(right)),
        ("half length", blurred(smear(-0.5, 0.0))),
        ("1.5 length", blurred(smear(-1.5, 0.0))),
        ("wrong side", blurred(smear(-0.5, 0.5))),
        ("shift along", blurred(shifted([3.0, 0.0]))),
        ("shift across", blurred(shifted([0.0, 3.0]))),
        ("dilation 2 px", blurred(dilated(2.0))),
        ("dilation 6 px", wide),
        ("isotropic", blur_isotropically(&instant, 7.0)),
        ("fat, rescaled", rescaled),
        ("own velocity", gather(frame)),
        ("sharp core", sharpen(right, &instant, scene)),
        ("banding", blurred(Blur::accumulation(4))),
    ];
    let still = regions(&scene.truth([Sampling::CLEAN; 2])).still;
    decoys.extend(touch(right, &still));
    decoys
}

/// Thins the dilated picture until every object has its true mass; the instant fills the gaps.
fn rescale(right: &Picture, wide: &Picture, instant: &Picture) -> Picture {
    let mass = |picture: &Picture| -> f64 {
        let pixels = picture.coverage[1..].iter().flat_map(|matte| &matte.pixels);
        pixels.map(|a| f64::from(*a)).sum()
    };
    let part = (mass(right) / mass(wide)) as f32;
    let mut gaps = instant.clone();
    for (index, matte) in gaps.coverage.iter_mut().enumerate() {
        matte.pixels.fill(f32::from(index == 0));
    }
    mix(&gaps, wide, part)
}

/// Draws the instant's movers over their own true smears.
fn sharpen(right: &Picture, instant: &Picture, scene: &Scene) -> Picture {
    let movers = (scene.objects.iter().zip(&instant.coverage[1..]))
        .filter(|(object, _)| object.displacement != [0.0; 2] || object.turn != 0.0);
    let nothing: Plane = instant.coverage[0].map(|_| 0.0);
    let core = movers.fold(nothing, |sum, (_, matte)| sum.zip(matte, |sum, a| sum + a));
    let over = |(a, b): (f32, f32), core: f32| core * a + (1.0 - core) * b;
    let color = (instant.color).zip(&right.color, |a, b| [0, 1, 2].map(|c| (a[c], b[c])));
    let mattes = instant.coverage.iter().zip(&right.coverage);
    let mattes = mattes.map(|(a, b)| a.zip(b, |a, b| (*a, *b)));
    Picture {
        color: color.zip(&core, |pairs, core| pairs.map(|pair| over(pair, *core))),
        coverage: (mattes.map(|pairs| pairs.zip(&core, |pair, core| over(*pair, *core)))).collect(),
    }
}

/// Changes the planes of a picture's colour and its mattes alike.
pub fn map_planes(picture: &Picture, change: impl Fn(&Plane) -> Plane) -> Picture {
    let channels = [0, 1, 2].map(|c| change(&picture.color.map(|color| color[c])));
    Picture {
        color: Raster::from_fn(picture.color.width, picture.color.height, |x, y| {
            [0, 1, 2].map(|c| *channels[c].at(x, y))
        }),
        coverage: picture.coverage.iter().map(change).collect(),
    }
}

/// Averages for each pixel the colours ahead of it along its own velocity, in 64 steps. Nothing is
/// carried beyond an outline.
fn gather(frame: &Frame) -> Picture {
    let Size { width, height } = frame.size();
    let taps = |x: u32, y: u32| {
        let velocity = frame.velocity.at(x, y).map(f64::from);
        (0..64).map(move |step| {
            let part = (f64::from(step) + 0.5) / 64.0 * EXPOSURE;
            let place = |at: u32, axis: usize, size: u32| {
                let place = f64::from(at) + 0.5 + part * velocity[axis];
                place.floor().clamp(0.0, f64::from(size - 1))
            };
            (place(x, 0, width) as u32, place(y, 1, height) as u32)
        })
    };
    map_planes(&frame.picture(), |plane| {
        Raster::from_fn(width, height, |x, y| {
            taps(x, y).map(|(u, v)| *plane.at(u, v)).sum::<f32>() / 64.0
        })
    })
}

/// Blurs with a Gaussian of `sigma` pixels in all directions, normalised at the border.
pub fn blur_isotropically(instant: &Picture, sigma: f64) -> Picture {
    map_planes(instant, |plane| {
        across(&across(plane, sigma, [1, 0]), sigma, [0, 1])
    })
}

fn across(plane: &Plane, sigma: f64, step: [i64; 2]) -> Plane {
    let reach = (3.0 * sigma) as i64;
    Raster::from_fn(plane.width, plane.height, |x, y| {
        let (mut sum, mut total) = (0.0, 0.0);
        for offset in -reach..=reach {
            let [u, v] = [
                i64::from(x) + step[0] * offset,
                i64::from(y) + step[1] * offset,
            ];
            if (0..i64::from(plane.width)).contains(&u) && (0..i64::from(plane.height)).contains(&v)
            {
                let weight = (-0.5 * (offset as f64 / sigma).powi(2)).exp();
                sum += weight * f64::from(*plane.at(u as u32, v as u32));
                total += weight;
            }
        }
        (sum / total) as f32
    })
}

fn scene(objects: Vec<Object>) -> Scene {
    crate::scene([112, 84], objects)
}

/// Makes scenes by name: a translation, a rotation, two crossing paths, thin objects, and a mover
/// between still objects.
pub fn scenes() -> Vec<(&'static str, Scene)> {
    let still = [0.0, 0.0];
    let mut turning = Object::sliding(bar([28.0, 5.0], 0.4), [56.3, 42.2], still);
    turning.turn = 1.2;
    let wires = [34.3, 50.3, 66.3]
        .map(|x| Object::sliding(bar([24.0, 1.2], FRAC_PI_2), [x + 9.0, 42.2], [18.0, 0.0]));
    let disc = Object::sliding(Shape::Disc(12.0), [68.3, 44.2], [28.0, 5.0]);
    let crossing = [
        Object::sliding(Shape::Disc(8.0), [76.3, 30.2], [30.0, 0.0]),
        Object::sliding(bar([9.0, 6.0], 0.3), [48.3, 62.2], [4.0, 24.0]),
    ];
    let overlap = [
        Object::sliding(bar([2.5, 34.0], 0.0), [46.0, 42.0], still),
        Object::sliding(Shape::Disc(12.0), [68.3, 42.2], [28.0, 0.0]),
        Object::sliding(bar([14.0, 14.0], 0.0), [84.0, 42.0], still),
    ];
    vec![
        ("disc", scene(vec![disc])),
        ("turning bar", scene(vec![turning])),
        ("crossing", scene(crossing.to_vec())),
        ("wires", scene(wires.to_vec())),
        ("overlap", scene(overlap.to_vec())),
    ]
}
