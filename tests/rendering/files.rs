//! Files of frames, truths and ladders: bit-exact, written whole or not at all, and refused with a clear reason.

use std::fs;
use std::path::Path;

use frame::{
    Accumulation, Alignment, AtInstant, Camera, CameraPose, Channel, ColorSampling, Display,
    Efficiency, ExrFile, FileError, FlipExposures, Frame, FrameOptions, Image, Ladder, Picture,
    Plane, Provenance, Raster, Reprojection, Samples, ShutterProfile, Support, Truth, VelocityKind,
    read_exr, write_atomically, write_exr,
};

const WIDTH: u32 = 13;
const HEIGHT: u32 = 7;

/// Makes values of every magnitude, subnormal and negative ones too, so that any rounding shows.
fn plane(salt: u32) -> Plane {
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

fn image(salt: u32) -> Image {
    let [r, g, b] = [plane(salt), plane(salt + 1), plane(salt + 2)];
    Raster::from_fn(WIDTH, HEIGHT, |x, y| {
        [*r.at(x, y), *g.at(x, y), *b.at(x, y)]
    })
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

fn a_frame() -> Frame {
    Frame {
        provenance: provenance(),
        exposure: 0.1 + 0.2, // not representable in short decimals
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
        velocity: Raster::from_fn(WIDTH, HEIGHT, |x, y| {
            [*plane(8).at(x, y), *plane(9).at(x, y)]
        }),
        depth: plane(10),
        object_id: Raster::from_fn(WIDTH, HEIGHT, |x, y| u32::MAX - x * y),
        coverage: vec![plane(11), plane(12)],
        samples: Some(plane(13)),
    }
}

fn at_instant(salt: u32) -> AtInstant {
    AtInstant {
        frozen: image(salt),
        unknowable: plane(salt + 3),
        placed: plane(salt + 4),
        offset: plane(salt + 5).zip(&plane(salt + 6), |x, y| [*x, *y]),
        spread: image(salt + 7),
    }
}

fn a_truth() -> Truth {
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

fn support() -> Support {
    let mask = |salt: u32| Raster::from_fn(WIDTH, HEIGHT, |x, y| (x + salt * y).is_multiple_of(3));
    Support {
        seen: vec![mask(1), mask(2)],
        moving: mask(4),
        unknowable: mask(5),
    }
}

/// Makes shutters of every kind, with numbers that short decimals cannot represent.
fn profiles() -> [ShutterProfile; 3] {
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

#[test]
fn every_shutter_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("truth.exr");
    for shutter_profile in profiles() {
        let truth = Truth {
            shutter_profile,
            ..a_truth()
        };
        truth.write(&path).unwrap();
        assert_eq!(Truth::read(&path).unwrap(), truth);
    }
}

#[test]
fn a_truth_without_a_support_is_refused_with_the_way_out() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("truth.exr");
    a_truth().write(&path).unwrap();
    let whole = read_exr(&path).unwrap();
    let refused = |file: &ExrFile| {
        write_exr(&path, file).unwrap();
        Truth::read(&path)
            .expect_err("no whole support")
            .to_string()
    };
    let mut old = whole.clone();
    old.channels
        .retain(|channel| !channel.name.starts_with("support."));
    let message = refused(&old);
    assert!(
        message.contains("truth.exr: holds no support")
            && message.contains("`shuttertruth render`"),
        "{message}"
    );
    let mut part = whole.clone();
    part.channels
        .retain(|channel| channel.name != "support.unknowable");
    let message = refused(&part);
    assert!(
        message.contains("lacks the channel \"support.unknowable\""),
        "{message}"
    );
    let mut gray = whole;
    let mut masks = gray.channels.iter_mut();
    let mask = masks
        .find(|channel| channel.name == "support.moving")
        .unwrap();
    mask.samples = Samples::F32(plane(1).map(|_| 0.5).pixels);
    let message = refused(&gray);
    assert!(message.contains("holds 0.5; allowed: 0 and 1"), "{message}");
}

#[test]
fn a_file_with_an_invalid_shutter_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("truth.exr");
    a_truth().write(&path).unwrap();
    for (efficiency, reason) in [
        (
            "round",
            "attribute \"shutter_efficiency\" holds \"round\", which cannot be read",
        ),
        (
            "table 1 x",
            "attribute \"shutter_efficiency\" holds \"table 1 x\", which cannot be read",
        ),
        ("table 1 2", "efficiency holds 2; allowed: 0 to 1"),
    ] {
        let mut file = read_exr(&path).unwrap();
        file.set("shutter_efficiency", efficiency);
        let spoilt = folder.path().join("spoilt.exr");
        write_exr(&spoilt, &file).unwrap();
        let error = Truth::read(&spoilt).unwrap_err().to_string();
        assert!(error.ends_with(reason), "{error}");
    }
}

#[test]
fn a_frame_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new/folder/frame.exr");
    a_frame().write(&path).unwrap();
    assert_eq!(Frame::read(&path).unwrap(), a_frame());
}

#[test]
fn equal_frames_make_equal_files() {
    let folder = tempfile::tempdir().unwrap();
    let written = ["one.exr", "two.exr", "three.exr"].map(|name| {
        let path = folder.path().join(name);
        a_frame().write(&path).unwrap();
        fs::read(&path).unwrap()
    });
    assert!(written[0] == written[1] && written[1] == written[2]);
}

#[test]
fn a_truth_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("truth_centred.exr");
    a_truth().write(&path).unwrap();
    assert_eq!(Truth::read(&path).unwrap(), a_truth());
}

#[test]
fn a_ladder_comes_back_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ladder.exr");
    let ladder = Ladder {
        provenance: provenance(),
        shutter: a_truth().shutter,
        shutter_profile: a_truth().shutter_profile,
        alignment: Alignment::Centred,
        objects: objects(),
        rungs: [1, 2, 64]
            .map(|subframes| Accumulation {
                subframes,
                halves: [picture(subframes), picture(subframes + 100)],
            })
            .into(),
    };
    ladder.clone().write(&path).unwrap();
    assert_eq!(Ladder::read(&path).unwrap(), ladder);
}

#[test]
fn channels_have_the_names_that_compositors_use() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.exr");
    a_frame().write(&path).unwrap();
    let file = read_exr(&path).unwrap();
    let names: Vec<&str> = file
        .channels
        .iter()
        .map(|channel| channel.name.as_str())
        .collect();
    for name in [
        "R",
        "G",
        "B",
        "Z",
        "velocity.X",
        "velocity.Y",
        "object.id",
        "coverage.front-wheel_2",
    ] {
        assert!(names.contains(&name), "no channel {name} in {names:?}");
    }
    for name in [
        "scene",
        "exposure",
        "samples_per_pixel",
        "seed",
        "program",
        "content_hash",
        "convention",
    ] {
        assert!(file.attributes.contains_key(name), "no attribute {name}");
    }
}

#[test]
fn a_file_truncated_anywhere_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("truth.exr");
    a_truth().write(&path).unwrap();
    let whole = fs::read(&path).unwrap();
    // The last cut removes only one byte.
    for length in [0, 3, 20, whole.len() / 3, whole.len() / 2, whole.len() - 1] {
        fs::write(&path, &whole[..length]).unwrap();
        let message = Truth::read(&path).unwrap_err().to_string();
        assert!(
            message.contains("truth.exr: not a complete OpenEXR file"),
            "{length} bytes: {message}"
        );
    }
}

#[test]
fn a_picture_of_another_kind_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("photo.exr");
    fs::write(&path, b"\x89PNG\r\n\x1a\nnot an exr at all").unwrap();
    assert!(matches!(Truth::read(&path), Err(FileError::Broken { .. })));
    a_frame().write(&path).unwrap();
    let message = Truth::read(&path).unwrap_err().to_string();
    assert!(
        message.ends_with("photo.exr: is a frame; a truth is needed"),
        "{message}"
    );
}

#[test]
fn a_foreign_exr_is_refused_with_its_missing_channels() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("render.exr");
    let mut file = ExrFile::new(WIDTH, HEIGHT);
    file.push_color("", &image(1));
    write_exr(&path, &file).unwrap();
    let message = Frame::read(&path).unwrap_err().to_string();
    assert!(
        message.contains("render.exr: was not written by shuttertruth"),
        "{message}"
    );
    assert!(
        message.contains("shuttertruth render"),
        "no way out: {message}"
    );
    let message = read_exr(&path).unwrap().plane("Z").unwrap_err().to_string();
    assert!(
        message.ends_with("render.exr: lacks the channel \"Z\""),
        "{message}"
    );
    file.channels.push(Channel {
        name: "Z".into(),
        samples: Samples::U32(vec![0; (WIDTH * HEIGHT) as usize]),
    });
    write_exr(&path, &file).unwrap();
    let message = read_exr(&path).unwrap().plane("Z").unwrap_err().to_string();
    assert!(
        message.ends_with("channel \"Z\" holds integers; 32-bit floats are needed"),
        "{message}"
    );
}

#[test]
fn a_missing_file_is_named() {
    let message = Frame::read(Path::new("no/such/frame.exr"))
        .unwrap_err()
        .to_string();
    assert!(
        message.starts_with("no/such/frame.exr: cannot read: "),
        "{message}"
    );
}

#[test]
fn a_failed_write_leaves_the_old_file_and_no_other() {
    let folder = tempfile::tempdir().unwrap();
    // A folder has the file's name, so that the last step, the rename, must fail.
    let path = folder.path().join("taken");
    fs::create_dir(&path).unwrap();
    fs::write(path.join("inside"), "kept").unwrap();
    let message = write_atomically(&path, b"new").unwrap_err().to_string();
    assert!(message.contains("taken: cannot write: "), "{message}");
    let left: Vec<_> = fs::read_dir(folder.path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    assert_eq!(left, ["taken"], "a temporary file was left behind");
    assert_eq!(fs::read_to_string(path.join("inside")).unwrap(), "kept");
}
