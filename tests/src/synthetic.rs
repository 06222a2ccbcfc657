//! Pictures by formula: flat shapes that move over a still background.
//!
//! No tracer is used, so the right value of a metric is known in advance.

use std::sync::Mutex;

use frame::{
    Accumulation, Alignment, AtInstant, Display, FAR_DEPTH, FlipExposures, Frame, FrameOptions,
    Image, Ladder, Picture, Plane, Provenance, Raster, Replicate, Reprojection, Shutter,
    ShutterProfile, Support, Truth,
};
use metrics::Viewing;

mod object;
mod sampling;

pub use object::{Blur, Object, Shape};
pub use sampling::Sampling;

use object::Posed;
use sampling::{pixel_offsets, sequence};

use crate::vector::minus;

/// Exposure of every synthetic frame, in frames. It is not 1, so that a forgotten factor is
/// noticed.
pub const EXPOSURE: f64 = 0.5;

/// Viewing conditions where display white is radiance 1.
pub const VIEWING: Viewing = Viewing {
    stops: DISPLAY.stops,
    flip_start: DISPLAY.flip.start,
    flip_stop: DISPLAY.flip.stop,
    flip_count: DISPLAY.flip.count,
};

const DISPLAY: Display = Display {
    stops: 0.0,
    flip: FlipExposures {
        start: -1.0,
        stop: 1.0,
        count: 3,
    },
};

/// Shapes over a background, from front to back. Object ids are 1, 2 .. in this order.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// Pixels per row.
    pub width: u32,
    /// Number of rows.
    pub height: u32,
    /// Objects, front to back.
    pub objects: Vec<Object>,
}

impl Scene {
    /// Renders a blur's picture of the scene.
    pub fn render(&self, blur: &Blur, sampling: Sampling) -> Picture {
        let mut coverage: Vec<Plane> =
            vec![Raster::filled(self.width, self.height, 0.0); self.objects.len() + 1];
        let movers = self.posed(blur);
        let color = Raster::from_fn(self.width, self.height, |x, y| {
            let near = |(_, object): &&(usize, Posed)| object.reaches([x, y]);
            let near: Vec<_> = movers.iter().filter(near).collect();
            if near.is_empty() {
                coverage[0].pixels[(y * self.width + x) as usize] = 1.0;
                return ground([x, y]).map(|value| value as f32);
            }
            let offsets = pixel_offsets(sampling.seed, x, y);
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
                let (id, radiance) = sees(&near, point, [x, y], time);
                counts[id] += 1;
                let [red, green, blue] = radiance;
                sum = [sum[0] + red, sum[1] + green, sum[2] + blue];
            }
            let samples = f64::from(sampling.samples);
            for (plane, count) in coverage.iter_mut().zip(counts) {
                plane.pixels[(y * self.width + x) as usize] = (f64::from(count) / samples) as f32;
            }
            sum.map(|sum| (sum / samples) as f32)
        });
        Picture { color, coverage }
    }

    /// Makes the input frame of a filter, with clean colour and coverage.
    pub fn frame(&self) -> Frame {
        let instant = self.render(&Blur::IDENTITY, Sampling::CLEAN);
        let center = |x: u32, y: u32| [f64::from(x) + 0.5, f64::from(y) + 0.5];
        let instant_objects = self.posed(&Blur::IDENTITY);
        let seen = Raster::from_fn(self.width, self.height, |x, y| {
            let all: Vec<_> = instant_objects.iter().collect();
            sees(&all, center(x, y), [x, y], 0.0).0
        });
        let velocity = Raster::from_fn(self.width, self.height, |x, y| match seen.at(x, y) {
            0 => [0.0, 0.0],
            id => {
                let object = &self.objects[id - 1];
                let [right, down] = minus(center(x, y), object.center);
                let turned = [-object.turn * down, object.turn * right];
                [0, 1].map(|axis| ((object.displacement[axis] + turned[axis]) / EXPOSURE) as f32)
            }
        });
        Frame {
            provenance: Provenance::default(),
            exposure: EXPOSURE,
            frames_per_second: None,
            options: FrameOptions::default(),
            guard_band: 0,
            reprojection: Reprojection::STILL,
            camera: None,
            display: DISPLAY,
            objects: self.names(),
            color: instant.color,
            velocity,
            velocity_next: None,
            velocity_z: None,
            depth: seen.map(|id| if *id == 0 { FAR_DEPTH } else { *id as f32 }),
            object_id: seen.map(|id| *id as u32),
            coverage: instant.coverage,
            samples: None,
        }
    }

    /// Renders the truth of a trailing shutter, twice.
    pub fn truth(&self, samplings: [Sampling; 2]) -> Truth {
        let first = self.render(&Blur::TRUE, samplings[0]);
        let halves = if samplings[0] == samplings[1] {
            [first.clone(), first]
        } else {
            [first, self.render(&Blur::TRUE, samplings[1])]
        };
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
            shutter_profile: ShutterProfile::default(),
            alignment: Alignment::Trailing,
            objects: self.names(),
            standard_error: halves[0].color.zip(&halves[1].color, |a, b| {
                std::array::from_fn(|c| 0.5 * (a[c] - b[c]).abs())
            }),
            at_instant: halves.each_ref().map(|half| nothing_unknown(&half.color)),
            halves,
            samples: Raster::filled(self.width, self.height, 1.0),
            motion,
            support: self.support(),
        }
    }

    /// Finds the pixels that the open shutter sees: the same for all truths of the scene, whatever
    /// their noise, rendered once per scene.
    pub fn support(&self) -> Support {
        static SUPPORTS: Mutex<Vec<(Scene, Support)>> = Mutex::new(Vec::new());
        let mut supports = SUPPORTS.lock().expect("no test fails in here");
        if let Some((_, support)) = supports.iter().find(|(scene, _)| scene == self) {
            return support.clone();
        }
        let support = self.find_support();
        supports.push((self.clone(), support.clone()));
        support
    }

    fn find_support(&self) -> Support {
        let probe = self.render(&Blur::TRUE, Sampling::CLEAN);
        let seen: Vec<Raster<bool>> = (probe.coverage.iter())
            .map(|plane| plane.map(|share| *share > 0.0))
            .collect();
        let nothing = seen[0].map(|_| false);
        let movers = self.objects.iter().zip(&seen[1..]);
        let moving = movers
            .filter(|(object, _)| object.moves())
            .fold(nothing.clone(), |moving, (_, seen)| {
                moving.zip(seen, |moving, seen| *moving || *seen)
            });
        Support {
            seen,
            moving,
            unknowable: nothing,
        }
    }

    /// Renders a replicate of the truth of a trailing shutter for each sampling.
    pub fn replicates(&self, samplings: impl IntoIterator<Item = Sampling>) -> Vec<Replicate> {
        let moving = self.objects.iter().map(Object::moves);
        let moving: Vec<bool> = [false].into_iter().chain(moving).collect();
        let support = self.support();
        (0..)
            .zip(samplings)
            .map(|(index, sampling)| {
                let picture = self.render(&Blur::TRUE, sampling);
                Replicate {
                    provenance: Provenance::default(),
                    index,
                    shutter: shutter(),
                    shutter_profile: ShutterProfile::default(),
                    alignment: Alignment::Trailing,
                    objects: self.names(),
                    moving: moving.clone(),
                    at_instant: nothing_unknown(&picture.color),
                    samples: Raster::filled(self.width, self.height, 1.0),
                    support: support.clone(),
                    picture,
                }
            })
            .collect()
    }

    /// Renders accumulations of 1, 2, 4 .. 64 sub-frames; `seeds` gives each group's noise, which
    /// the whole shutter shares.
    pub fn ladder(&self, samples: u32, seeds: [u64; 2]) -> Ladder {
        let samplings = seeds.map(|seed| Sampling {
            samples,
            seed: Some(seed),
        });
        let truths = samplings.map(|sampling| self.render(&Blur::TRUE, sampling));
        let rung = |subframes: u32| Accumulation {
            subframes,
            groups: (samplings.iter().zip(&truths))
                .map(|(sampling, truth)| {
                    let parts = self.render(&Blur::accumulation(subframes), *sampling);
                    parts.minus(truth)
                })
                .collect(),
        };
        Ladder {
            provenance: Provenance::default(),
            shutter: shutter(),
            shutter_profile: ShutterProfile::default(),
            alignment: Alignment::Trailing,
            objects: self.names(),
            rungs: [1, 2, 4, 8, 16, 32, 64].map(rung).to_vec(),
        }
    }

    fn names(&self) -> Vec<String> {
        let objects = (1..=self.objects.len()).map(|id| format!("object{id}"));
        let background = std::iter::once("background".to_owned());
        background.chain(objects).collect()
    }

    /// Poses the objects for a blur, with their ids; still ones are not blurred.
    fn posed(&self, blur: &Blur) -> Vec<(usize, Posed)> {
        let pose = |object: &Object| {
            if object.moves() {
                Posed::new(object, blur)
            } else {
                Posed::new(object, &Blur::IDENTITY)
            }
        };
        (1..).zip(self.objects.iter().map(pose)).collect()
    }
}

/// Returns the id and radiance visible at a point.
fn sees(
    objects: &[&(usize, Posed)],
    point: [f64; 2],
    pixel: [u32; 2],
    time: f64,
) -> (usize, [f64; 3]) {
    for (id, object) in objects {
        let local = object.local(point, time);
        if object.holds(local) {
            return (*id, texture(local));
        }
    }
    (0, ground(pixel))
}

/// Makes a picture with colour and labels everywhere at another's mean.
pub fn constant(picture: &Picture) -> Picture {
    let count = picture.color.pixels.len() as f64;
    let mean =
        |values: &mut dyn Iterator<Item = f32>| (values.map(f64::from).sum::<f64>() / count) as f32;
    let pixels = &picture.color.pixels;
    let color = [0, 1, 2].map(|c| mean(&mut pixels.iter().map(|pixel| pixel[c])));
    let planes = picture.coverage.iter().map(|plane| {
        let mean = mean(&mut plane.pixels.iter().copied());
        plane.map(|_| mean)
    });
    Picture {
        color: picture.color.map(|_| color),
        coverage: planes.collect(),
    }
}

fn shutter() -> Shutter {
    let shutter = Alignment::Trailing.shutter(EXPOSURE);
    shutter.expect("the synthetic exposure is positive")
}

/// Returns the radiance on an object: bands fixed to it, 8 pixels wide.
fn texture(local: [f64; 2]) -> [f64; 3] {
    match (local[0] / 8.0).floor() as i64 % 2 {
        0 => [0.9, 0.6, 0.2],
        _ => [0.5, 0.2, 0.1],
    }
}

/// Returns the radiance of the background: constant within a pixel, so it has no sampling noise.
fn ground(pixel: [u32; 2]) -> [f64; 3] {
    let value = 0.2 + 0.15 * f64::from((pixel[0] / 5 + pixel[1] / 7) % 3);
    [0.7 * value, value, 1.1 * value]
}

/// Makes layers in which everything is known and still, for truths with scores that do not read
/// them.
fn nothing_unknown(color: &Image) -> AtInstant {
    AtInstant {
        placed: color.map(|_| 1.0),
        ..AtInstant::unknown(color.width, color.height)
    }
}
