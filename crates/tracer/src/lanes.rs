//! Eight boxes or eight triangles at a time: with AVX2 and FMA where the processor has them, else one by one.
//!
//! Both ways only *reject*, and only what is certainly missed; whatever they let pass is decided by the same scalar
//! code. Hits, and with them all bytes, are therefore the same on every path.

use glam::DVec3;

/// Children of a node.
pub(crate) const WIDTH: usize = 8;
/// Triangles of a leaf.
pub(crate) const LEAF: usize = 8;

/// Eight boxes side by side: per axis the least and the greatest coordinates, metres. Unused lanes are empty boxes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Boxes(pub [[[f32; WIDTH]; 2]; 3]);

/// Eight triangles side by side: per vertex and axis. Unused lanes repeat the first triangle.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Triangles(pub [[[f32; LEAF]; 3]; 3]);

/// A ray as boxes want it: `t = scale * plane + offset` is where it crosses a plane, in units of its direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SlabRay {
    scale: [f32; 3],
    /// For planes through which the ray enters and leaves; the first a little early, the second a little late.
    offsets: [[f32; 3]; 2],
    /// Per axis, which side of a box is met first: 0 the least, 1 the greatest.
    first: [usize; 3],
}

/// A ray as triangles want it: seen along its direction, every vertex has a place in the plane across the ray's longest
/// axis, and the ray is the plane's origin (the shear of Woop, Benthin and Wald 2013).
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeRay {
    /// The two axes of the plane, then the one along which the direction is longest.
    axes: [usize; 3],
    /// What the ray goes along the plane's axes for one metre along the third.
    shear: [f32; 2],
    /// Where its line meets the plane through the world's origin, metres.
    foot: [f32; 2],
    /// How far from its true place rounding may have moved a vertex, metres.
    doubt: f32,
}

/// Boxes are grown by this fraction of the greatest coordinate involved, for each ray by its own. The test runs in `f32`:
/// plane, origin, direction, its inverse, their product, the sum and the limit are each rounded by 6e-8 of at most a few
/// times that coordinate, about 1e-6 together. A hit at exactly the limit is therefore still visited, and the caller
/// decides ties.
const PAD: f64 = 2e-6;
/// As a part of the greatest coordinate involved: a vertex's place is rounded five times, each time by 6e-8 of at most three
/// times that coordinate.
const EDGE_PAD: f64 = 1e-6;
/// Squares of greater coordinates, metres, are not numbers of 32 bits: nothing is rejected there.
const GREATEST_SQUARED: f64 = 1e18;
/// A smaller part of a direction has no finite inverse worth having: over the size of a scene it leads nowhere.
const LEAST_DIRECTION: f32 = 1e-18;

/// A way to test several things at once.
pub(crate) trait Lanes: Copy {
    /// Runs `work` with the processor's features switched on for whatever is inlined into it.
    fn run<R>(self, work: impl FnOnce() -> R) -> R;

    /// One bit per box that the ray may enter at a distance of at most `limit`, and the distances.
    fn enter(self, boxes: &Boxes, ray: &SlabRay, limit: f32) -> (u32, [f32; WIDTH]);

    /// One bit per triangle whose plane the ray's line may cross inside it.
    /// `size` is the greatest extent of any of them along an axis, metres.
    fn cross(self, triangles: &Triangles, size: f32, ray: &EdgeRay) -> u32;
}

/// One by one.
#[derive(Clone, Copy)]
pub(crate) struct Portable;

impl SlabRay {
    /// For boxes whose coordinates are at most `reach` metres.
    #[inline(always)]
    pub fn new(origin: DVec3, direction: DVec3, reach: f64) -> Self {
        let pad = (PAD * reach.max(origin.abs().max_element())) as f32;
        let direction = direction.as_vec3().to_array();
        let origin = origin.as_vec3().to_array();
        let scale = direction.map(|d| {
            1.0 / if d.abs() < LEAST_DIRECTION {
                LEAST_DIRECTION.copysign(d)
            } else {
                d
            }
        });
        Self {
            scale,
            offsets: [-pad, pad].map(|pad| {
                std::array::from_fn(|axis| -origin[axis] * scale[axis] + pad * scale[axis].abs())
            }),
            first: scale.map(|scale| usize::from(scale < 0.0)),
        }
    }
}

impl EdgeRay {
    /// For triangles whose coordinates are at most `reach` metres.
    #[inline(always)]
    pub fn new(origin: DVec3, direction: DVec3, reach: f64) -> Self {
        let [o, d] = [origin, direction].map(|vector| vector.to_array());
        let longest = direction.abs().max_position();
        let axes = [(longest + 1) % 3, (longest + 2) % 3, longest];
        let along = 1.0 / d[longest];
        let shear = [d[axes[0]] * along, d[axes[1]] * along];
        let greatest = reach.max(origin.abs().max_element());
        Self {
            axes,
            shear: shear.map(|shear| shear as f32),
            foot: [0, 1].map(|axis| (o[axes[axis]] - shear[axis] * o[longest]) as f32),
            doubt: if greatest < GREATEST_SQUARED {
                (EDGE_PAD * greatest) as f32 
            } else {
                f32::INFINITY
            },
        }
    }

    /// How far from 0 rounding may have moved a weight of a triangle of this size that the ray does cross. Its vertices lie
    /// within twice the size of the ray, and each of a product's four factors errs by `doubt`.
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
        (0..LEAF)
            .map(|lane| {
                let [a, b, c] = places.map(|place| place.map(|axis| axis[lane]));
                let weights = [(c, b), (a, c), (b, a)].map(|(p, q)| p[0] * q[1] - p[1] * q[0]);
                let least = weights[0].min(weights[1]).min(weights[2]);
                let greatest = weights[0].max(weights[1]).max(weights[2]);
                u32::from(!(least < -doubt && greatest > doubt)) << lane
            })
            .sum()
    }
}

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use std::arch::x86_64::{__m256, _CMP_LE_OQ, _CMP_NGT_UQ, _CMP_NLT_UQ};

    use pulp::cast;
    use pulp::x86::V3;

    use super::{Boxes, EdgeRay, LEAF, Lanes, SlabRay, Triangles, WIDTH};

    /// AVX2 and FMA; a value of this type is proof that the processor has them.
    #[derive(Clone, Copy)]
    pub(crate) struct Avx2(V3);

    impl Avx2 {
        /// None where the processor lacks them.
        pub fn detect() -> Option<Self> {
            V3::try_new().map(Self)
        }

        /// Where the ray enters (end 0) or leaves (end 1) the space between eight pairs of planes.
        #[inline(always)]
        fn planes(self, boxes: &Boxes, ray: &SlabRay, axis: usize, end: usize) -> __m256 {
            let Self(V3 { avx, fma, .. }) = self;
            let side = ray.first[axis] ^ end;
            fma._mm256_fmadd_ps(
                cast(boxes.0[axis][side]),
                avx._mm256_set1_ps(ray.scale[axis]),
                avx._mm256_set1_ps(ray.offsets[end][axis]),
            )
        }

        /// Where vertices lie, seen along the ray.
        #[inline(always)]
        fn place(self, vertex: &[[f32; LEAF]; 3], ray: &EdgeRay) -> [__m256; 2] {
            let along = cast(vertex[ray.axes[2]]);
            [
                self.coordinate(cast(vertex[ray.axes[0]]), along, ray.foot[0], ray.shear[0]),
                self.coordinate(cast(vertex[ray.axes[1]]), along, ray.foot[1], ray.shear[1]),
            ]
        }

        #[inline(always)]
        fn coordinate(self, across: __m256, along: __m256, foot: f32, shear: f32) -> __m256 {
            let Self(V3 { avx, fma, .. }) = self;
            let from_foot = avx._mm256_sub_ps(across, avx._mm256_set1_ps(foot));
            fma._mm256_fnmadd_ps(along, avx._mm256_set1_ps(shear), from_foot)
        }

        /// p x q
        #[inline(always)]
        fn weight(self, p: [__m256; 2], q: [__m256; 2]) -> __m256 {
            let Self(V3 { avx, fma, .. }) = self;
            fma._mm256_fmsub_ps(p[0], q[1], avx._mm256_mul_ps(p[1], q[0]))
        }
    }

    impl Lanes for Avx2 {
        #[inline(always)]
        fn run<R>(self, work: impl FnOnce() -> R) -> R {
            self.0.vectorize(work)
        }

        #[inline(always)]
        fn enter(self, boxes: &Boxes, ray: &SlabRay, limit: f32) -> (u32, [f32; WIDTH]) {
            let avx = self.0.avx;
            let near = avx._mm256_max_ps(
                avx._mm256_max_ps(self.planes(boxes, ray, 0, 0), self.planes(boxes, ray, 1, 0)),
                avx._mm256_max_ps(self.planes(boxes, ray, 2, 0), avx._mm256_setzero_ps()),
            );
            let far = avx._mm256_min_ps(
                avx._mm256_min_ps(self.planes(boxes, ray, 0, 1), self.planes(boxes, ray, 1, 1)),
                avx._mm256_min_ps(self.planes(boxes, ray, 2, 1), avx._mm256_set1_ps(limit)),
            );
            let entered = avx._mm256_cmp_ps::<_CMP_LE_OQ>(near, far);
            (avx._mm256_movemask_ps(entered) as u32, cast(near))
        }

        #[inline(always)]
        fn cross(self, triangles: &Triangles, size: f32, ray: &EdgeRay) -> u32 {
            let avx = self.0.avx;
            let [a, b, c] = [
                self.place(&triangles.0[0], ray),
                self.place(&triangles.0[1], ray),
                self.place(&triangles.0[2], ray),
            ];
            let [u, v, w] = [self.weight(c, b), self.weight(a, c), self.weight(b, a)];
            let least = avx._mm256_min_ps(avx._mm256_min_ps(u, v), w);
            let greatest = avx._mm256_max_ps(avx._mm256_max_ps(u, v), w);
            let doubt = ray.doubt(size);
            // What is not a number is not rejected.
            let inside = avx._mm256_or_ps(
                avx._mm256_cmp_ps::<_CMP_NLT_UQ>(least, avx._mm256_set1_ps(-doubt)),
                avx._mm256_cmp_ps::<_CMP_NGT_UQ>(greatest, avx._mm256_set1_ps(doubt)),
            );
            avx._mm256_movemask_ps(inside) as u32
        }
    }
}

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::Avx2;
