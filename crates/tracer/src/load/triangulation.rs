//! Triangles of faces: fans, or ears cut in the plane of the face.

use glam::{DVec3, Vec3};

use super::outline::{Crossing, Outline};

/// Largest distance of a corner from a flat face's plane, as a part of its perimeter.
const FLATNESS: f64 = 1e-4;

/// Triangles of a face, as numbers of its corners.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Cut {
    pub(super) triangles: Vec<[u32; 3]>,
    /// Corners that the face does not have, numbered on from its last.
    pub(super) crossings: Vec<Crossing>,
}

/// Cuts a face into triangles.
///
/// A fan from the first corner serves if it covers the face once, as it does for every convex face. Else ears are cut, in the
/// plane of the two axes that shows most of the face. A face that crosses itself is divided there. A twisted quad only seems to
/// cross itself; like other readers, it gets a fan. Returns none for other faces that cross themselves outside of their plane.
pub(super) fn triangulate(corners: &[Vec3]) -> Option<Cut> {
    let mut points: Vec<DVec3> = corners.iter().map(|corner| corner.as_dvec3()).collect();
    let mut cut = Cut::default();
    let mut outlines: Vec<Vec<u32>> = vec![(0..corners.len() as u32).collect()];
    while let Some(numbers) = outlines.pop() {
        let outline_points: Vec<DVec3> = numbers
            .iter()
            .map(|number| points[*number as usize])
            .collect();
        let outline = Outline::new(&outline_points);
        if let Some(triangles) = cut_simple(&outline, &outline_points) {
            let numbered = triangles
                .iter()
                .map(|t| t.map(|corner| numbers[corner as usize]));
            cut.triangles.extend(numbered);
            continue;
        }
        let (first, second) = outline.find_crossing()?;
        let point = first.point(&outline_points);
        let gap = point.distance(second.point(&outline_points));
        if gap > FLATNESS * outline.perimeter || cut.crossings.len() > corners.len() {
            return None;
        }
        // One outline goes on along the second side, the other returns to the first.
        let [near, far] = [first, second].map(|crossing| crossing.ends.map(|end| end as usize));
        let crossing = points.len() as u32;
        let between = &numbers[near[1]..=far[0]];
        outlines.push([&[crossing], between].concat());
        let around = [&[crossing], &numbers[far[0] + 1..], &numbers[..=near[0]]];
        outlines.push(around.concat());
        points.push(point);
        let ends = near.map(|end| numbers[end]);
        cut.crossings.push(Crossing { ends, ..first });
    }
    Some(cut)
}

/// Cuts an outline that does not cross itself, or by no more than rounding.
fn cut_simple(outline: &Outline, points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
    let fan = (2..points.len() as u32).map(|last| [0, last - 1, last]);
    let fan: Vec<[u32; 3]> = fan.collect();
    let misfit = outline.misfit(&fan);
    if fan.len() == 1 || misfit <= outline.rounding * outline.perimeter {
        return Some(fan);
    }
    let tolerance = outline.error * outline.perimeter;
    if let Some(ears) = outline.cut_ears()
        && outline.misfit(&ears) < misfit.min(tolerance)
        && outline.find_crossing().is_none()
    {
        return Some(ears);
    }
    let is_usable = misfit <= tolerance || is_twisted(points, outline.perimeter);
    is_usable.then_some(fan)
}

/// Returns whether an outline is a quad with corners outside of one plane.
fn is_twisted(points: &[DVec3], perimeter: f64) -> bool {
    let &[a, b, c, d] = points else {
        return false;
    };
    let [ab, ac, ad] = [b, c, d].map(|corner| corner - a);
    let [first, second] = [ab.cross(ac), ac.cross(ad)];
    let normal = if first.length() < second.length() {
        second
    } else {
        first
    };
    let up = normal.normalize_or_zero();
    ab.dot(up).abs().max(ad.dot(up).abs()) > FLATNESS * perimeter
}
