//! The random numbers: Owen-scrambled Sobol points, a pure function of seed, pixel, sample and use.

use sobol_burley::sample_4d;

/// Four-dimensional sets per bounce: next direction, lights, sky.
const SETS_PER_BOUNCE: u32 = 3;
/// Bounces that share the camera's sequence.
const JOINT_BOUNCES: u32 = 2;
/// Number of the lens' set, which no bounce has.
const LENS_SET: u32 = u32::MAX;

/// Independent streams of random numbers, so that renders of a scene share no noise but what they
/// are meant to.
#[derive(Clone, Copy)]
pub(crate) enum Stream {
    /// Truths, and the frame that goes with them: they differ by nothing where nothing changes.
    Picture,
    /// Accumulations of sub-frames, and the whole shutter that they are compared with.
    Ladder,
    Support,
    /// The pilot of a picture.
    Pilot,
    /// A pass of depth of field.
    Defocus,
}

/// The random numbers of one sample of one pixel.
#[derive(Clone, Copy)]
pub(crate) struct Sampler {
    pub index: u32,
    seed: u32,
}

/// The seed of one replicate of one pixel: different for each replicate of a pixel, unrelated
/// between pixels.
pub(crate) fn pixel_seed(seed: u64, stream: Stream, pixel: u32, replicate: u32) -> u32 {
    let stream = match stream {
        Stream::Picture => 1,
        Stream::Ladder => 2,
        Stream::Support => u64::MAX,
        Stream::Pilot => u64::MAX - 1,
        Stream::Defocus => u64::MAX - 3,
    };
    let pixel_hash = mix64(mix64(mix64(seed) ^ stream) ^ u64::from(pixel));
    mix32((pixel_hash as u32).wrapping_add(replicate))
}

impl Sampler {
    /// Sample `index` of the pixel and replicate with this seed.
    pub fn new(seed: u32, index: u32) -> Self {
        Self { index, seed }
    }

    /// Numbers for the place in the pixel (x, y) and in the shutter interval, stratified together;
    /// one is spare.
    pub fn camera(&self) -> [f64; 4] {
        draw(self.index, 0, self.seed)
    }

    /// Numbers for the point of the lens, stratified together. They change no others, so that a
    /// pinhole's samples are the same with and without them.
    pub fn lens(&self) -> [f64; 2] {
        let [u, v, ..] = self.shuffled_set(LENS_SET);
        [u, v]
    }

    /// Numbers for the next direction (two), roulette, and the choice of an emitter.
    pub fn bounce(&self, depth: u32) -> [f64; 4] {
        self.set(depth, 0)
    }

    /// Numbers for the point on the emitter and the point on the sun.
    pub fn lights(&self, depth: u32) -> [f64; 4] {
        self.set(depth, 1)
    }

    /// Numbers for the direction to the sky (two) and the choice of a lobe; the last is
    /// [`Sampler::passage`].
    pub fn sky(&self, depth: u32) -> [f64; 4] {
        self.set(depth, 2)
    }

    /// Number that chooses where the ray of a bounce stops among translucent surfaces: the spare
    /// one of [`Sampler::sky`].
    pub fn passage(&self, depth: u32) -> f64 {
        self.sky(depth)[3]
    }

    /// One set of numbers.
    ///
    /// The first bounces are stratified together with the camera. In high dimensions of the
    /// sequence small counts are correlated: all paths that survive one roulette would survive or
    /// die together in the next. There each set uses the sequence's first four dimensions with a
    /// seed of its own, which shuffles the samples as well (Burley 2020, "Practical Hash-based Owen
    /// Scrambling", section 4).
    fn set(&self, depth: u32, which: u32) -> [f64; 4] {
        let set = 1 + SETS_PER_BOUNCE * depth + which;
        if depth < JOINT_BOUNCES {
            return draw(self.index, set, self.seed);
        }
        self.shuffled_set(set)
    }

    /// The sequence's first four dimensions, with a seed of the set's own.
    fn shuffled_set(&self, set: u32) -> [f64; 4] {
        let seed = mix32(self.seed ^ mix32(set));
        draw(self.index, 0, seed)
    }
}

/// Draws four numbers. Each is converted by name, because arrays are not mapped in registers.
fn draw(index: u32, set: u32, seed: u32) -> [f64; 4] {
    let [a, b, c, d] = sample_4d(index, set, seed);
    [a.into(), b.into(), c.into(), d.into()]
}

/// A bijection of 64 bits: the finaliser of SplitMix64 (Steele, Lea and Flood 2014).
fn mix64(value: u64) -> u64 {
    let mut z = value.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A bijection of 32 bits: the finaliser of MurmurHash3.
fn mix32(value: u32) -> u32 {
    let mut h = value;
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}
