//! Triangles of faces: fans, or ears cut in the plane of the face.

use glam::{DVec3, Vec3};

use super::outline::{Crossing, Outline};

/// Largest distance of a corner from a flat quad's plane, as a part of its perimeter.
const FLATNESS: f64 = 1e-4;

/// Triangles of faces, as numbers of corners.
#[derive(Debug, Default)]
pub(super) struct Cut {
    pub(super) triangles: Vec<[u32; 3]>,
    /// Corners that the faces do not have, numbered on from the last.
    pub(super) crossings: Vec<Crossing>,
}

/// Cuts a face into triangles.
///
/// A fan from the first corner serves if it covers the face once, as it does for every convex face.
/// Else ears are cut, in the plane of the two axes that shows most of the face. A quad that crosses
/// itself becomes two triangles from the crossing. A twisted quad only seems to cross itself; like
/// other readers, it gets a fan. Returns none for other faces that cross themselves.
pub(super) fn triangulate(corners: &[Vec3]) -> Option<Cut> {
    let points: Vec<DVec3> = corners.iter().map(|corner| corner.as_dvec3()).collect();
    let outline = Outline::new(&points);
    if let Some(triangles) = cut_simple(&outline, &points) {
        let crossings = Vec::new();
        return Some(Cut {
            triangles,
            crossings,
        });
    }
    let crossing = outline.find_crossing().filter(|_| points.len() == 4)?;
    let [from, to] = crossing.ends;
    let next = (to + 1) % 4;
    Some(Cut {
        triangles: vec![[4, to, next], [4, (next + 1) % 4, from]],
        crossings: vec![crossing],
    })
}

/// Cuts an outline that does not cross itself, or by no more than rounding.
fn cut_simple(outline: &Outline, points: &[DVec3]) -> Option<Vec<[u32; 3]>> {
    let fan = (2..points.len() as u32).map(|last| [0, last - 1, last]);
    let fan: Vec<[u32; 3]> = fan.collect();
    let misfit = if outline.surrounds_first() {
        f64::INFINITY
    } else {
        outline.misfit(&fan)
    };
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
