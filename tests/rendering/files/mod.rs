//! Files of frames, truths and ladders: bit-exact, written completely or not at all, and refused
//! with a clear reason.

mod made;

use std::fs;
use std::path::{Path, PathBuf};

use frame::{
    AtInstant, Channel, ExrFile, FileError, Frame, Ladder, Raster, Replicate, Samples, Truth,
    read_exr, read_passes, rung_file, write_atomically, write_exr, write_small_exr,
};
use made::{HEIGHT, WIDTH, a_frame, a_ladder, a_replicate, a_truth, image, plane, profiles};
use tempfile::TempDir;

/// Makes a folder, and the path of a file in it.
fn folder_with(name: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    (folder, path)
}

/// Fails unless the message of an error contains the words.
fn expect_refusal<T>(result: Result<T, FileError>, words: &str) {
    let message = result.err().expect("it is refused").to_string();
    assert!(message.contains(words), "{message}");
}

#[test]
fn what_is_written_comes_back_bit_for_bit() {
    let (folder, path) = folder_with("new/folder/frame.exr");
    a_frame().write(&path).unwrap();
    assert_eq!(Frame::read(&path).unwrap(), a_frame());
    let mut few = a_frame();
    (few.velocity_next, few.velocity_z) = (None, None);
    few.write(&path).unwrap();
    assert_eq!(Frame::read(&path).unwrap(), few);
    a_frame().write(&path).unwrap();
    // Equal frames make equal files.
    let again = folder.path().join("again.exr");
    a_frame().write(&again).unwrap();
    assert!(fs::read(&path).unwrap() == fs::read(&again).unwrap());

    for shutter_profile in profiles() {
        let mut truth = a_truth();
        truth.shutter_profile = shutter_profile;
        truth.write(&path).unwrap();
        assert_eq!(Truth::read(&path).unwrap(), truth);
    }
    a_replicate().write(&path).unwrap();
    assert_eq!(Replicate::read(&path).unwrap(), a_replicate());

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
fn halves_come_back_bit_for_bit_from_a_smaller_file_and_larger_numbers_too() {
    let (_folder, path) = folder_with("truth.exr");
    let exact = a_truth();
    let mut short = exact.clone();
    short.at_instant = short.at_instant.map(AtInstant::rounded);
    assert_ne!(short, exact);
    let written = |truth: &Truth| {
        truth.write(&path).unwrap();
        assert_eq!(Truth::read(&path).unwrap(), *truth);
        fs::metadata(&path).unwrap().len()
    };
    // The made-up numbers have every magnitude. Those beyond any half stay unchanged.
    let offsets = |truth: &Truth| truth.at_instant[0].offset.pixels.clone();
    let large = |offset: &[f32; 2]| offset.iter().all(|axis| axis.abs() > 65_520.0);
    let mut pairs = offsets(&exact).into_iter().zip(offsets(&short));
    let pair = pairs.find(|(exact, _)| large(exact));
    let (exact_offset, kept) = pair.expect("some are large");
    assert_eq!(exact_offset, kept);
    written(&short);

    let noise = |value: f32| (value.to_bits() % 4001) as f32 / 100.0 - 20.0;
    let mut small = short;
    for at_instant in &mut small.at_instant {
        let [x, y] = [&at_instant.unknowable, &at_instant.placed];
        at_instant.offset = x.zip(y, |x, y| [noise(*x), noise(*y)]);
        at_instant.spread = (at_instant.shift).map(|[red, green, _]| [noise(*red), noise(*green)]);
    }
    let long = written(&small);
    small.at_instant = small.at_instant.map(AtInstant::rounded);
    let short = written(&small);
    // Four channels of each half lose two bytes a pixel; deflate had saved a few of these.
    let lost = 8 * 2 * u64::from(WIDTH * HEIGHT);
    assert!(long - short > lost * 3 / 4, "{short} {long}");
}

#[test]
fn a_truth_that_was_changed_is_refused() {
    let (_folder, path) = folder_with("truth.exr");
    let changes: [fn(&mut ExrFile); 6] = [
        |file| (file.channels).retain(|channel| !channel.name.starts_with("support.")),
        |file| (file.channels).retain(|channel| channel.name != "support.unknowable"),
        |file| {
            let mut masks = file.channels.iter_mut();
            let mask = masks.find(|channel| channel.name == "support.moving");
            mask.unwrap().samples = Samples::F32(plane(1).map(|_| 0.5).pixels);
        },
        |file| file.set("shutter_efficiency", "round"),
        |file| file.set("shutter_efficiency", "table 1 x"),
        |file| file.set("shutter_efficiency", "table 1 2"),
    ];
    let words = "truth.exr: holds no support (channels support.*), which older versions of shuttertruth did not write; make it anew with `shuttertruth truths render`
        lacks the channel \"support.unknowable\"
        holds 0.5; allowed: 0 and 1
        attribute \"shutter_efficiency\" holds \"round\", which cannot be read
        attribute \"shutter_efficiency\" holds \"table 1 x\", which cannot be read
        efficiency holds 2; allowed: 0 to 1";
    assert_eq!(words.lines().count(), changes.len());
    for (change, words) in changes.into_iter().zip(words.lines()) {
        a_truth().write(&path).unwrap();
        let mut file = read_exr(&path).unwrap();
        change(&mut file);
        write_exr(&path, &file).unwrap();
        expect_refusal(Truth::read(&path), words.trim());
    }
}

#[test]
fn a_ladder_s_folder_is_refused_where_its_files_do_not_belong_together() {
    let folder = tempfile::tempdir().unwrap();
    let ladder = a_ladder();
    ladder.clone().write_rungs(folder.path()).unwrap();
    let refused = |words: &str| expect_refusal(Ladder::read(folder.path()), words);
    let file = |rung: u32| folder.path().join(rung_file(rung));
    fs::rename(file(2), file(3)).unwrap();
    refused("does not hold the one rung of 3 sub-frames");
    fs::rename(file(3), file(2)).unwrap();
    let mut other = ladder;
    other.provenance.content_hash = "0".to_owned();
    other.rungs.drain(..2);
    other.write(&file(64)).unwrap();
    refused("belongs to another ladder");
    for rung in [1, 2, 64] {
        fs::remove_file(file(rung)).unwrap();
    }
    refused("holds no rung");
}

#[test]
fn channels_have_the_names_that_compositors_use() {
    let (_folder, path) = folder_with("frame.exr");
    a_frame().write(&path).unwrap();
    let file = read_exr(&path).unwrap();
    let names = file.channels.iter().map(|channel| channel.name.as_str());
    let names: Vec<&str> = names.collect();
    let channels = "R G B Z velocity.X velocity.Y object.id coverage.front-wheel_2";
    for name in channels.split(' ') {
        assert!(names.contains(&name), "no channel {name} in {names:?}");
    }
    let attributes = "scene exposure samples_per_pixel seed program content_hash convention";
    for name in attributes.split(' ') {
        assert!(file.attributes.contains_key(name), "no attribute {name}");
    }
}

/// What became of flipped bits.
#[derive(Default)]
struct Flips {
    all: usize,
    /// Flips that leave the picture as it was: decoders ignore a few bits.
    kept: usize,
    /// Flips that change the picture.
    changed: usize,
}

/// Flips bits of a picture's deflated chunks, and reads the picture; `is_flipped` chooses by byte
/// and bit.
fn flip_bits(is_flipped: impl Fn(usize, usize) -> bool) -> Flips {
    let (_folder, path) = folder_with("picture.exr");
    let mut file = ExrFile::new(24, 40);
    // Irregular, and few values, which deflate.
    let steps = Raster::from_fn(24, 40, |x, y| {
        let word = (x + 24 * y + 1).wrapping_mul(0x9E37_79B9);
        ((word ^ word >> 15).wrapping_mul(0x85EB_CA6B) >> 30) as f32 / 7.0
    });
    file.push_plane("R", &steps);
    write_small_exr(&path, file).unwrap();
    let (bytes, whole) = (fs::read(&path).unwrap(), read_passes(&path).unwrap());
    // The table of three chunks of at most 16 rows begins 24 bytes before the first chunk, and says
    // where that is.
    let number = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().unwrap());
    let mut places = 0..bytes.len() - 24;
    let chunks = places.find(|at| number(*at) == *at as u64 + 24).unwrap() + 24;
    assert!(
        bytes.len() - chunks < 2 * 24 * 40,
        "the chunks are deflated"
    );
    let mut flips = Flips::default();
    let bits = (chunks..bytes.len()).flat_map(|at| (0..8).map(move |bit| (at, bit)));
    for (at, bit) in bits.filter(|(at, bit)| is_flipped(*at, *bit)) {
        let mut flipped = bytes.clone();
        flipped[at] ^= 1 << bit;
        fs::write(&path, flipped).unwrap();
        flips.all += 1;
        match read_passes(&path) {
            Ok(read) if read.channels == whole.channels => flips.kept += 1,
            Ok(_) => flips.changed += 1,
            Err(_) => {}
        }
    }
    flips
}

/// Expects that nearly all flips are refused.
fn expect_refused(flips: &Flips, most_changed: usize) {
    let Flips { all, kept, changed } = flips;
    assert!(*changed <= most_changed, "{changed} of {all}");
    assert!(kept * 20 < *all, "{kept} of {all}");
}

#[test]
fn a_flipped_bit_in_a_foreign_picture_s_deflated_chunks_is_refused() {
    // One bit of each byte.
    let flips = flip_bits(|at, bit| at % 8 == bit);
    expect_refused(&flips, 0);
}

#[test]
#[ignore = "prove: every bit"]
fn each_flipped_bit_in_a_foreign_picture_s_deflated_chunks_is_refused() {
    // A flip that permutes bytes may leave both sums of Adler-32 as they are. zlib accepts these
    // 17, too.
    expect_refused(&flip_bits(|_, _| true), 17);
}

#[test]
fn a_file_truncated_anywhere_is_refused() {
    let (_folder, path) = folder_with("truth.exr");
    a_truth().write(&path).unwrap();
    let whole = fs::read(&path).unwrap();
    // The last cut removes only one byte.
    for length in [0, 3, 20, whole.len() / 3, whole.len() / 2, whole.len() - 1] {
        fs::write(&path, &whole[..length]).unwrap();
        let words = "truth.exr: not a complete OpenEXR file";
        expect_refusal(Truth::read(&path), words);
    }
}

#[test]
fn files_of_another_kind_are_refused_by_name() {
    let missing = Path::new("no/such/frame.exr");
    expect_refusal(Frame::read(missing), "no/such/frame.exr: cannot read: ");
    let (_folder, path) = folder_with("photo.exr");
    fs::write(&path, b"\x89PNG\r\n\x1a\nnot an exr at all").unwrap();
    assert!(matches!(Truth::read(&path), Err(FileError::Broken { .. })));
    a_frame().write(&path).unwrap();
    let words = "photo.exr: is a frame; a truth is needed";
    expect_refusal(Truth::read(&path), words);

    let mut foreign = ExrFile::new(WIDTH, HEIGHT);
    foreign.push_color("", &image(1));
    write_exr(&path, &foreign).unwrap();
    let words = "photo.exr: was not written by shuttertruth";
    expect_refusal(Frame::read(&path), words);
    expect_refusal(Frame::read(&path), "shuttertruth truths render");
    let depth = || read_exr(&path).unwrap().plane("Z");
    expect_refusal(depth(), "photo.exr: lacks the channel \"Z\"");
    foreign.channels.push(Channel {
        name: "Z".into(),
        samples: Samples::U32(vec![0; (WIDTH * HEIGHT) as usize]),
    });
    write_exr(&path, &foreign).unwrap();
    let words = "channel \"Z\" holds integers; 32-bit floats are needed";
    expect_refusal(depth(), words);
}

#[test]
fn a_failed_write_leaves_the_old_file_and_no_other() {
    // A folder has the file's name, so the last step, the rename, must fail.
    let (folder, path) = folder_with("taken");
    fs::create_dir(&path).unwrap();
    fs::write(path.join("inside"), "kept").unwrap();
    expect_refusal(write_atomically(&path, b"new"), "taken: cannot write: ");
    let left = fs::read_dir(folder.path()).unwrap();
    let left: Vec<_> = left.map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["taken"], "a temporary file was left behind");
    assert_eq!(fs::read_to_string(path.join("inside")).unwrap(), "kept");
}
