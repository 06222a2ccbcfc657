//! Profile of a case: brightness along the motion through one place.

use frame::{Frame, Image, Raster, Vectors, luminance};
use measure::Case;

use crate::pixels::scene_files::{CaseFiles, SceneFiles, TruthFile};

/// Smallest motion of a moving place, in pixels over the shutter.
const LEAST_MOTION: f32 = 0.5;
/// Smallest and largest length before and after the place, in pixels.
const REACH: [f32; 2] = [16.0, 80.0];
/// Length before and after the place, relative to the motion there.
const LENGTHS: f32 = 1.5;

/// One line through a case's pictures.
pub struct Profile {
    /// The pixel in the middle.
    pub place: [u32; 2],
    /// Ends of the line, in pixels.
    pub ends: [[f32; 2]; 2],
    /// Pictures, in the order of the chart.
    pub curves: Vec<Curve>,
}

/// The brightness of one picture along a line.
pub struct Curve {
    pub title: String,
    /// Class in the style sheet.
    pub class: &'static str,
    /// Distances from the place, in pixels along the motion, each with the luminance (Rec.709) of
    /// the nearest pixel.
    pub points: Vec<(f64, f64)>,
}

/// Follows the motion through `place` in a case's pictures, and in its scene's accumulation if the
/// run has one.
pub fn trace_profile(
    place: [u32; 2],
    case: &Case,
    scene: &SceneFiles,
    files: &CaseFiles,
) -> Profile {
    let truth = &scene.truths[&case.alignment];
    let motion = motion_at(place, &scene.frame, truth);
    let length = motion[0].hypot(motion[1]);
    let direction = if length > 0.0 {
        motion.map(|component| component / length)
    } else {
        [1.0, 0.0]
    };
    let reach = (LENGTHS * length).clamp(REACH[0], REACH[1]).round() as i32;
    let size = [truth.mean.color.width, truth.mean.color.height];
    let pixels: Vec<(f32, [u32; 2])> = (-reach..=reach)
        .filter_map(|step| Some((step as f32, pixel_at(place, direction, step as f32, size)?)))
        .collect();
    let curve = |title: &str, class, image: &Image| Curve {
        title: title.to_owned(),
        class,
        points: (pixels.iter())
            .map(|(distance, [x, y])| (f64::from(*distance), luminance(*image.at(*x, *y)).into()))
            .collect(),
    };
    let mut curves = vec![
        curve("truth", "truth", &truth.mean.color),
        curve("output", "output", &files.output),
        curve("instant", "instant", &scene.frame.color),
    ];
    let accumulation = scene.accumulations.get(&case.alignment);
    curves.extend(accumulation.map(|(title, image)| curve(title, "accumulation", image)));
    let end = |pixel: Option<&(f32, [u32; 2])>| {
        let distance = pixel.map_or(0.0, |(distance, _)| *distance);
        [0, 1].map(|axis| place[axis] as f32 + 0.5 + direction[axis] * distance)
    };
    Profile {
        place,
        ends: [end(pixels.first()), end(pixels.last())],
        curves,
    }
}

/// Finds the pixel with the largest error in a block; the first of equal ones.
pub fn worst_pixel(map: &Raster<f32>, [x, y]: [u32; 2], block: u32) -> [u32; 2] {
    let around = |middle: u32, size: u32| {
        let first = middle / block * block;
        first..(first + block).min(size)
    };
    let mut worst = [x, y];
    for row in around(y, map.height) {
        for column in around(x, map.width) {
            if map.at(column, row) > map.at(worst[0], worst[1]) {
                worst = [column, row];
            }
        }
    }
    worst
}

/// Measures the motion over the shutter, in pixels: of the surface visible at the place, else of
/// the nearest moving one, else of what the truth saw there.
fn motion_at([x, y]: [u32; 2], frame: &Frame, truth: &TruthFile) -> [f32; 2] {
    let over_shutter = |motion: &[f32; 2]| motion.map(|axis| axis * frame.exposure as f32);
    nearest_moving(&frame.velocity.map(over_shutter), [x, y])
        .or_else(|| Some(*truth.offset.at(x, y)).filter(moves))
        .unwrap_or([0.0; 2])
}

fn moves(motion: &[f32; 2]) -> bool {
    motion[0].hypot(motion[1]) >= LEAST_MOTION
}

fn nearest_moving(motions: &Vectors, [x, y]: [u32; 2]) -> Option<[f32; 2]> {
    let distance = |at: usize| {
        let [column, row] = [at as u32 % motions.width, at as u32 / motions.width];
        i64::from(column.abs_diff(x)).pow(2) + i64::from(row.abs_diff(y)).pow(2)
    };
    let moving = (motions.pixels.iter().enumerate()).filter(|(_, motion)| moves(motion));
    let nearest = moving.min_by_key(|(at, _)| distance(*at));
    nearest.map(|(_, motion)| *motion)
}

/// Finds the pixel at a distance from a place; none outside the picture.
fn pixel_at(place: [u32; 2], direction: [f32; 2], step: f32, size: [u32; 2]) -> Option<[u32; 2]> {
    let on = |axis: usize| {
        let at = (place[axis] as f32 + step * direction[axis]).round();
        (0.0..size[axis] as f32).contains(&at).then_some(at as u32)
    };
    Some([on(0)?, on(1)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_ends_at_the_pictures_border() {
        let step = |step| pixel_at([2, 1], [0.6, 0.8], step, [6, 4]);
        assert_eq!(step(0.0), Some([2, 1]));
        assert_eq!(step(2.0), Some([3, 3]));
        assert_eq!(step(4.0), None, "below the last row");
        assert_eq!(step(-4.0), None, "left of the first column");
    }

    #[test]
    fn the_worst_pixel_is_looked_for_in_its_own_block() {
        let map = Raster::from_fn(40, 20, |x, y| match (x, y) {
            (19, 3) => 0.5,
            (33, 3) => 0.9,
            _ => 0.0,
        });
        assert_eq!(worst_pixel(&map, [24, 8], 16), [19, 3]);
        assert_eq!(worst_pixel(&map, [8, 8], 16), [8, 8]);
    }

    #[test]
    fn what_moves_nearest_is_found() {
        let motions = Raster::from_fn(9, 9, |x, y| match (x, y) {
            (1, 1) => [3.0, 0.0],
            (8, 8) => [0.0, 2.0],
            _ => [0.0; 2],
        });
        assert_eq!(nearest_moving(&motions, [3, 4]), Some([3.0, 0.0]));
        assert_eq!(nearest_moving(&motions, [6, 6]), Some([0.0, 2.0]));
    }
}
