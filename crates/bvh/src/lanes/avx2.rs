//! Tests with the wide instructions of x86-64 processors since 2013.

use std::arch::x86_64::{__m256, _CMP_LE_OQ, _CMP_NGT_UQ, _CMP_NLT_UQ};

use pulp::cast;
use pulp::x86::V3;

use super::{Boxes, EdgeRay, LEAF, Lanes, SlabRay, Triangles, WIDTH};

/// Proof that the processor has AVX2 and FMA.
#[derive(Clone, Copy)]
pub struct Avx2(V3);

impl Avx2 {
    /// The instructions; none if the processor lacks them.
    pub fn detect() -> Option<Self> {
        V3::try_new().map(Self)
    }

    /// The distances at which the ray enters (end 0) or leaves (end 1) the slabs of one half of the
    /// boxes.
    #[inline(always)]
    fn planes(self, boxes: &Boxes, half: usize, ray: &SlabRay, axis: usize, end: usize) -> __m256 {
        let Self(V3 { avx, fma, .. }) = self;
        let side = ray.first[axis] ^ end;
        let halves: &[[f32; 8]] = boxes.0[axis][side].as_chunks().0;
        fma._mm256_fmadd_ps(
            cast(halves[half]),
            avx._mm256_set1_ps(ray.scale[axis]),
            avx._mm256_set1_ps(ray.offsets[end][axis]),
        )
    }

    /// [`Lanes::enter`] for one half of the boxes.
    #[inline(always)]
    fn half(self, boxes: &Boxes, half: usize, ray: &SlabRay, limit: f32) -> (u32, __m256) {
        let avx = self.0.avx;
        let near = avx._mm256_max_ps(
            avx._mm256_max_ps(
                self.planes(boxes, half, ray, 0, 0),
                self.planes(boxes, half, ray, 1, 0),
            ),
            avx._mm256_max_ps(self.planes(boxes, half, ray, 2, 0), avx._mm256_setzero_ps()),
        );
        let far = avx._mm256_min_ps(
            avx._mm256_min_ps(
                self.planes(boxes, half, ray, 0, 1),
                self.planes(boxes, half, ray, 1, 1),
            ),
            avx._mm256_min_ps(
                self.planes(boxes, half, ray, 2, 1),
                avx._mm256_set1_ps(limit),
            ),
        );
        let entered = avx._mm256_cmp_ps::<_CMP_LE_OQ>(near, far);
        (avx._mm256_movemask_ps(entered) as u32, near)
    }

    /// The places of vertices in the ray's plane.
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

    /// The cross product p x q.
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
        let [(a, p), (b, q)] = [
            self.half(boxes, 0, ray, limit),
            self.half(boxes, 1, ray, limit),
        ];
        (a | b << 8, cast([p, q]))
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
        // NaN is not rejected.
        let inside = avx._mm256_or_ps(
            avx._mm256_cmp_ps::<_CMP_NLT_UQ>(least, avx._mm256_set1_ps(-doubt)),
            avx._mm256_cmp_ps::<_CMP_NGT_UQ>(greatest, avx._mm256_set1_ps(doubt)),
        );
        avx._mm256_movemask_ps(inside) as u32
    }
}
