//! Triangles of faces: fans, or ears cut in the plane of the face.

use glam::{DVec3, Vec3};

/// Largest error of corners in files, as a part of a face's perimeter. Thin faces cross themselves by as much.
const ERROR_IN_FILES: f64 = 1e-5;

/// Largest distance of a corner from the plane of a flat quad, as a part of its perimeter.
const FLATNESS: f64 = 1e-4;

/// Cuts a face into triangles, as numbers of its corners.
///
/// A fan from the first corner serves if it covers the face once, as it does for every convex face. Else ears are cut, in the
/// plane of the two axes that shows most of the face. Returns none if the face crosses itself there: no triangles between its
/// corners cover what it surrounds. A twisted quad only seems to cross itself; like other readers, it gets a fan.
pub(super) fn triangulate(corners: &[Vec3]) -> Option<Vec<[u32; 3]>> {
    let fan = (2..corners.len() as u32).map(|last| [0, last - 1, last]);
    let fan: Vec<[u32; 3]> = fan.collect();
    if fan.len() == 1 {
        return Some(fan);
    }
    let outline = Outline::new(corners);
    let misfit = outline.misfit(&fan);
    if misfit <= outline.rounding * outline.perimeter {
        return Some(fan);
    }
    let tolerance = outline.error * outline.perimeter;
    if let Some(ears) = outline.cut_ears()
        && outline.misfit(&ears) < misfit.min(tolerance)
        && !outline.crosses_itself()
    {
        return Some(ears);
    }
    let is_usable = misfit <= tolerance || is_twisted(corners);
    is_usable.then_some(fan)
}

/// Returns whether a face is a quad whose corners are not in one plane.
fn is_twisted(corners: &[Vec3]) -> bool {
    let &[a, b, c, d] = corners else {
        return false;
    };
    let [ab, ac, ad] = [b, c, d].map(|corner| corner.as_dvec3() - a.as_dvec3());
    let [first, second] = [ab.cross(ac), ac.cross(ad)];
    let normal = if first.length() < second.length() {
        second
    } else {
        first
    };
    let up = normal.normalize_or_zero();
    let height = ab.dot(up).abs().max(ad.dot(up).abs());
    let size = ab.length() + (ac - ab).length() + (ad - ac).length() + ad.length();
    height > FLATNESS * size
}

/// Corners of a face in a plane, counterclockwise.
struct Outline {
    points: Vec<robust::Coord<f64>>,
    /// Twice the area, counted once for each turn around it.
    area: f64,
    perimeter: f64,
    /// Rounding of coordinates to 32 bits.
    rounding: f64,
    /// Largest error of corners.
    error: f64,
}

/// Corners that are left while ears are cut, each with its neighbours.
struct Ring {
    before: Vec<usize>,
    after: Vec<usize>,
}

impl Outline {
    fn new(corners: &[Vec3]) -> Self {
        let corners: Vec<DVec3> = corners.iter().map(|corner| corner.as_dvec3()).collect();
        let spans = corners[1..].windows(2);
        let normals = spans.map(|pair| (pair[0] - corners[0]).cross(pair[1] - corners[0]));
        // Newell's normal: its length is twice the area.
        let mut normal: DVec3 = normals.clone().sum();
        if normal == DVec3::ZERO {
            normal = normals.map(DVec3::abs).sum();
        }
        let across = normal.abs().max_position();
        let [right, up] = [(across + 1) % 3, (across + 2) % 3];
        let point = |corner: &DVec3| robust::Coord {
            x: corner[right] * normal[across].signum(),
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
        outline
    }

    /// Twice the area of a triangle; negative if it is clockwise. Its sign is exact.
    fn turn(&self, a: usize, b: usize, c: usize) -> f64 {
        let [a, b, c] = [a, b, c].map(|corner| self.points[corner]);
        robust::orient2d(a, b, c)
    }

    /// Twice the area that triangles cover more than once, or miss.
    fn misfit(&self, triangles: &[[u32; 3]]) -> f64 {
        let turn = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|corner| corner as usize);
            self.turn(a, b, c).abs()
        };
        (triangles.iter().map(turn).sum::<f64>() - self.area).abs()
    }

    /// Returns whether two sides cross each other, by more than errors of corners.
    fn crosses_itself(&self) -> bool {
        let count = self.points.len();
        let crosses = |first: usize, second: usize| {
            let [a, b] = [first, (first + 1) % count];
            let [c, d] = [second, (second + 1) % count];
            self.divides([a, b], [c, d]) && self.divides([c, d], [a, b])
        };
        (0..count).any(|first| (first + 2..count).any(|second| crosses(first, second)))
    }

    /// Returns whether the line of one side has the ends of another on its two sides.
    fn divides(&self, [from, to]: [usize; 2], ends: [usize; 2]) -> bool {
        let [a, b] = [from, to].map(|corner| self.points[corner]);
        let [c, d] = ends.map(|end| self.turn(from, to, end));
        c * d < 0.0 && c.abs().min(d.abs()) > self.error * (b.x - a.x).hypot(b.y - a.y)
    }

    /// Cuts one ear after the other: a corner that turns left, with no other corner in its triangle. Returns none if there is
    /// none, because the outline crosses itself.
    fn cut_ears(&self) -> Option<Vec<[u32; 3]>> {
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
            let is_ear = match cuts_straight {
                true => self.turn(before, corner, after) == 0.0,
                false => self.is_ear(&ring, corner),
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
    /// A face with a hole touches itself, because a side leads to the hole and back. There, corners lie on corners.
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
