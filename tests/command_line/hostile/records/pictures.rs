//! Pictures, truths and frames with huge claims, missing numbers or another shape.

use std::fs;
use std::io::Write;
use std::process::Output;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use frame::{ExrFile, Frame, Samples, Truth, read_exr, write_exr};

use crate::sandbox::{Sandbox, assert_done, assert_refused};

const TRUTH: &str = "out/plate/truth_trailing.exr";
const FRAME: &str = "out/plate/frame.exr";
const LADDER: &str = "out/plate/ladder_trailing";
const RUNG: &str = "out/plate/ladder_trailing/n4.exr";
const OUTPUT: &str = "out/plate/identity_default/output.exr";

fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    assert_done(&sandbox.run(&["--filters", "identity"]));
    sandbox
}

fn score(sandbox: &Sandbox, image: &str) -> Output {
    sandbox.shuttertruth(&[
        "score", "--truth", TRUTH, "--frame", FRAME, "--ladder", LADDER, "--image", image,
    ])
}

/// Content of an OpenEXR header.
struct Claim {
    names: Vec<String>,
    size: [i32; 2],
    place: [i32; 2],
    display: [i32; 2],
    sampling: i32,
    /// Bits of the version: 0x800 is deep data.
    flags: u32,
}

impl Default for Claim {
    fn default() -> Self {
        Self {
            names: ["B", "G", "R"].map(str::to_owned).to_vec(),
            size: [64, 32],
            place: [0, 0],
            display: [64, 32],
            sampling: 1,
            flags: 0,
        }
    }
}

impl Claim {
    /// Writes a file of uncompressed zeros, or only `rest` bytes after the header.
    fn write(&self, sandbox: &Sandbox, name: &str, rest: Option<usize>) {
        let mut bytes = vec![0x76, 0x2f, 0x31, 0x01];
        bytes.extend((2 | self.flags).to_le_bytes());
        let mut attribute = |name: &str, kind: &str, value: &[u8]| {
            for text in [name, kind] {
                bytes.extend(text.bytes().chain([0]));
            }
            bytes.extend((value.len() as u32).to_le_bytes());
            bytes.extend(value);
        };
        let ints =
            |all: &[i32]| -> Vec<u8> { all.iter().flat_map(|one| one.to_le_bytes()).collect() };
        let mut channels = Vec::new();
        for name in &self.names {
            channels.extend(name.bytes().chain([0]));
            channels.extend(ints(&[2, 0, self.sampling, self.sampling]));
        }
        channels.push(0);
        attribute("channels", "chlist", &channels);
        attribute("compression", "compression", &[0]);
        let window = |[x, y]: [i32; 2], [w, h]: [i32; 2]| ints(&[x, y, x + w - 1, y + h - 1]);
        attribute("dataWindow", "box2i", &window(self.place, self.size));
        attribute("displayWindow", "box2i", &window([0, 0], self.display));
        attribute("lineOrder", "lineOrder", &[0]);
        attribute("pixelAspectRatio", "float", &1f32.to_le_bytes());
        attribute("screenWindowCenter", "v2f", &[0; 8]);
        attribute("screenWindowWidth", "float", &1f32.to_le_bytes());
        if self.flags != 0 {
            attribute("type", "string", b"deepscanline");
            attribute("version", "int", &ints(&[1]));
            attribute("chunkCount", "int", &ints(&[self.size[1]]));
            attribute("name", "string", b"part");
        }
        bytes.push(0);
        match rest {
            Some(rest) => bytes.resize(bytes.len() + rest, 0),
            None => {
                let row = 4 * self.names.len() * self.size[0] as usize;
                let first = bytes.len() + 8 * self.size[1] as usize;
                for y in 0..self.size[1] as usize {
                    bytes.extend(((first + y * (8 + row)) as u64).to_le_bytes());
                }
                for y in 0..self.size[1] {
                    bytes.extend(ints(&[self.place[1] + y, row as i32]));
                    bytes.resize(bytes.len() + row, 0);
                }
            }
        }
        fs::write(sandbox.path(name), bytes).unwrap();
    }
}

/// Makes a PNG whose header claims this many pixels, and whose rows are missing.
fn png(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |kind: &[u8], data: &[u8]| {
        bytes.extend((data.len() as u32).to_be_bytes());
        let mut checked = flate2::Crc::new();
        for part in [kind, data] {
            checked.update(part);
            bytes.extend(part);
        }
        bytes.extend(checked.sum().to_be_bytes());
    };
    let mut header = [width.to_be_bytes(), height.to_be_bytes()].concat();
    header.extend([16, 2, 0, 0, 0]);
    chunk(b"IHDR", &header);
    let mut rows = ZlibEncoder::new(Vec::new(), Compression::best());
    rows.write_all(&vec![0; 1 << 20]).unwrap();
    chunk(b"IDAT", &rows.finish().unwrap());
    chunk(b"IEND", &[]);
    bytes
}

#[test]
fn headers_with_huge_claims_are_refused_before_allocation() {
    let sandbox = set_up();
    let whole = Claim::default;
    whole().write(&sandbox, "whole.exr", None);
    assert_done(&score(&sandbox, "whole.exr"));
    for (claim, rest, found) in [
        (
            Claim {
                size: [100_000, 100_000],
                ..whole()
            },
            Some(800_000),
            "claims 100000x100000 pixels; allowed: 1 to 16384 columns and rows",
        ),
        (
            Claim {
                size: [16_384, 16_384],
                ..whole()
            },
            Some(131_072),
            "3221225472 bytes in memory, in a file of",
        ),
        (
            Claim {
                names: (0..40_000).map(|at| format!("c{at:05}")).collect(),
                ..whole()
            },
            Some(256),
            "claims 40000 channels; allowed: up to 32768",
        ),
        (
            Claim {
                sampling: 2,
                ..whole()
            },
            Some(4096),
            "cannot be read: channel subsampling",
        ),
        (
            Claim {
                flags: 0x800,
                ..whole()
            },
            Some(4096),
            "deep data",
        ),
        (
            Claim {
                place: [3, 2],
                display: [100, 100],
                ..whole()
            },
            None,
            "its data window of 64x32 pixels from (3, 2) is not its display window of 100x100",
        ),
    ] {
        claim.write(&sandbox, "claim.exr", rest);
        assert_refused(&score(&sandbox, "claim.exr"), 2, &["claim.exr", found]);
    }
    fs::write(sandbox.path("bomb.png"), png(20_000, 20_000)).unwrap();
    assert_refused(
        &score(&sandbox, "bomb.png"),
        2,
        &["bomb.png: claims 20000x20000 pixels; allowed: up to 33554432"],
    );
    assert_refused(&score(&sandbox, "out"), 2, &["out: cannot be scored"]);
    #[cfg(unix)]
    for (name, target) in [("zero.exr", "/dev/zero"), ("zero.png", "/dev/zero")] {
        std::os::unix::fs::symlink(target, sandbox.path(name)).unwrap();
        assert_refused(&score(&sandbox, name), 2, &[name, "regular file"]);
    }
}

/// Applies `change` to a file of the run, and writes it with a valid checksum.
fn alter(sandbox: &Sandbox, path: &str, change: impl FnOnce(&mut ExrFile)) {
    let mut file = read_exr(&sandbox.path(path)).unwrap();
    change(&mut file);
    write_exr(&sandbox.path(path), &file).unwrap();
}

/// Asserts that both commands that read pictures of a run refuse it with these words.
fn assert_both_refuse(sandbox: &Sandbox, found: &str) {
    assert_refused(&score(sandbox, OUTPUT), 2, &[found]);
    let report = sandbox.shuttertruth(&["report", "out", "--html", "page.html"]);
    assert_refused(&report, 2, &[found]);
    assert!(!sandbox.path("page.html").exists());
}

#[test]
fn a_truth_or_frame_with_missing_or_invalid_numbers_is_refused() {
    let sandbox = set_up();
    for path in [TRUTH, FRAME] {
        let whole = fs::read(sandbox.path(path)).unwrap();
        let names: Vec<String> = (read_exr(&sandbox.path(path)).unwrap().channels.iter())
            .filter(|channel| matches!(channel.samples, Samples::F32(_)))
            .map(|channel| channel.name.clone())
            .collect();
        // All layers pass through the same check, so a few of each file are enough.
        for name in names.iter().step_by(7) {
            alter(&sandbox, path, |file| {
                let channel = file
                    .channels
                    .iter_mut()
                    .find(|channel| channel.name == *name);
                if let Samples::F32(samples) = &mut channel.unwrap().samples {
                    samples[64 + 5] = f32::NAN;
                }
            });
            let found = format!("{path}: channel \"{name}\" holds NaN at pixel (5, 1)");
            assert_refused(&score(&sandbox, OUTPUT), 2, &[&found]);
            fs::write(sandbox.path(path), &whole).unwrap();
        }
        alter(&sandbox, path, |file| {
            file.channels
                .retain(|channel| !channel.name.starts_with("coverage") && channel.name != "A.G");
        });
        assert_refused(&score(&sandbox, OUTPUT), 2, &[path, "lacks the channel"]);
        fs::write(sandbox.path(path), whole).unwrap();
    }
    for (path, name, value, found) in [
        (
            FRAME,
            "guard_band",
            "4000000000",
            "\"guard_band\" holds 4000000000; allowed: less than half of 64x32",
        ),
        (FRAME, "guard_band", "16", "less than half of 64x32"),
        (FRAME, "exposure", "1e50", "exposure is 1e50 frames"),
        (FRAME, "exposure", "NaN", "exposure is NaN frames"),
        (FRAME, "flip_stop", "3e38", "display: flip stop = 3"),
        (
            FRAME,
            "flip_count",
            "400",
            "display: flip has 400 exposures; allowed: 2 to 128",
        ),
        (FRAME, "display_stops", "150", "stops from -32 to 32"),
        (FRAME, "objects", "", "attribute \"objects\" is empty"),
        (
            TRUTH,
            "objects",
            "background background",
            "names \"background\" twice",
        ),
        (TRUTH, "shutter_open", "-1e50", "exposure is 1e50 frames"),
        (TRUTH, "seed", "-1", "attribute \"seed\" holds \"-1\""),
        (RUNG, "subframes", "0 1", "out of order"),
        (RUNG, "subframes", "", "\"subframes\" is empty"),
        (RUNG, "content_hash", "0", "belongs to another ladder"),
    ] {
        let whole = fs::read(sandbox.path(path)).unwrap();
        alter(&sandbox, path, |file| file.set(name, value));
        assert_refused(&score(&sandbox, OUTPUT), 2, &[path, found]);
        fs::write(sandbox.path(path), whole).unwrap();
    }
}

/// Adds two pixels to every side of the file.
fn pad(file: &mut ExrFile) {
    let (width, height) = (file.width as usize, file.height as usize);
    fn grow<T: Copy>(samples: &[T], width: usize, height: usize) -> Vec<T> {
        let inside = |at: usize, size: usize| at.saturating_sub(2).min(size - 1);
        (0..height + 4)
            .flat_map(|y| (0..width + 4).map(move |x| (x, y)))
            .map(|(x, y)| samples[inside(y, height) * width + inside(x, width)])
            .collect()
    }
    for channel in &mut file.channels {
        channel.samples = match &channel.samples {
            Samples::F32(samples) => Samples::F32(grow(samples, width, height)),
            Samples::U32(samples) => Samples::U32(grow(samples, width, height)),
        };
    }
    (file.width, file.height) = (file.width + 4, file.height + 4);
}

#[test]
fn files_of_another_size_or_of_other_objects_are_refused() {
    let sandbox = set_up();
    for (path, found) in [(TRUTH, "68x36"), (FRAME, "68x36")] {
        let whole = fs::read(sandbox.path(path)).unwrap();
        alter(&sandbox, path, pad);
        assert_both_refuse(&sandbox, found);
        let layers = sandbox.shuttertruth(&["report", "out", "--exr", "layers"]);
        assert_refused(&layers, 2, &[found]);
        fs::write(sandbox.path(path), whole).unwrap();
    }
    let page = ["report", "out", "--html", "page.html"];
    for name in ["output.exr", "errors.exr"] {
        let path = format!("out/plate/identity_default/{name}");
        let whole = fs::read(sandbox.path(&path)).unwrap();
        alter(&sandbox, &path, pad);
        assert_refused(&sandbox.shuttertruth(&page), 2, &["68x36"]);
        let layers = sandbox.shuttertruth(&["report", "out", "--exr", "layers"]);
        assert_refused(&layers, 2, &["68x36"]);
        fs::write(sandbox.path(&path), whole).unwrap();
    }
    let path = sandbox.path(TRUTH);
    let mut other = Truth::read(&path).unwrap();
    other.objects[1] = "other".to_owned();
    other.write(&path).unwrap();
    assert_both_refuse(&sandbox, "other");
}

#[test]
fn pictures_with_invalid_numbers_are_refused_or_shown() {
    let sandbox = set_up();
    for (name, is_refused) in [("errors.exr", false), ("output.exr", true)] {
        alter(
            &sandbox,
            &format!("out/plate/identity_default/{name}"),
            |file| {
                for channel in &mut file.channels {
                    if let Samples::F32(samples) = &mut channel.samples {
                        samples[64 * 16 + 30..64 * 16 + 40].fill(f32::NAN);
                    }
                }
            },
        );
        let report = sandbox.shuttertruth(&["report", "out", "--html", "page.html"]);
        match is_refused {
            true => assert_refused(&report, 2, &[name, "holds NaN at pixel (30, 16)"]),
            false => assert_done(&report),
        }
    }
}

#[test]
fn radiance_whose_square_overflows_is_refused_with_its_place() {
    let sandbox = set_up();
    alter(&sandbox, OUTPUT, |file| {
        let red = file.channels.iter_mut().find(|channel| channel.name == "R");
        if let Samples::F32(samples) = &mut red.unwrap().samples {
            samples[2 * 64 + 9] = 1e30;
        }
    });
    assert_refused(
        &score(&sandbox, OUTPUT),
        2,
        &[
            "the colour of the output holds 1",
            "at pixel (9, 2)",
            "at most",
        ],
    );
    assert!(Frame::read(&sandbox.path(FRAME)).is_ok());
}
