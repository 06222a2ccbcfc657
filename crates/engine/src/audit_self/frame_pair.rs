//! Pairs of consecutive frames: is a surface of the later one visible at a place of the earlier one?

use std::collections::BTreeMap;

use frame::{Plane, Raster, Vectors};
use glam::DVec2;

use crate::audit_self::brightness::{Brightness, Sample, choose_white};
use crate::capture::folder::Capture;

/// Pixels around a place that must show the same surface: smoothing and interpolation read them.
const MARGIN: u32 = 2;
/// Largest bend of a surface within the margin, relative to its nearness.
const LARGEST_BEND: f32 = 0.1;
/// Largest change of a point's depth between two frames, relative to its depth.
const DEPTH_CHANGE: f32 = 0.1;
/// Smallest number of pixels that say how much closer an object comes.
const MIN_RATIOS: usize = 9;
/// Largest ratio of the depths of a point that comes closer.
const LARGEST_APPROACH: f32 = 2.0;

/// Content of the earlier frame where velocity says that a pixel's surface was.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seen {
    /// The same surface.
    Same,
    /// An edge, where colours are mixed.
    Edge,
    /// Nothing: the place is outside the picture.
    Outside,
    /// Something nearer, which hid the surface.
    Hidden,
    /// Something farther away: the surface was not there.
    Behind,
}

/// Two consecutive frames of one size.
pub struct FramePair<'a> {
    pub before: &'a Capture,
    pub after: &'a Capture,
    old: Brightness,
    new: Brightness,
    old_inside: Raster<bool>,
    new_inside: Raster<bool>,
    /// Per object, the largest ratio of a point's old depth to its new one.
    approach: BTreeMap<u32, f32>,
}

impl<'a> FramePair<'a> {
    /// Prepares the comparison of two frames.
    pub fn new(before: &'a Capture, after: &'a Capture) -> Self {
        let white = choose_white([&before.color, &after.color]);
        Self {
            before,
            after,
            old: Brightness::of(&before.color, white),
            new: Brightness::of(&after.color, white),
            old_inside: mark_inside(before),
            new_inside: mark_inside(after),
            approach: measure_approach(before, after),
        }
    }

    /// Returns whether a pixel of the later frame is well inside a surface.
    pub fn is_inside(&self, at: usize) -> bool {
        self.new_inside.pixels[at]
    }

    /// Returns the place of a pixel.
    pub fn pixel(&self, at: usize) -> DVec2 {
        let width = self.after.color.width as usize;
        DVec2::new((at % width) as f64, (at / width) as f64)
    }

    /// Returns the place of the earlier frame that a velocity leads back to.
    pub fn place(&self, at: usize, velocity: &Vectors) -> DVec2 {
        self.pixel(at) - to_vector(velocity.pixels[at])
    }

    /// Compares the surface at a pixel of the later frame with the surface at a place of the
    /// earlier one.
    pub fn look(&self, at: usize, place: DVec2) -> Seen {
        if !self.new_inside.pixels[at] {
            return Seen::Edge;
        }
        let Some(around) = self.around(place) else {
            return Seen::Outside;
        };
        let pixels = around.map(|old| self.compare(at, old));
        match pixels {
            _ if pixels.iter().all(|seen| *seen == pixels[0]) => {
                let is_clear = around.iter().all(|old| self.old_inside.pixels[*old]);
                if pixels[0] == Seen::Same && !is_clear {
                    Seen::Edge
                } else {
                    pixels[0]
                }
            }
            _ => Seen::Edge,
        }
    }

    /// Brightness of the later frame at a pixel.
    pub fn new_sample(&self, at: usize) -> Option<Sample> {
        self.new.at(self.pixel(at))
    }

    /// Brightness of the earlier frame at the pixel at a place; none if it shows another surface
    /// than a pixel of the later frame, or an edge.
    pub fn old_value(&self, at: usize, place: DVec2) -> Option<f64> {
        let size = self.before.color.size();
        let (x, y) = (place.x as i64, place.y as i64);
        let is_inside =
            (0..i64::from(size.width)).contains(&x) && (0..i64::from(size.height)).contains(&y);
        let old = is_inside.then(|| y as usize * size.width as usize + x as usize)?;
        let is_same = self.old_inside.pixels[old] && self.compare(at, old) == Seen::Same;
        is_same.then(|| self.old.value(old))
    }

    /// Brightness of the earlier frame at a place.
    pub fn old_sample(&self, place: DVec2) -> Option<Sample> {
        self.old.at(place)
    }

    /// Lists the four pixels around a place; none if one is outside the picture's margin.
    fn around(&self, place: DVec2) -> Option<[usize; 4]> {
        let size = self.before.color.size();
        let corner = place.floor();
        let is_inside = corner.min_element() >= 1.0
            && corner.x + 2.0 < f64::from(size.width)
            && corner.y + 2.0 < f64::from(size.height);
        let width = size.width as usize;
        is_inside.then(|| {
            let first = corner.y as usize * width + corner.x as usize;
            [first, first + 1, first + width, first + width + 1]
        })
    }

    /// Compares the surfaces at two pixels.
    fn compare(&self, at: usize, old: usize) -> Seen {
        let change = self.after.velocity_z.as_ref();
        let moved = change.map_or(0.0, |change| change.pixels[at]);
        let ratio = self.before.depth.pixels[old] / (self.after.depth.pixels[at] - moved);
        let id =
            |capture: &Capture, at: usize| capture.object_id.as_ref().map(|ids| ids.pixels[at]);
        let (old_id, new_id) = (id(self.before, old), id(self.after, at));
        let is_same = old_id == new_id;
        // Without the change of depth, a point may have come closer.
        let known = || new_id.and_then(|id| self.approach.get(&id)).copied();
        let farthest = if change.is_some() {
            1.0 + DEPTH_CHANGE
        } else {
            known().unwrap_or(LARGEST_APPROACH)
        };
        match ratio {
            _ if is_same && (1.0 - DEPTH_CHANGE..=farthest).contains(&ratio) => Seen::Same,
            _ if ratio <= farthest => Seen::Hidden,
            _ if is_same && new_id.is_some() => Seen::Edge,
            _ => Seen::Behind,
        }
    }
}

/// Measures how much closer the points of each object come, where velocity leads to the same object.
fn measure_approach(before: &Capture, after: &Capture) -> BTreeMap<u32, f32> {
    let (Some(old_ids), Some(new_ids)) = (&before.object_id, &after.object_id) else {
        return BTreeMap::new();
    };
    let size = after.color.size();
    let mut ratios = BTreeMap::<u32, Vec<f32>>::new();
    for (at, id) in new_ids.pixels.iter().enumerate() {
        let [x, y] = after.velocity.pixels[at];
        let column = (at % size.width as usize) as f32 - x;
        let row = (at / size.width as usize) as f32 - y;
        let is_inside = (0.0..size.width as f32).contains(&column.round())
            && (0.0..size.height as f32).contains(&row.round());
        if !is_inside {
            continue;
        }
        let old = row.round() as usize * size.width as usize + column.round() as usize;
        if old_ids.pixels[old] == *id {
            let ratio = before.depth.pixels[old] / after.depth.pixels[at];
            ratios.entry(*id).or_default().push(ratio);
        }
    }
    let largest = |mut ratios: Vec<f32>| {
        ratios.sort_by(f32::total_cmp);
        let usual = ratios[(ratios.len() - 1) * 9 / 10];
        usual.clamp(1.0, LARGEST_APPROACH) * (1.0 + DEPTH_CHANGE)
    };
    let ratios = ratios
        .into_iter()
        .filter(|(_, ratios)| ratios.len() >= MIN_RATIOS);
    ratios.map(|(id, ratios)| (id, largest(ratios))).collect()
}

/// Converts a velocity for computing.
pub fn to_vector(velocity: [f32; 2]) -> DVec2 {
    DVec2::from(velocity.map(f64::from))
}

/// Marks the pixels well inside a surface: one object, whose nearness has no step or crease.
fn mark_inside(capture: &Capture) -> Raster<bool> {
    let size = capture.color.size();
    let nearness = capture.depth.map(|depth| 1.0 / depth);
    let is_inside = |x: u32, y: u32| {
        let is_off_border =
            x >= MARGIN && y >= MARGIN && x + MARGIN < size.width && y + MARGIN < size.height;
        is_off_border && is_one_object(capture, x, y) && is_smooth(&nearness, x, y)
    };
    Raster::from_fn(size.width, size.height, is_inside)
}

fn is_one_object(capture: &Capture, x: u32, y: u32) -> bool {
    let Some(ids) = &capture.object_id else {
        return true;
    };
    let mut rows = y - MARGIN..=y + MARGIN;
    rows.all(|row| (x - MARGIN..=x + MARGIN).all(|column| ids.at(column, row) == ids.at(x, y)))
}

/// Returns whether nearness is about linear around a pixel, as of a plane.
fn is_smooth(nearness: &Plane, x: u32, y: u32) -> bool {
    let middle = *nearness.at(x, y);
    let mut rows = 0..=MARGIN;
    rows.all(|row| {
        (0..=2 * MARGIN).all(|column| {
            let one = nearness.at(x + column - MARGIN, y + row);
            let opposite = nearness.at(x + MARGIN - column, y - row);
            (one + opposite - 2.0 * middle).abs() <= LARGEST_BEND * middle
        })
    })
}
