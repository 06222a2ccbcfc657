//! Frames, truths, replicates and ladders of made-up numbers.

use frame::{
    Accumulation, Alignment, AtInstant, Camera, CameraPose, ColorSampling, Display, Efficiency,
    FlipExposures, Frame, FrameOptions, Image, Ladder, Picture, Plane, Provenance, Raster,
    Replicate, Reprojection, ShutterProfile, Support, Truth, VelocityKind,
};

pub const WIDTH: u32 = 13;
pub const HEIGHT: u32 = 7;

/// Makes values of every magnitude, including subnormal and negative ones, so that any rounding is
/// noticed.
pub fn plane(salt: u32) -> Plane {
    Raster::from_fn(WIDTH, HEIGHT, |x, y| {
        let mut bits = (x + 17 * y + 1009 * salt).wrapping_mul(0x9e37_79b9);
        bits ^= bits >> 15;
        let value = f32::from_bits(bits.wrapping_mul(0x85eb_ca6b));
        if value.is_finite() {
            value
        } else {
            f32::from_bits(bits & 0x007f_ffff)
        }
    })
}

/// Makes a plane of pairs.
fn pairs(salt: u32) -> Raster<[f32; 2]> {
    plane(salt).zip(&plane(salt + 1), |x, y| [*x, *y])
}

pub fn image(salt: u32) -> Image {
    pairs(salt).zip(&plane(salt + 2), |[r, g], b| [*r, *g, *b])
}

fn picture(salt: u32) -> Picture {
    Picture {
        color: image(salt),
        coverage: vec![plane(salt + 3), plane(salt + 4)],
    }
}

fn objects() -> Vec<String> {
    vec!["background".into(), "front-wheel_2".into()]
}

fn provenance() -> Provenance {
    Provenance {
        scene: "fan@20deg".into(),
        program: "shuttertruth test".into(),
        seed: u64::MAX,
        samples_per_pixel: 256,
        replicates: 8,
        traversal: "avx2".into(),
        content_hash: "00ff".into(),
        engine: None,
    }
}

fn pose(number: f64) -> CameraPose {
    CameraPose {
        focal: number,
        to_world: [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| number * f64::from(row - column))),
    }
}

pub fn a_frame() -> Frame {
    Frame {
        provenance: provenance(),
        exposure: 0.1 + 0.2, // not representable in short decimals
        frames_per_second: Some(24000.0 / 1001.0),
        options: FrameOptions {
            velocity: VelocityKind::PreviousFrame,
            color: ColorSampling::Point,
            sky_velocity: false,
        },
        guard_band: 1,
        reprojection: Reprojection {
            rows: [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| 0.1 * f64::from(4 * row + column))),
        },
        camera: Some(Camera {
            now: pose(0.7),
            before: pose(1.0 / 3.0),
        }),
        display: Display {
            stops: 1.0 / 3.0, // likewise
            flip: FlipExposures {
                start: -1.7,
                stop: 0.1,
                count: 7,
            },
        },
        objects: objects(),
        color: image(1),
        velocity: pairs(8),
        velocity_next: Some(pairs(90)),
        velocity_z: Some(plane(92)),
        depth: plane(10),
        object_id: Raster::from_fn(WIDTH, HEIGHT, |x, y| u32::MAX - x * y),
        coverage: vec![plane(11), plane(12)],
        samples: Some(plane(13)),
    }
}

fn at_instant(salt: u32) -> AtInstant {
    AtInstant {
        shift: image(salt),
        unknowable: plane(salt + 3),
        placed: plane(salt + 4),
        offset: pairs(salt + 5),
        spread: pairs(salt + 7),
    }
}

pub fn a_truth() -> Truth {
    Truth {
        provenance: provenance(),
        shutter: Alignment::Centred.shutter(1.0 / 3.0).unwrap(),
        shutter_profile: profiles()[0].clone(),
        alignment: Alignment::Centred,
        objects: objects(),
        halves: [picture(20), picture(30)],
        at_instant: [at_instant(60), at_instant(70)],
        standard_error: image(40),
        samples: plane(80),
        motion: plane(50),
        support: support(),
    }
}

pub fn a_replicate() -> Replicate {
    let truth = a_truth();
    let [picture, _] = truth.halves;
    let [at_instant, _] = truth.at_instant;
    Replicate {
        provenance: truth.provenance,
        index: 3,
        shutter: truth.shutter,
        shutter_profile: truth.shutter_profile,
        alignment: truth.alignment,
        objects: truth.objects,
        moving: vec![false, true],
        picture,
        at_instant,
        samples: truth.samples,
        support: truth.support,
    }
}

pub fn a_ladder() -> Ladder {
    let truth = a_truth();
    let rungs = [1, 2, 64].map(|subframes| Accumulation {
        subframes,
        groups: vec![picture(subframes), picture(subframes + 100)],
    });
    Ladder {
        provenance: truth.provenance,
        shutter: truth.shutter,
        shutter_profile: truth.shutter_profile,
        alignment: truth.alignment,
        objects: truth.objects,
        rungs: rungs.into(),
    }
}

fn support() -> Support {
    let mask = |salt: u32| Raster::from_fn(WIDTH, HEIGHT, |x, y| (x + salt * y).is_multiple_of(3));
    Support {
        seen: vec![mask(1), mask(2)],
        moving: mask(4),
        unknowable: mask(5),
    }
}

/// Makes shutters of every kind, with numbers that short decimals cannot represent.
pub fn profiles() -> [ShutterProfile; 3] {
    let efficiencies = [
        Efficiency::Table(vec![0.1 + 0.2, 1.0, 1.0 / 3.0]),
        Efficiency::Trapezoid {
            rise: 1.0 / 3.0,
            fall: 0.1 + 0.2,
        },
        Efficiency::Box,
    ];
    efficiencies.map(|efficiency| ShutterProfile {
        efficiency,
        rolling: -1.0 / 7.0,
    })
}
