//! Outlines of faces in a plane, and their ears.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// Largest error of corners in files, as a part of a face's perimeter. Thin faces cross themselves
/// by as much.
const ERROR_IN_FILES: f64 = 1e-5;

/// Least part of a face's area, counted by turns, that shows the face's plane.
const CANCELLED: f64 = 1e-3;

/// Upper limit on the rounding of a sum of angles, in radians.
const ROUNDING_OF_ANGLES: f64 = 1e-9;

/// Corners of a face in a plane, counterclockwise.
pub(super) struct Outline {
    points: Vec<robust::Coord<f64>>,
    /// Twice the area, counted once for each turn around it.
    area: f64,
    pub(super) perimeter: f64,
    /// Rounding of coordinates to 32 bits.
    pub(super) rounding: f64,
    /// Largest error of corners.
    pub(super) error: f64,
}

/// Point of a side where another side crosses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// Numbers of the side's ends.
    pub(super) ends: [u32; 2],
    /// Distance from the first end, as a part of the side.
    pub(super) along: f64,
}

/// Corners that are left while ears are cut, each with its neighbours.
struct Ring {
    before: Vec<usize>,
    after: Vec<usize>,
}

impl Outline {
    pub(super) fn new(corners: &[DVec3]) -> Self {
        let spans = corners[1..].windows(2);
        let normals = spans.map(|pair| (pair[0] - corners[0]).cross(pair[1] - corners[0]));
        // Newell's normal: its length is twice the area. Parts that turn the other way may leave
        // little of it.
        let mut normal: DVec3 = normals.clone().sum();
        let spread: DVec3 = normals.map(DVec3::abs).sum();
        if normal.length() < CANCELLED * spread.length() {
            normal = spread;
        }
        let across = normal.abs().max_position();
        let [right, up] = [(across + 1) % 3, (across + 2) % 3];
        let point = |corner: &DVec3| robust::Coord {
            x: corner[right],
            y: corner[up],
        };
        let points: Vec<_> = corners.iter().map(point).collect();
        let sides = points.iter().zip(points.iter().cycle().skip(1));
        let perimeter = sides.map(|(a, b)| (b.x - a.x).hypot(b.y - a.y)).sum();
        let reach = corners.iter().map(|corner| corner.abs().max_element());
        let rounding = f64::from(f32::EPSILON) * reach.fold(0.0, f64::max);
        let mut outline = Self {
            points,
            area: 0.0,
            perimeter,
            rounding,
            error: ERROR_IN_FILES * perimeter + rounding,
        };
        let fan = 2..corners.len();
        outline.area = fan.map(|last| outline.turn(0, last - 1, last)).sum();
        if outline.area < 0.0 {
            outline.area = -outline.area;
            outline
                .points
                .iter_mut()
                .for_each(|point| point.x = -point.x);
        }
        outline
    }

    /// Twice the area of a triangle; negative if it is clockwise. Its sign is exact.
    fn turn(&self, a: usize, b: usize, c: usize) -> f64 {
        let [a, b, c] = [a, b, c].map(|corner| self.points[corner]);
        robust::orient2d(a, b, c)
    }

    /// Twice the area that triangles cover more than once, or miss.
    pub(super) fn misfit(&self, triangles: &[[u32; 3]]) -> f64 {
        let turn = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|corner| corner as usize);
            self.turn(a, b, c).abs()
        };
        (triangles.iter().map(turn).sum::<f64>() - self.area).abs()
    }

    /// Returns whether the outline goes around its first corner more than once. A fan from there
    /// would cover a part twice.
    pub(super) fn surrounds_first(&self) -> bool {
        let first = self.points[0];
        let others = self.points[1..].iter().filter(|point| **point != first);
        let directions: Vec<f64> = others
            .map(|point| (point.y - first.y).atan2(point.x - first.x))
            .collect();
        let turns = directions
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).rem_euclid(TAU));
        // Turns of more than half a circle are clockwise.
        let turns = turns.map(|turn| if turn > PI { turn - TAU } else { turn });
        turns.sum::<f64>() > TAU + ROUNDING_OF_ANGLES
    }

    /// Finds a side that another side crosses, by more than errors of corners.
    pub(super) fn find_crossing(&self) -> Option<Crossing> {
        let count = self.points.len();
        let side = |first: usize| [first, (first + 1) % count];
        let pairs =
            (0..count).flat_map(|first| (first + 2..count).map(move |second| (first, second)));
        let mut crossings = pairs.filter_map(|(first, second)| {
            self.divide(side(first), side(second))?;
            self.divide(side(second), side(first))
        });
        crossings.next()
    }

    /// Finds where the line of one side divides another side.
    fn divide(&self, [from, to]: [usize; 2], ends: [usize; 2]) -> Option<Crossing> {
        let [a, b] = [from, to].map(|corner| self.points[corner]);
        let [c, d] = ends.map(|end| self.turn(from, to, end));
        let is_divided =
            c * d < 0.0 && c.abs().min(d.abs()) > self.error * (b.x - a.x).hypot(b.y - a.y);
        is_divided.then(|| Crossing {
            ends: ends.map(|end| end as u32),
            along: c / (c - d),
        })
    }

    /// Cuts one ear after the other: a corner that turns left, with no other corner in its
    /// triangle. Returns none if there is none, because the outline crosses itself.
    pub(super) fn cut_ears(&self) -> Option<Vec<[u32; 3]>> {
        let count = self.points.len();
        let mut ring = Ring {
            before: (0..count)
                .map(|corner| (corner + count - 1) % count)
                .collect(),
            after: (0..count).map(|corner| (corner + 1) % count).collect(),
        };
        let mut triangles = Vec::with_capacity(count - 2);
        let mut corner = 0;
        // Corners to try before the next kind of ear.
        let mut untried = count;
        let mut cuts_straight = false;
        while triangles.len() < count - 2 {
            let [before, after] = [ring.before[corner], ring.after[corner]];
            let is_last = triangles.len() + 3 == count;
            let is_ear = if cuts_straight {
                self.turn(before, corner, after) == 0.0
            } else {
                self.is_ear(&ring, corner)
            };
            if is_ear || is_last {
                triangles.push([before, corner, after].map(|corner| corner as u32));
                ring.after[before] = after;
                ring.before[after] = before;
                // Only the two neighbours may have become ears.
                corner = before;
                untried = count - triangles.len();
                cuts_straight = false;
                continue;
            }
            corner = after;
            untried -= 1;
            if untried == 0 {
                if cuts_straight {
                    return None;
                }
                // What is left has no area there, such as a side that goes there and back.
                cuts_straight = true;
                untried = count - triangles.len();
            }
        }
        Some(triangles)
    }

    fn is_ear(&self, ring: &Ring, tip: usize) -> bool {
        let [before, after] = [ring.before[tip], ring.after[tip]];
        if self.turn(before, tip, after) <= 0.0 {
            return false;
        }
        let others =
            std::iter::successors(Some(ring.after[after]), |other| Some(ring.after[*other]));
        let mut others = others.take_while(|other| *other != before);
        !others.any(|other| self.is_blocked(ring, [before, tip, after], other))
    }

    /// Returns whether another corner, or its sides, lie in an ear.
    ///
    /// A face with a hole touches itself, because a side leads to the hole and back. There, corners
    /// lie on corners.
    fn is_blocked(&self, ring: &Ring, [before, tip, after]: [usize; 3], other: usize) -> bool {
        let point = self.points[other];
        if point == self.points[before] || point == self.points[after] {
            return false;
        }
        if point == self.points[tip] {
            let mut ends = [ring.before[other], ring.after[other]].into_iter();
            return ends
                .any(|end| self.turn(before, tip, end) > 0.0 && self.turn(tip, after, end) > 0.0);
        }
        let sides = [(before, tip), (tip, after), (after, before)];
        sides
            .into_iter()
            .all(|(from, to)| self.turn(from, to, other) >= 0.0)
    }
}
