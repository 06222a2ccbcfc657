//! Files of frames, truths and ladders: bit-exact, written whole or not at all, and refused with a clear reason.

mod made;

use std::fs;
use std::path::Path;

use frame::{
    Accumulation, Alignment, AtInstant, Channel, ExrFile, FileError, Frame, Ladder, Samples, Truth,
    read_exr, rung_file, write_atomically, write_exr,
};
use made::{HEIGHT, WIDTH, a_frame, a_truth, image, objects, picture, plane, profiles, provenance};

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
fn halves_come_back_bit_for_bit_from_a_smaller_file_and_larger_numbers_too() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("truth.exr");
    let exact = a_truth();
    let short = Truth {
        at_instant: exact.at_instant.clone().map(AtInstant::rounded),
        ..exact.clone()
    };
    assert_ne!(short, exact);
    let written = |truth: &Truth| {
        truth.write(&path).unwrap();
        assert_eq!(Truth::read(&path).unwrap(), *truth);
        fs::metadata(&path).unwrap().len()
    };
    // The made-up numbers have every magnitude. Those beyond any half stay what they are.
    let offsets = |truth: &Truth| truth.at_instant[0].offset.pixels.clone();
    let large = |offset: &[f32; 2]| offset.iter().all(|axis| axis.abs() > 65_520.0);
    let mut pairs = offsets(&exact).into_iter().zip(offsets(&short));
    let (exact_offset, kept) = pairs
        .find(|(exact, _)| large(exact))
        .expect("some are large");
    assert_eq!(exact_offset, kept);
    written(&short);

    let noise = |value: f32| (value.to_bits() % 4001) as f32 / 100.0 - 20.0;
    let mut small = short;
    for at_instant in &mut small.at_instant {
        let [x, y] = [&at_instant.unknowable, &at_instant.placed];
        at_instant.offset = x.zip(y, |x, y| [noise(*x), noise(*y)]);
        at_instant.spread = at_instant.frozen.map(|pixel| pixel.map(noise));
    }
    let long = written(&small);
    small.at_instant = small.at_instant.map(AtInstant::rounded);
    let short = written(&small);
    // Five channels of each half lose two bytes a pixel, a few of which deflate had saved.
    let lost = 10 * 2 * u64::from(WIDTH * HEIGHT);
    assert!(long - short > lost * 3 / 4, "{short} {long}");
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
            && message.contains("`shuttertruth truths render`"),
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
    let ladder = a_ladder();
    ladder.clone().write(&path).unwrap();
    assert_eq!(Ladder::read(&path).unwrap(), ladder);
    let rungs = folder.path().join("ladder");
    ladder.clone().write_rungs(&rungs).unwrap();
    assert_eq!(Ladder::read(&rungs).unwrap(), ladder);
    let last = Ladder::read_rung(&rungs.join("n64.exr"), 64).unwrap();
    assert_eq!(last.rungs, ladder.rungs[2..]);
}

#[test]
fn a_ladder_s_folder_is_refused_where_its_files_do_not_belong_together() {
    let folder = tempfile::tempdir().unwrap();
    let ladder = a_ladder();
    ladder.clone().write_rungs(folder.path()).unwrap();
    let refused = |words: &str| {
        let error = Ladder::read(folder.path()).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    let file = |rung: u32| folder.path().join(rung_file(rung));
    std::fs::rename(file(2), file(3)).unwrap();
    refused("does not hold the one rung of 3 sub-frames");
    std::fs::rename(file(3), file(2)).unwrap();
    let mut other = ladder;
    other.provenance.content_hash = "0".to_owned();
    other.rungs.drain(..2);
    other.write(&file(64)).unwrap();
    refused("belongs to another ladder");
    for rung in [1, 2, 64] {
        std::fs::remove_file(file(rung)).unwrap();
    }
    refused("holds no rung");
}

fn a_ladder() -> Ladder {
    Ladder {
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
    }
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
        message.contains("shuttertruth truths render"),
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
