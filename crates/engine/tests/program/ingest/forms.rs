//! Forms of an engine's files: one file of Blender's passes, and raw dumps; allowed and refused
//! uses of an ingested folder.

use std::fs;

use frame::{ExrFile, Frame, Image, Plane, Raster, Vectors, read_exr, write_exr};
use half::f16;
use tests::text::assert_contains;

use super::capture::{Capture, DESCRIPTION, HEIGHT, WIDTH};
use super::{OUT, ingest};
use crate::sandbox::{Sandbox, split, stderr};

const INGEST: &str = "engine ingest capture -o out/engine/mine";
/// Names of the buffers' files, and of Blender's passes.
const BUFFERS: [(&str, &str); 4] = [
    ("color", "Combined.R Combined.G Combined.B"),
    ("velocity", "Vector.X Vector.Y"),
    ("depth", "Depth.Z"),
    ("object", "IndexOB.X"),
];

/// Takes the buffers out of a capture, and removes their files.
fn take_buffers(capture: &Capture) -> [Vec<Plane>; 4] {
    BUFFERS.map(|(name, passes)| {
        let path = capture.path(&format!("{name}.exr"));
        let file = read_exr(&path).unwrap();
        fs::remove_file(path).unwrap();
        let channels = ["R", "G", "B"].iter().take(split(passes).len());
        match name {
            "object" => vec![capture.frame.object_id.map(|id| *id as f32)],
            _ => channels
                .map(|channel| file.plane(channel).unwrap())
                .collect(),
        }
    })
}

/// Ingests the capture; returns what the frame shows.
fn show(sandbox: &Sandbox) -> (Image, Vectors, Plane, Raster<u32>) {
    ingest(sandbox);
    let frame = Frame::read(&sandbox.path(OUT).join("frame.exr")).unwrap();
    assert!(frame.object_id.pixels.contains(&1), "the plate");
    (frame.color, frame.velocity, frame.depth, frame.object_id)
}

#[test]
fn one_file_of_blender_s_passes_gives_the_same_frame() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let expected = show(&sandbox);
    let mut file = ExrFile::new(WIDTH, HEIGHT);
    for (planes, (_, passes)) in take_buffers(&capture).iter().zip(BUFFERS) {
        for (plane, pass) in planes.iter().zip(split(passes)) {
            file.push_plane(&format!("ViewLayer.{pass}"), plane);
        }
    }
    write_exr(&capture.path("color.exr"), &file).unwrap();
    assert_eq!(show(&sandbox), expected);
    // Blender 5 renamed a pass.
    let mut renamed = file.clone();
    for channel in &mut renamed.channels {
        channel.name = channel.name.replace("IndexOB", "Object Index");
    }
    write_exr(&capture.path("color.exr"), &renamed).unwrap();
    assert_eq!(show(&sandbox), expected);
    // The compositor's copy of the view layer, as Blender adds it.
    let mut both = file.clone();
    both.push_color(
        "Composite.Combined",
        &file.color("ViewLayer.Combined").unwrap(),
    );
    write_exr(&capture.path("color.exr"), &both).unwrap();
    assert_eq!(show(&sandbox), expected);
    // The File Output node has other names.
    for channel in &mut both.channels {
        channel.name = channel
            .name
            .replace("ViewLayer.Combined", "Image")
            .replace("ViewLayer.", "");
        channel.name = channel
            .name
            .replace("Depth.Z", "Depth.V")
            .replace("IndexOB.X", "IndexOB.V");
    }
    both.channels
        .retain(|channel| !channel.name.starts_with("Composite"));
    write_exr(&capture.path("color.exr"), &both).unwrap();
    assert_eq!(show(&sandbox), expected);
    // The file's vectors may lack the last channel of the motion to the next frame. No motion to
    // the next frame is read then.
    both.push_plane("Vector.Z", &expected.2);
    write_exr(&capture.path("color.exr"), &both).unwrap();
    ingest(&sandbox);
    let frame = Frame::read(&sandbox.path(OUT).join("frame.exr")).unwrap();
    assert_eq!(frame.velocity_next, None);
    write_exr(&capture.path("color.exr"), &file).unwrap();
    // Colour may come from a separate render.
    fs::rename(capture.path("color.exr"), capture.path("buffers.exr")).unwrap();
    capture.write_color("color.exr", &capture.frame.color);
    assert_eq!(show(&sandbox), expected);
    file.push_plane("Other.Depth.Z", &expected.2);
    write_exr(&capture.path("buffers.exr"), &file).unwrap();
    let parts = [
        "buffers.exr: has the channels Other.Depth.Z and ViewLayer.Depth.Z, which differ",
        "allowed: one of them",
    ];
    sandbox.refuse(INGEST, &parts);
}

/// Writes the numbers of planes pixel by pixel, as halves from the top row or as floats from the
/// bottom row.
fn dump(planes: &[Plane], is_half: bool) -> Vec<u8> {
    let mut bytes = Vec::new();
    for row in 0..HEIGHT {
        let y = if is_half { row } else { HEIGHT - 1 - row };
        for (x, plane) in (0..WIDTH).flat_map(|x| planes.iter().map(move |plane| (x, plane))) {
            let value = *plane.at(x, y);
            if is_half {
                bytes.extend(f16::from_f32(value).to_le_bytes())
            } else {
                bytes.extend(value.to_le_bytes())
            }
        }
    }
    bytes
}

/// Texts of a capture.toml, their replacements, and parts of the message.
const BAD_LAYOUTS: [(&str, &str, &[&str]); 5] = [
    (
        "height = 54",
        "height = 53",
        &[
            "color.raw: has 31104 bytes; 96x53 pixels of 3 f16 have 30528",
            "its layout in capture.toml",
        ],
    ),
    (
        "components = 2",
        "components = 5",
        &[
            "[raw.velocity] 96x54 pixels of 5 components; allowed: 16 to 16384",
            "1 to 4",
        ],
    ),
    (
        "raw.depth",
        "raw.normal",
        &["[raw.normal]; allowed: color, velocity, velocity_next, velocity_z, depth, object"],
    ),
    (
        "raw.color",
        "extra.color",
        &["capture.toml:5: unknown field `extra`"],
    ),
    (
        r#""f32""#,
        r#""f64""#,
        &["capture.toml:", "unknown variant `f64`"],
    ),
];

#[test]
fn raw_dumps_give_the_same_frame_and_need_their_layout() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox);
    let expected = show(&sandbox);
    let mut described = DESCRIPTION.to_owned();
    for (planes, (name, _)) in take_buffers(&capture).iter().zip(BUFFERS) {
        let is_half = name == "color";
        let form = if is_half {
            "type = \"f16\""
        } else {
            "type = \"f32\"\nfirst_row = \"bottom\""
        };
        let count = planes.len();
        described +=
            &format!("[raw.{name}]\nwidth = 96\nheight = 54\ncomponents = {count}\n{form}\n");
        capture.write(&format!("{name}.raw"), dump(planes, is_half));
    }
    capture.write("capture.toml", &described);
    assert_eq!(show(&sandbox), expected);
    for (from, to, parts) in BAD_LAYOUTS {
        capture.write("capture.toml", described.replace(from, to));
        sandbox.refuse(INGEST, parts);
    }
    capture.write("capture.toml", &described);
    for (name, each) in [("color", 2), ("velocity", 4), ("depth", 4)] {
        let path = capture.path(&format!("{name}.raw"));
        let little = fs::read(&path).unwrap();
        let big = little
            .chunks(each)
            .flat_map(|bytes| bytes.iter().rev().copied());
        fs::write(&path, big.collect::<Vec<u8>>()).unwrap();
        let parts = [
            &*format!("{name}.raw: holds "),
            "big-endian; allowed: little-endian",
            "capture.toml",
        ];
        sandbox.refuse(INGEST, &parts);
        fs::write(&path, little).unwrap();
    }
    capture.write("capture.toml", DESCRIPTION);
    let parts = [
        "color.raw: is a raw dump without a layout",
        "add [raw.color]",
    ];
    sandbox.refuse(INGEST, &parts);
}

#[test]
fn a_capture_without_sub_frames_has_no_truth_to_run_against() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox);
    let told = ingest(&sandbox);
    assert!(told.contains("no sub-frames, and so no truth"), "{told}");
    let words = "run --scenes out/engine/mine";
    sandbox.refuse(words, &["drew no sub-frames", "score"]);
}

/// Commands that ask an engine's picture for what it has not, and parts of the message.
const OTHER_SETTINGS: [(&str, &[&str]); 9] = [
    (
        "run --scenes out/engine/mine --size 64x32",
        &["was drawn at 96x54", "at its own size"],
    ),
    (
        "run --scenes out/engine/mine --exposure 1",
        &["--exposure", "as Test Engine 1.2 drew it"],
    ),
    (
        "run --scenes out/engine/mine --noise 0.01",
        &["--noise", "leave the option out"],
    ),
    (
        "run --scenes out/engine/mine --guard-band 8",
        &["--guard-band", "leave the option out"],
    ),
    (
        "run --scenes out/engine/mine,./out/engine/mine",
        &["is named twice", "rename"],
    ),
    (
        "run --scenes out/engine/mine --filter mcguire",
        &["no filter is left", "trailing shutter"],
    ),
    (
        "run --scenes out/engine/mine --input defect=half,lag",
        &[
            "defect=lag: needs the scene's own motion",
            "zero, double, half, flip_y, jittered",
        ],
    ),
    (
        "truths render --scenes out/engine/mine",
        &["holds what an engine drew", "`run` and `check`"],
    ),
    (
        "limits calibrate --scenes out/engine/mine",
        &["does not change from run to run", "bounds.toml"],
    ),
];

#[test]
fn what_an_engine_drew_is_not_rendered_otherwise() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox).with_subframes(4);
    ingest(&sandbox);
    for (words, parts) in OTHER_SETTINGS {
        let output = sandbox.shuttertruth(&split(words));
        // Notes about omitted filters may come before the refusal.
        let message = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert_contains(&message, parts);
    }
    let begun = sandbox.path("out/mine@Test_Engine_1.2");
    assert!(!begun.exists(), "a run began before it was refused");
}

#[test]
fn files_of_two_captures_are_not_mixed() {
    let sandbox = Sandbox::new();
    let capture = Capture::new(&sandbox).with_subframes(4);
    ingest(&sandbox);
    // Renaming the scene makes no other capture; changing the exposure does.
    capture.write("capture.toml", DESCRIPTION.replace("0.5", "0.25"));
    sandbox.done("engine ingest capture --quiet -o out/engine/other");
    let words = "run --quiet --scenes out/engine/mine --filter identity";
    for name in ["frame.exr", "truth_trailing.exr"] {
        let [path, other] =
            ["mine", "other"].map(|scene| sandbox.path("out/engine").join(scene).join(name));
        let before = fs::read(&path).unwrap();
        fs::copy(other, &path).unwrap();
        let parts = [name, "comes from a different capture", "run `ingest` again"];
        sandbox.refuse(words, &parts);
        fs::write(&path, before).unwrap();
    }
    sandbox.done(words);
    let record = sandbox.text("out/engine/mine/ingested.json");
    let altered = record.replace("\"exposure\": 0.5", "\"exposure\": 0.25");
    assert_ne!(altered, record);
    for (text, reason) in [
        ("{}", "no ingested capture"),
        (&*altered, "an altered one"),
        ("{\"format\": 2}", "has format 2; allowed: 3"),
    ] {
        sandbox.put("out/engine/mine/ingested.json", text);
        let parts = ["ingested.json: ", reason, "make the folder anew"];
        sandbox.refuse(words, &parts);
    }
}

#[test]
fn frames_of_a_run_are_not_overwritten() {
    let sandbox = Sandbox::new();
    Capture::new(&sandbox);
    sandbox.done("truths render --quiet --scenes plate --size 64x32 --samples-per-pixel 16");
    let parts = [
        "out/plate: holds",
        "a frame that was not ingested",
        "new folder",
    ];
    sandbox.refuse("engine ingest capture -o out/plate", &parts);
    let parts = ["holds a scene"];
    sandbox.refuse("engine ingest capture -o scenes/plate", &parts);
}
