//! Measured smears: length, side and direction, in words.

use std::fs;

use frame::Alignment;
use metrics::{Smear, SmearDirection};
use tests::filter_folder::copy_folder;
use tests::root;
use tests::text::{assert_contains, squeeze};

use crate::sandbox::Sandbox;

/// Size and noise of every run.
const RUN: &str = "run --quiet --jitter-frames 0 --samples-per-pixel 16 --size 96x54 --out out";

/// The panel of every run: it moves 9.6 pixels during the exposure at this size.
const PANEL: &str = "sliding_panel@128px_0deg";

const MANIFEST: &str = r#"
summary = "Averages colours along a part of the motion."

[[parameter]]
name = "first"
kind = "real"
default = 0.0
range = [-2.0, 2.0]
doc = "Start, in exposures ahead of the pixel."

[[parameter]]
name = "last"
kind = "real"
default = 1.0
range = [-2.0, 2.0]
doc = "End, in exposures."

[[parameter]]
name = "turned"
kind = "real"
default = 0.0
range = [0.0, 2.0]
doc = "1 exchanges x and y, 2 turns y round."

[[pass]]
entry = "blur"
"#;

const KERNEL: &str = "
struct Parameters { first: f32, last: f32, turned: f32 }
@group(0) @binding(1) var<uniform> parameters: Parameters;
@group(0) @binding(2) var color: texture_2d<f32>;
@group(0) @binding(3) var velocity: texture_2d<f32>;
@group(0) @binding(4) var output: texture_storage_2d<rgba32float, write>;

@compute @workgroup_size(8, 8)
fn blur(@builtin(global_invocation_id) id: vec3<u32>) {
    let pixel = vec2<i32>(id.xy);
    if !inside(pixel) { return; }
    var trail = frame.exposure * textureLoad(velocity, pixel, 0).xy;
    if parameters.turned == 1.0 { trail = trail.yx; }
    if parameters.turned == 2.0 { trail.y = -trail.y; }
    var sum = vec4<f32>(0.0);
    for (var tap = 0; tap < 48; tap++) {
        let part = (f32(tap) + 0.5) / 48.0;
        sum += bilinear(color, centre(pixel) + mix(parameters.first, parameters.last, part) * trail);
    }
    textureStore(output, pixel, sum / 48.0);
}
";

/// Writes the filter `<alignment>_blur`.
fn write_blur(sandbox: &Sandbox, alignment: Alignment) -> String {
    let name = format!("{alignment}_blur");
    let manifest = format!("name = \"{name}\"\nalignment = \"{alignment}\"\n{MANIFEST}");
    sandbox.write_filter(&name, &manifest, KERNEL);
    name
}

/// Part of a trail, how it is turned, the declared shutter, and the verdict.
type Mistake = ([f64; 2], u32, Alignment, &'static str);

const MISTAKES: [Mistake; 10] = [
    (
        [0.0, 1.0],
        0,
        Alignment::Trailing,
        "right: as long as the exposure, behind the mover",
    ),
    (
        [-0.5, 0.5],
        0,
        Alignment::Centred,
        "right: as long as the exposure, on both sides",
    ),
    (
        [-1.0, 0.0],
        0,
        Alignment::Leading,
        "right: as long as the exposure, ahead of the mover",
    ),
    (
        [0.0, 0.5],
        0,
        Alignment::Trailing,
        "too short: multiply the intensity by 2.",
    ),
    (
        [-1.0, 1.0],
        0,
        Alignment::Centred,
        "too long: multiply the intensity by 0.5",
    ),
    (
        [-1.0, 0.0],
        0,
        Alignment::Trailing,
        "runs against the motion, ahead of the mover: change the sign of the velocity",
    ),
    (
        [0.0, 1.0],
        0,
        Alignment::Centred,
        "one-sided, behind the mover: centre the taps, or declare alignment = \"trailing\"",
    ),
    (
        [-0.5, 0.5],
        0,
        Alignment::Trailing,
        "lies on both sides: declare alignment = \"centred\"",
    ),
    (
        [-0.5, 0.5],
        1,
        Alignment::Centred,
        "runs across the motion: exchange x and y of the velocity",
    ),
    (
        [0.0, 0.0],
        0,
        Alignment::Centred,
        "no smear: the filter changes nothing",
    ),
];

/// Blurs of three passes: a factor on the length of the trail, and the verdict.
const THREE_PASSES: [(&str, &str); 3] = [
    ("0.5", "too short: multiply the intensity by 2."),
    ("1.0", "right:"),
    ("2.0", "too long: multiply the intensity by 0.5"),
];

/// Makes a sandbox with a run of all mistakes, and of the blurs of three passes; its output is in
/// the file `printed`.
fn measured() -> Sandbox {
    Sandbox::once(|sandbox| {
        let mut names = write_mistakes(sandbox);
        for (number, (strength, _)) in THREE_PASSES.into_iter().enumerate() {
            let name = format!("tiles_{number}");
            copy_folder(&root().join(TILES), &sandbox.path(&name));
            let manifest = format!("{name}/filter.toml");
            sandbox.edit(&manifest, "\"godot_tiles\"", &format!("\"{name}\""));
            let default = |strength: &str| {
                format!("name = \"strength\"\nkind = \"real\"\ndefault = {strength}")
            };
            sandbox.edit(&manifest, &default("1.0"), &default(strength));
            names.push(format!("./{name}"));
        }
        fs::remove_dir_all(sandbox.path("scenes")).unwrap();
        let filters = names.join(",");
        let printed = sandbox.done(&format!("{RUN} --scenes {PANEL} --filter {filters}"));
        sandbox.put("printed", printed);
    })
}

/// An example of three passes.
const TILES: &str = "examples/first_blur/godot_tiles";

/// Writes a filter for each mistake; returns their folders.
fn write_mistakes(sandbox: &Sandbox) -> Vec<String> {
    let mut names = Vec::new();
    for (number, ([first, last], turned, alignment, _)) in MISTAKES.into_iter().enumerate() {
        let name = format!("blur_{number}");
        let head = format!("name = \"{name}\"\nalignment = \"{alignment}\"\n");
        let mut parts = MANIFEST.split("\ndefault = ");
        let mut manifest = head + parts.next().unwrap();
        for (part, value) in parts.zip([first, last, f64::from(turned)]) {
            let (_, rest) = part.split_once('\n').unwrap();
            manifest += &format!("\ndefault = {value:?}\n{rest}");
        }
        sandbox.write_filter(&name, &manifest, KERNEL);
        names.push(format!("./{name}"));
    }
    names
}

/// Checks the verdict on the smear of a filter.
#[track_caller]
fn assert_verdict(text: &str, filter: &str, verdict: &str) {
    let (_, smears) = text.split_once("smear over the exposure").unwrap();
    let words = squeeze(smears);
    let (_, row) = words.split_once(&format!("{filter}:default ")).unwrap();
    let row = row.split(":default").next().unwrap();
    assert_contains(row, &[verdict]);
}

#[test]
fn every_wrong_length_side_and_direction_has_its_verdict() {
    let text = measured().text("printed");
    for (number, (.., verdict)) in MISTAKES.into_iter().enumerate() {
        assert_verdict(&text, &format!("blur_{number}"), verdict);
    }
}

#[test]
fn up_and_down_exchanged_show_in_slanted_motion() {
    let sandbox = Sandbox::of(&Vec::new());
    let name = write_blur(&sandbox, Alignment::Trailing);
    let line = format!("{RUN} --scenes sliding_panel@128px_30deg --filter ./{name}");
    sandbox.done(&line);
    let right = sandbox.read_filter_cases()[0].smear.unwrap();
    assert_eq!(right.direction, SmearDirection::Along);
    assert!(right.is_right(Alignment::Trailing), "{right:?}");
    let text = sandbox.done(&format!("{line} --set {name}.turned=2"));
    assert_contains(&text, &["up and down exchanged"]);
}

#[test]
fn a_right_blur_of_three_passes_is_not_halved() {
    // A run prints the smears of twelve filters at most, so another one reads these back.
    let filters = "./tiles_0,./tiles_1,./tiles_2";
    let text = measured().done(&format!("{RUN} --scenes {PANEL} --filter {filters}"));
    for (number, (_, verdict)) in THREE_PASSES.into_iter().enumerate() {
        assert_verdict(&text, &format!("tiles_{number}"), verdict);
    }
}

/// Blurs that are right by their own references: a gather, a jump flood, tiles, and engines' ways of
/// each.
const GOOD: [&str; 9] = [
    "velocity_gather:fine",
    "jump_flood:corrected",
    "jimenez:slides_2014",
    "jimenez:hdrp",
    "kino:mended",
    "godot:mended",
    "bevy:high",
    "urp:high",
    "blender:compositor",
];

#[test]
#[ignore = "prove: nine blurs; every run has one of each side, and one of three passes"]
fn good_blurs_of_each_kind_are_right() {
    let sandbox = Sandbox::of(&Vec::new());
    // Tiles of 16 and 32 pixels need more than three of them in a row.
    let run = RUN.replace("96x54", "192x108");
    let text = sandbox.done(&format!(
        "{run} --scenes sliding_panel@64px_0deg --filter {}",
        GOOD.join(",")
    ));
    let cases = sandbox.read_filter_cases();
    assert_eq!(cases.len(), GOOD.len());
    for case in cases {
        let smear: Smear = case.smear.unwrap();
        assert!(smear.is_right(case.alignment), "{}: {smear:?}", case.name());
        // An eighth of the exposure: the shortest of them, kino's, rounds its tiles.
        assert!(
            (smear.length() - 1.0).abs() < 0.13,
            "{}: {smear:?}",
            case.name()
        );
    }
    assert_eq!(
        text.matches("right: as long as the exposure").count(),
        GOOD.len()
    );
}

#[test]
fn a_finished_picture_has_the_smear_of_its_filter() {
    let sandbox = measured();
    let scene = format!("out/{PANEL}");
    let cases = sandbox.read_filter_cases();
    // The fourth mistake is a trail half as long as the exposure.
    let case = cases.iter().find(|case| case.filter == "blur_3").unwrap();
    let image = case.folder.join("output.png");
    let line = format!(
        "score --truth {scene}/truth_trailing.exr --frame {scene}/frame.exr --image out/{}",
        image.display()
    );
    assert_contains(
        &sandbox.done(&line),
        &["smear: 0.4", "multiply the intensity by 2."],
    );
}

#[test]
fn lengths_of_all_built_in_filters_and_of_other_scenes_are_not_printed() {
    let sandbox = Sandbox::gathered();
    let text = sandbox
        .done("run --out out --size 64x32 --samples-per-pixel 16 --filters velocity_gather:fine");
    assert!(!text.contains("smear over the exposure"), "{text}");
}
