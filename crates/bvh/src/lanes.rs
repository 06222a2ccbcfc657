//! Tests of sixteen boxes or eight triangles at once, with AVX2 and FMA or portably.
//!
//! The portable tests serve processors without AVX2, ARM among them, and are the reference in tests
//! of the others. Both only *reject*, and only what a ray certainly misses. Everything else is
//! decided by the same scalar code, so hits, and with them all bytes of a picture, do not depend on
//! the processor.

#[cfg(target_arch = "x86_64")]
mod avx2;

use glam::{DVec3, Vec3};

#[cfg(target_arch = "x86_64")]
pub use avx2::Avx2;

/// Children of a node.
pub const WIDTH: usize = 16;
/// Triangles of a leaf.
pub const LEAF: usize = 8;

/// Sixteen boxes side by side: per axis the least and the greatest coordinates, metres. Unused
/// lanes are empty boxes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Boxes(pub [[[f32; WIDTH]; 2]; 3]);

/// Eight triangles side by side: per vertex and axis. Unused lanes repeat the first triangle.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub struct Triangles(pub [[[f32; LEAF]; 3]; 3]);

/// A ray prepared for boxes: it crosses a plane at `t = scale * plane + offset`, in units of its
/// direction.
#[derive(Clone, Copy, Debug)]
pub struct SlabRay {
    scale: [f32; 3],
    /// Offsets for planes through which the ray enters, a little too early, and leaves, a little
    /// too late.
    offsets: [[f32; 3]; 2],
    /// Per axis, the side of a box that is met first: 0 the least, 1 the greatest.
    first: [usize; 3],
}

/// A ray prepared for triangles: a shear moves every vertex along the ray into the plane across the
/// ray's longest axis, with the ray at the plane's origin (Woop, Benthin and Wald 2013).
#[derive(Clone, Copy, Debug)]
pub struct EdgeRay {
    /// The two axes of the plane, then the one along which the direction is longest.
    axes: [usize; 3],
    /// Slope of the ray along the plane's axes, per metre along the third.
    shear: [f32; 2],
    /// Point where its line meets the plane through the world's origin, metres.
    foot: [f32; 2],
    /// Greatest rounding error of a vertex's place, metres.
    doubt: f32,
}

/// Part of the greatest coordinate involved by which each ray grows the boxes.
///
/// The test runs in `f32`: plane, origin, direction, its inverse, their product, the sum and the
/// limit are each rounded by 6e-8 of at most a few times that coordinate, about 1e-6 together. A
/// hit at exactly the limit is therefore still visited, and the caller decides ties.
const PAD: f64 = 2e-6;
/// Rounding error of a vertex's place, as a part of the greatest coordinate involved: five
/// roundings, each of 6e-8 of at most three times that coordinate.
const EDGE_PAD: f64 = 1e-6;
/// Coordinate, in metres, beyond which squares overflow 32 bits and nothing is rejected.
const GREATEST_SQUARED: f64 = 1e18;
/// Least component of a direction: a smaller one has no finite inverse, and over a scene it leads
/// nowhere.
const LEAST_DIRECTION: f32 = 1e-18;

/// Instructions that test several boxes or triangles at once.
pub trait Lanes: Copy {
    /// Runs `work` with the processor's features switched on for whatever is inlined into it.
    fn run<R>(self, work: impl FnOnce() -> R) -> R;

    /// One bit per box that the ray may enter at a distance of at most `limit`, and the distances.
    fn enter(self, boxes: &Boxes, ray: &SlabRay, limit: f32) -> (u32, [f32; WIDTH]);

    /// One bit per triangle whose plane the ray's line may cross inside it.
    /// `size` is the greatest extent of any of them along an axis, metres.
    fn cross(self, triangles: &Triangles, size: f32, ray: &EdgeRay) -> u32;
}

/// Plain Rust for any processor.
#[derive(Clone, Copy)]
pub struct Portable;

impl SlabRay {
    /// Prepares a ray for boxes of coordinates up to `largest_coordinate`, in metres.
    #[inline(always)]
    pub fn new(origin: DVec3, direction: DVec3, largest_coordinate: f64) -> Self {
        let pad = (PAD * largest_coordinate.max(origin.abs().max_element())) as f32;
        let scale = 1.0
            / Vec3::select(
                direction
                    .as_vec3()
                    .abs()
                    .cmplt(Vec3::splat(LEAST_DIRECTION)),
                Vec3::splat(LEAST_DIRECTION).copysign(direction.as_vec3()),
                direction.as_vec3(),
            );
        let centre = -origin.as_vec3() * scale;
        let margin = pad * scale.abs();
        let is_backwards = scale.cmplt(Vec3::ZERO);
        Self {
            scale: scale.to_array(),
            offsets: [(centre - margin).to_array(), (centre + margin).to_array()],
            first: [
                usize::from(is_backwards.test(0)),
                usize::from(is_backwards.test(1)),
                usize::from(is_backwards.test(2)),
            ],
        }
    }
}

impl EdgeRay {
    /// Prepares a ray for triangles of coordinates up to `largest_coordinate`, in metres.
    #[inline(always)]
    pub fn new(origin: DVec3, direction: DVec3, largest_coordinate: f64) -> Self {
        let [o, d] = [origin.to_array(), direction.to_array()];
        let longest = direction.abs().max_position();
        let axes = [(longest + 1) % 3, (longest + 2) % 3, longest];
        let along = 1.0 / d[longest];
        let shear = [d[axes[0]] * along, d[axes[1]] * along];
        let greatest = largest_coordinate.max(origin.abs().max_element());
        Self {
            axes,
            shear: [shear[0] as f32, shear[1] as f32],
            foot: [
                (o[axes[0]] - shear[0] * o[longest]) as f32,
                (o[axes[1]] - shear[1] * o[longest]) as f32,
            ],
            doubt: if greatest < GREATEST_SQUARED {
                (EDGE_PAD * greatest) as f32
            } else {
                f32::INFINITY
            },
        }
    }

    /// The greatest rounding error of a weight of a triangle of this size that the ray crosses. The
    /// triangle's vertices lie within twice the size of the ray, and each of a product's four
    /// factors errs by `doubt`.
    #[inline(always)]
    fn doubt(&self, size: f32) -> f32 {
        16.0 * self.doubt * (size + self.doubt) + f32::MIN_POSITIVE
    }
}

impl Lanes for Portable {
    #[inline(always)]
    fn run<R>(self, work: impl FnOnce() -> R) -> R {
        work()
    }

    #[inline(always)]
    fn enter(self, boxes: &Boxes, ray: &SlabRay, limit: f32) -> (u32, [f32; WIDTH]) {
        let mut near = [0.0_f32; WIDTH];
        let mut far = [limit; WIDTH];
        for axis in 0..3 {
            let first = ray.first[axis];
            for lane in 0..WIDTH {
                let at = |side: usize, end: usize| {
                    ray.scale[axis] * boxes.0[axis][side][lane] + ray.offsets[end][axis]
                };
                near[lane] = near[lane].max(at(first, 0));
                far[lane] = far[lane].min(at(1 - first, 1));
            }
        }
        let mask = (0..WIDTH)
            .map(|lane| u32::from(near[lane] <= far[lane]) << lane)
            .sum();
        (mask, near)
    }

    #[inline(always)]
    fn cross(self, triangles: &Triangles, size: f32, ray: &EdgeRay) -> u32 {
        let doubt = ray.doubt(size);
        let places = triangles.0.map(|vertex| {
            let [x, y, along] = ray.axes.map(|axis| vertex[axis]);
            [(x, 0), (y, 1)].map(|(across, axis)| -> [f32; LEAF] {
                std::array::from_fn(|lane| {
                    across[lane] - ray.foot[axis] - ray.shear[axis] * along[lane]
                })
            })
        });
        let [a, b, c] = &places;
        let weight = |p: &[[f32; LEAF]; 2], q: &[[f32; LEAF]; 2]| -> [f32; LEAF] {
            std::array::from_fn(|lane| p[0][lane] * q[1][lane] - p[1][lane] * q[0][lane])
        };
        let [u, v, w] = [weight(c, b), weight(a, c), weight(b, a)];
        // Written so that compilers vectorise it.
        let pick = |first: bool, p: f32, q: f32| if first { p } else { q };
        let least: [f32; LEAF] = std::array::from_fn(|lane| {
            let least = pick(u[lane] < v[lane], u[lane], v[lane]);
            pick(least < w[lane], least, w[lane])
        });
        let greatest: [f32; LEAF] = std::array::from_fn(|lane| {
            let greatest = pick(u[lane] > v[lane], u[lane], v[lane]);
            pick(greatest > w[lane], greatest, w[lane])
        });
        (0..LEAF)
            .map(|lane| u32::from(!(least[lane] < -doubt && greatest[lane] > doubt)) << lane)
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ray::Ray;
    use crate::triangle::cross;

    /// R2 points (Roberts 2018), rotated per dimension, in [-1, 1).
    fn number(index: usize, dimension: usize) -> f64 {
        const STEPS: [f64; 3] = [0.819_172_5, 0.671_043_6, 0.549_700_5];
        let part = index as f64 * STEPS[dimension % 3] + dimension as f64 * 0.37;
        2.0 * part.fract() - 1.0
    }

    fn point(index: usize, dimension: usize) -> DVec3 {
        DVec3::from_array([0, 1, 2].map(|axis| number(index, dimension + axis)))
    }

    /// Eight triangles of this size around places up to a metre from the world's origin, and the
    /// size that a leaf stores.
    fn triangles(index: usize, size: f64) -> ([[DVec3; 3]; LEAF], Triangles, f32) {
        let corners: [[DVec3; 3]; LEAF] = std::array::from_fn(|lane| {
            let centre = point(LEAF * index + lane, 0);
            [3, 7, 11].map(|dimension| {
                let corner = centre + size * point(LEAF * index + lane, dimension);
                corner.as_vec3().as_dvec3()
            })
        });
        let lanes = Triangles(std::array::from_fn(|vertex| {
            std::array::from_fn(|axis| corners.map(|corners| corners[vertex][axis] as f32))
        }));
        let extent = |[a, b, c]: [DVec3; 3]| (a.max(b).max(c) - a.min(b).min(c)).max_element();
        let greatest = corners.map(extent).into_iter().fold(0.0, f64::max) as f32;
        (corners, lanes, greatest.next_up())
    }

    /// The lanes that each instruction set lets pass; they may differ in triangles that the exact
    /// test refuses.
    fn let_through(lanes: &Triangles, size: f32, ray: &EdgeRay) -> Vec<u32> {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx2) = Avx2::detect() {
            let wide = avx2.run(|| avx2.cross(lanes, size, ray));
            return vec![Portable.cross(lanes, size, ray), wide];
        }
        vec![Portable.cross(lanes, size, ray)]
    }

    #[test]
    fn what_the_exact_test_accepts_is_never_rejected() {
        let mut accepted = 0;
        for index in 0..20_000 {
            // From a third of the distance to a millionth of it.
            let size = 0.3_f64.powi(1 + index as i32 % 12);
            let (corners, lanes, extent) = triangles(index, size);
            let aimed = corners[index % LEAF];
            // At an edge, whose ends are vertices; past the target as far as to it.
            let along = number(index, 15).abs().min(1.2 * number(index, 16).abs());
            let target = aimed[0] + along * (aimed[1] - aimed[0]);
            let origin = 3.0 * point(index, 20);
            let direction = (target - origin) * 10.0_f64.powi(index as i32 % 7 - 3);
            let rays = EdgeRay::new(origin, direction, 2.0);
            for passed in let_through(&lanes, extent, &rays) {
                for (lane, corners) in corners.into_iter().enumerate() {
                    if cross(&Ray { origin, direction }, corners).is_some() {
                        accepted += 1;
                        assert_eq!(passed >> lane & 1, 1, "triangle {lane} of {index}");
                    }
                }
            }
        }
        assert!(accepted > 10_000, "only {accepted} rays met a triangle");
    }

    #[test]
    fn what_is_missed_by_a_twentieth_of_its_size_is_rejected() {
        for index in 0..2000 {
            let size = 0.01;
            let (corners, lanes, extent) = triangles(index, size);
            let [a, b, c] = corners[0];
            let normal = (b - a).cross(c - a);
            // A weight is the edge's length times the distance from it: 5e-6 before the shear. The
            // doubt is 16 times a size of 0.02 times the rounding of coordinates of at most 2.5:
            // 8e-7.
            if a.distance(b) < size || normal.length() < 0.1 * size * size {
                continue;
            }
            let outwards = (b - a).cross(normal).normalize();
            let target = 0.5 * (a + b) + 0.05 * size * outwards;
            let origin = target + normal.normalize() + 0.3 * point(index, 20);
            let ray = EdgeRay::new(origin, target - origin, 2.0);
            for passed in let_through(&lanes, extent, &ray) {
                assert_eq!(passed & 1, 0, "the first triangle of {index}");
            }
        }
    }
}
