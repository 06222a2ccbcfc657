//! Eight boxes or four triangles at a time: with AVX2 and FMA where the processor has them, else one by one.
//!
//! Both ways only *reject*, and only what is certainly missed; whatever they let pass is decided by the same scalar
//! code. Hits, and with them all bytes, are therefore the same on every path.

use glam::DVec3;

/// Children of a node.
pub(crate) const WIDTH: usize = 8;
/// Triangles of a leaf.
pub(crate) const LEAF: usize = 4;

/// Eight boxes side by side: per axis the least and the greatest coordinates, metres. Unused lanes are empty boxes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(crate) struct Boxes(pub [[[f32; WIDTH]; 2]; 3]);

/// Four triangles side by side: per vertex and axis. Unused lanes repeat the first triangle.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
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

/// A ray as triangles want it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EdgeRay {
    origin: [f64; 3],
    direction: [f64; 3],
    /// Weights this close to 0 are in doubt.
    doubt: f64,
}

/// Boxes are grown by this fraction of the greatest coordinate involved, for each ray by its own. The test runs in `f32`:
/// plane, origin, direction, its inverse, their product, the sum and the limit are each rounded by 6e-8 of at most a few
/// times that coordinate, about 1e-6 together. A hit at exactly the limit is therefore still visited, and the caller
/// decides ties.
const PAD: f64 = 2e-6;
/// A smaller part of a direction has no finite inverse worth having: over the size of a scene it leads nowhere.
const LEAST_DIRECTION: f32 = 1e-18;

/// A way to test several things at once.
pub(crate) trait Lanes: Copy {
    /// Runs `work` with the processor's features switched on for whatever is inlined into it.
    fn run<R>(self, work: impl FnOnce() -> R) -> R;

    /// One bit per box that the ray may enter at a distance of at most `limit`, and the distances.
    fn enter(self, boxes: &Boxes, ray: &SlabRay, limit: f32) -> (u32, [f32; WIDTH]);

    /// One bit per triangle whose plane the ray's line may cross inside it.
    fn cross(self, triangles: &Triangles, ray: &EdgeRay) -> u32;
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
    /// `doubt`: how far from 0 rounding may have moved a weight.
    #[inline(always)]
    pub fn new(origin: DVec3, direction: DVec3, doubt: f64) -> Self {
        Self {
            origin: origin.to_array(),
            direction: direction.to_array(),
            doubt,
        }
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
    fn cross(self, triangles: &Triangles, ray: &EdgeRay) -> u32 {
        (0..LEAF)
            .map(|lane| {
                let [a, b, c] = triangles.0.map(|vertex| {
                    DVec3::from_array(std::array::from_fn(|axis| {
                        f64::from(vertex[axis][lane]) - ray.origin[axis]
                    }))
                });
                let direction = DVec3::from_array(ray.direction);
                let weights =
                    [c.cross(b), a.cross(c), b.cross(a)].map(|normal| normal.dot(direction));
                let least = weights[0].min(weights[1]).min(weights[2]);
                let greatest = weights[0].max(weights[1]).max(weights[2]);
                u32::from(least >= -ray.doubt || greatest <= ray.doubt) << lane
            })
            .sum()
    }
}

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use std::arch::x86_64::{__m128, __m256, __m256d, _CMP_GE_OQ, _CMP_LE_OQ};

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

        /// Vertices as seen from the ray's origin.
        #[inline(always)]
        fn corner(self, vertex: &[[f32; LEAF]; 3], ray: &EdgeRay) -> [__m256d; 3] {
            [
                self.coordinate(vertex[0], ray.origin[0]),
                self.coordinate(vertex[1], ray.origin[1]),
                self.coordinate(vertex[2], ray.origin[2]),
            ]
        }

        #[inline(always)]
        fn coordinate(self, lanes: [f32; LEAF], origin: f64) -> __m256d {
            let avx = self.0.avx;
            let lanes: __m128 = cast(lanes);
            avx._mm256_sub_pd(avx._mm256_cvtps_pd(lanes), avx._mm256_set1_pd(origin))
        }

        /// p x q . direction
        #[inline(always)]
        fn weight(self, p: [__m256d; 3], q: [__m256d; 3], direction: [__m256d; 3]) -> __m256d {
            let Self(V3 { avx, fma, .. }) = self;
            let x = fma._mm256_fmsub_pd(p[1], q[2], avx._mm256_mul_pd(p[2], q[1]));
            let y = fma._mm256_fmsub_pd(p[2], q[0], avx._mm256_mul_pd(p[0], q[2]));
            let z = fma._mm256_fmsub_pd(p[0], q[1], avx._mm256_mul_pd(p[1], q[0]));
            let sum = fma._mm256_fmadd_pd(y, direction[1], avx._mm256_mul_pd(z, direction[2]));
            fma._mm256_fmadd_pd(x, direction[0], sum)
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
        fn cross(self, triangles: &Triangles, ray: &EdgeRay) -> u32 {
            let avx = self.0.avx;
            let [a, b, c] = [
                self.corner(&triangles.0[0], ray),
                self.corner(&triangles.0[1], ray),
                self.corner(&triangles.0[2], ray),
            ];
            let direction = [
                avx._mm256_set1_pd(ray.direction[0]),
                avx._mm256_set1_pd(ray.direction[1]),
                avx._mm256_set1_pd(ray.direction[2]),
            ];
            let u = self.weight(c, b, direction);
            let v = self.weight(a, c, direction);
            let w = self.weight(b, a, direction);
            let least = avx._mm256_min_pd(avx._mm256_min_pd(u, v), w);
            let greatest = avx._mm256_max_pd(avx._mm256_max_pd(u, v), w);
            let inside = avx._mm256_or_pd(
                avx._mm256_cmp_pd::<_CMP_GE_OQ>(least, avx._mm256_set1_pd(-ray.doubt)),
                avx._mm256_cmp_pd::<_CMP_LE_OQ>(greatest, avx._mm256_set1_pd(ray.doubt)),
            );
            avx._mm256_movemask_pd(inside) as u32
        }
    }
}

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::Avx2;
