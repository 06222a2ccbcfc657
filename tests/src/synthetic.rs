//! Pictures by formula: flat shapes that move over a still background, sampled without a tracer, so that what a metric
//! must say is known beforehand.

use frame::{
    Accumulation, Alignment, FAR_DEPTH, Frame, Image, Ladder, Picture, Plane, Provenance, Raster,
    Shutter, Truth, VelocityKind,
};
use metrics::Viewing;

/// Exposure of every synthetic frame, in frames; not 1, so that a forgotten factor shows.
pub const EXPOSURE: f64 = 0.5;

/// Display white is radiance 1.
pub const VIEWING: Viewing = Viewing {
    stops: 0.0,
    flip_start: -1.0,
    flip_stop: 1.0,
    flip_count: 3,
};

/// A flat shape around its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A disc of this radius, in pixels.
    Disc(f64),
    /// A rectangle of these half sides, in pixels, the first one turned by `tilt` radians from +x.
    Bar {
        /// Half lengths along and across its axis.
        half: [f64; 2],
        /// Angle of its axis, in radians.
        tilt: f64,
    },
}

/// A shape that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Object {
    /// What it is.
    pub shape: Shape,
    /// Its centre at the instant, in pixels.
    pub center: [f64; 2],
    /// Its translation over the shutter, in pixels.
    pub displacement: [f64; 2],
    /// Its rotation about its centre over the shutter, in radians.
    pub turn: f64,
}

/// Shapes over a background, the first in front. Object ids are 1, 2 .. in this order.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Front to back.
    pub objects: Vec<Object>,
}

/// How moving objects are smeared: rightly or wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blur {
    /// Where the smear begins, in displacements from the instant.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Sub-frames at the midpoints of equal parts; none for a continuous smear.
    pub subframes: Option<u32>,
    /// Shift along and across the motion, in pixels.
    pub shift: [f64; 2],
    /// Dilation across the motion to both sides, in pixels.
    pub dilation: f64,
}

/// How a picture is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sampling {
    /// Samples per pixel.
    pub samples: u32,
    /// Seed of the per-pixel offsets; none gives every pixel the same offset, and no noise that differs between renders.
    pub seed: Option<u64>,
}

impl Blur {
    /// What a camera with a trailing shutter sees.
    pub const TRUE: Blur = Blur {
        from: -1.0,
        to: 0.0,
        subframes: None,
        shift: [0.0, 0.0],
        dilation: 0.0,
    };
    /// No blur: the instant.
    pub const IDENTITY: Blur = Blur {
        from: 0.0,
        ..Blur::TRUE
    };

    /// The mean of `subframes` instants.
    pub fn accumulation(subframes: u32) -> Blur {
        Blur {
            subframes: Some(subframes),
            ..Blur::TRUE
        }
    }
}

impl Sampling {
    /// Noise-free: every render of one scene gives the same values.
    pub const CLEAN: Sampling = Sampling {
        samples: 256,
        seed: None,
    };
}

impl Object {
    /// An object that translates only.
    pub fn sliding(shape: Shape, center: [f64; 2], displacement: [f64; 2]) -> Self {
        Self {
            shape,
            center,
            displacement,
            turn: 0.0,
        }
    }

    fn moves(&self) -> bool {
        self.displacement != [0.0, 0.0] || self.turn != 0.0
    }

    /// The point in the object's own coordinates, its centre at (0, 0), at `time` displacements from the instant.
    fn local(&self, point: [f64; 2], time: f64, blur: &Blur) -> [f64; 2] {
        let along = unit(self.displacement);
        let across = [-along[1], along[0]];
        let moved: [f64; 2] = std::array::from_fn(|axis| {
            point[axis]
                - self.center[axis]
                - self.displacement[axis] * time
                - along[axis] * blur.shift[0]
                - across[axis] * blur.shift[1]
        });
        rotate(moved, -self.turn * time)
    }

    /// Whether any part of a pixel can see the object at any time of a blur; generous.
    fn reaches(&self, pixel: [u32; 2], blur: &Blur) -> bool {
        let size = match self.shape {
            Shape::Disc(radius) => radius,
            Shape::Bar { half, .. } => half[0].hypot(half[1]),
        };
        let travel =
            self.displacement[0].hypot(self.displacement[1]) * blur.from.abs().max(blur.to.abs());
        let shift = blur.shift[0].hypot(blur.shift[1]) + blur.dilation;
        let distance = [0, 1].map(|axis| f64::from(pixel[axis]) + 0.5 - self.center[axis]);
        distance[0].hypot(distance[1]) <= size + travel + shift + 1.0
    }

    /// Whether the object, dilated across its motion by `dilation` to both sides, holds a point of its own coordinates.
    fn holds(&self, local: [f64; 2], dilation: f64) -> bool {
        let along = unit(self.displacement);
        let across = [-along[1], along[0]];
        match self.shape {
            Shape::Disc(radius) => {
                let aside = dot(local, across);
                let nearer = aside - aside.clamp(-dilation, dilation);
                let ahead = dot(local, along);
                ahead * ahead + nearer * nearer <= radius * radius
            }
            Shape::Bar { half, tilt } => {
                // Steps across the motion that stay within both pairs of sides, and within the dilation.
                let (at, step) = (rotate(local, -tilt), rotate(across, -tilt));
                let mut steps = [-dilation, dilation];
                for axis in [0, 1] {
                    if step[axis].abs() < 1e-12 {
                        if at[axis].abs() > half[axis] {
                            return false;
                        }
                    } else {
                        let ends =
                            [-half[axis], half[axis]].map(|end| (end - at[axis]) / step[axis]);
                        steps[0] = steps[0].max(ends[0].min(ends[1]));
                        steps[1] = steps[1].min(ends[0].max(ends[1]));
                    }
                }
                steps[0] <= steps[1]
            }
        }
    }
}

impl Scene {
    /// The picture that a blur makes of the scene.
    pub fn render(&self, blur: &Blur, sampling: Sampling) -> Picture {
        let mut coverage: Vec<Plane> =
            vec![Raster::filled(self.width, self.height, 0.0); self.objects.len() + 1];
        let color = Raster::from_fn(self.width, self.height, |x, y| {
            if !self
                .objects
                .iter()
                .any(|object| object.reaches([x, y], blur))
            {
                coverage[0].pixels[(y * self.width + x) as usize] = 1.0;
                return ground([x, y]).map(|value| value as f32);
            }
            let offsets = offsets(sampling.seed, x, y);
            let mut sum = [0.0; 3];
            let mut counts = vec![0u32; coverage.len()];
            for sample in 0..sampling.samples {
                let [u, v, w] = sequence(sample, sampling.samples, offsets);
                let point = [f64::from(x) + u, f64::from(y) + v];
                let fraction = match blur.subframes {
                    Some(count) => ((w * f64::from(count)).floor() + 0.5) / f64::from(count),
                    None => w,
                };
                let time = blur.from + fraction * (blur.to - blur.from);
                let (id, radiance) = self.sees(point, [x, y], time, blur);
                counts[id] += 1;
                sum = std::array::from_fn(|c| sum[c] + radiance[c]);
            }
            let samples = f64::from(sampling.samples);
            for (plane, count) in coverage.iter_mut().zip(counts) {
                plane.pixels[(y * self.width + x) as usize] = (f64::from(count) / samples) as f32;
            }
            sum.map(|sum| (sum / samples) as f32)
        });
        Picture { color, coverage }
    }

    /// What a filter is given, with clean colour and coverage.
    pub fn frame(&self) -> Frame {
        let instant = self.render(&Blur::IDENTITY, Sampling::CLEAN);
        let center = |x: u32, y: u32| [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let seen = Raster::from_fn(self.width, self.height, |x, y| {
            self.sees(center(x, y), [x, y], 0.0, &Blur::IDENTITY).0
        });
        let velocity = Raster::from_fn(self.width, self.height, |x, y| match seen.at(x, y) {
            0 => [0.0, 0.0],
            id => {
                let object = &self.objects[id - 1];
                let [right, down] = [0, 1].map(|axis| center(x, y)[axis] - object.center[axis]);
                [
                    ((object.displacement[0] - object.turn * down) / EXPOSURE) as f32,
                    ((object.displacement[1] + object.turn * right) / EXPOSURE) as f32,
                ]
            }
        });
        Frame {
            provenance: Provenance::default(),
            exposure: EXPOSURE,
            velocity_kind: VelocityKind::Instantaneous,
            objects: self.names(),
            color: instant.color,
            velocity,
            depth: seen.map(|id| if *id == 0 { FAR_DEPTH } else { *id as f32 }),
            object_id: seen.map(|id| *id as u32),
            coverage: instant.coverage,
        }
    }

    /// The truth of a trailing shutter, from two renders.
    pub fn truth(&self, samplings: [Sampling; 2]) -> Truth {
        let first = self.render(&Blur::TRUE, samplings[0]);
        let second = if samplings[0] == samplings[1] {
            first.clone()
        } else {
            self.render(&Blur::TRUE, samplings[1])
        };
        let halves = [first, second];
        let mut motion = Raster::filled(self.width, self.height, 0.0);
        for (object, index) in self.objects.iter().zip(1..) {
            if object.moves() {
                let mattes = halves.each_ref().map(|half| &half.coverage[index]);
                let mean = mattes[0].zip(mattes[1], |a, b| 0.5 * (a + b));
                motion = motion.zip(&mean, |sum, matte| sum + matte);
            }
        }
        Truth {
            provenance: Provenance::default(),
            shutter: shutter(),
            alignment: Alignment::Trailing,
            objects: self.names(),
            standard_error: halves[0].color.zip(&halves[1].color, |a, b| {
                std::array::from_fn(|c| 0.5 * (a[c] - b[c]).abs())
            }),
            halves,
            motion,
        }
    }

    /// Accumulations of 1, 2, 4 .. 64 sub-frames; `seeds` gives each half's noise.
    pub fn ladder(&self, samples: u32, seeds: [u64; 2]) -> Ladder {
        let rung = |subframes: u32| Accumulation {
            subframes,
            halves: seeds.map(|seed| {
                let sampling = Sampling {
                    samples,
                    seed: Some(seed + u64::from(subframes)),
                };
                self.render(&Blur::accumulation(subframes), sampling)
            }),
        };
        Ladder {
            provenance: Provenance::default(),
            shutter: shutter(),
            alignment: Alignment::Trailing,
            objects: self.names(),
            rungs: [1, 2, 4, 8, 16, 32, 64].map(rung).to_vec(),
        }
    }

    fn names(&self) -> Vec<String> {
        let objects = (1..=self.objects.len()).map(|id| format!("object{id}"));
        std::iter::once("background".to_owned())
            .chain(objects)
            .collect()
    }

    /// The id and radiance seen at a point.
    fn sees(&self, point: [f64; 2], pixel: [u32; 2], time: f64, blur: &Blur) -> (usize, [f64; 3]) {
        for (object, id) in self.objects.iter().zip(1..) {
            let still = Blur::IDENTITY;
            let (time, blur) = if object.moves() {
                (time, blur)
            } else {
                (0.0, &still)
            };
            let local = object.local(point, time, blur);
            if object.holds(local, blur.dilation) {
                return (id, texture(local));
            }
        }
        (0, ground(pixel))
    }
}

/// A picture of one colour and one mixture of labels everywhere: the mean of another.
pub fn constant(picture: &Picture) -> Picture {
    Picture {
        color: constant_color(&picture.color),
        coverage: picture
            .coverage
            .iter()
            .map(|plane| {
                let sum: f64 = plane.pixels.iter().map(|value| f64::from(*value)).sum();
                let mean = (sum / plane.pixels.len() as f64) as f32;
                plane.map(|_| mean)
            })
            .collect(),
    }
}

fn constant_color(image: &Image) -> Image {
    let mean: [f32; 3] = std::array::from_fn(|c| {
        let sum: f64 = image.pixels.iter().map(|pixel| f64::from(pixel[c])).sum();
        (sum / image.pixels.len() as f64) as f32
    });
    image.map(|_| mean)
}

fn shutter() -> Shutter {
    Alignment::Trailing
        .shutter(EXPOSURE)
        .expect("the synthetic exposure is positive")
}

/// Radiance on an object: bands fixed to it, 8 pixels wide.
fn texture(local: [f64; 2]) -> [f64; 3] {
    let bright = (local[0] / 8.0).floor() as i64 % 2 == 0;
    if bright {
        [0.9, 0.6, 0.2]
    } else {
        [0.5, 0.2, 0.1]
    }
}

/// Radiance of the background: constant within a pixel, so that it carries no sampling noise.
fn ground(pixel: [u32; 2]) -> [f64; 3] {
    let value = 0.2 + 0.15 * f64::from((pixel[0] / 5 + pixel[1] / 7) % 3);
    [0.7 * value, value, 1.1 * value]
}

/// Sample `index` of `count` in the unit cube: time stratified, the pixel filled by the R2 sequence (Martin Roberts 2018,
/// on the plastic number), each dimension rotated by an offset.
fn sequence(index: u32, count: u32, offsets: [f64; 3]) -> [f64; 3] {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let k = f64::from(index) + 0.5;
    let fraction = |value: f64| value - value.floor();
    [
        fraction(k / PLASTIC + offsets[0]),
        fraction(k / (PLASTIC * PLASTIC) + offsets[1]),
        fraction((k + offsets[2]) / f64::from(count)),
    ]
}

fn offsets(seed: Option<u64>, x: u32, y: u32) -> [f64; 3] {
    match seed {
        None => [0.0; 3],
        Some(seed) => [0, 1, 2].map(|dimension| {
            let key = (seed << 40) ^ (u64::from(y) << 22) ^ (u64::from(x) << 4) ^ dimension;
            // The offset in time stays within half a stratum of the midpoint.
            let offset = (hash(key) >> 11) as f64 / (1u64 << 53) as f64;
            if dimension == 2 { offset - 0.5 } else { offset }
        }),
    }
}

/// SplitMix64 (Steele, Lea and Flood 2014).
pub fn hash(key: u64) -> u64 {
    let mut z = key.wrapping_add(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

fn rotate([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn unit(vector: [f64; 2]) -> [f64; 2] {
    let length = dot(vector, vector).sqrt();
    if length == 0.0 {
        [1.0, 0.0]
    } else {
        vector.map(|component| component / length)
    }
}
