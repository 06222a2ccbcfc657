//! Scenes at other frame rates than their files'.

use frame::{Alignment, Frame, Truth, VelocityKind};
use scene::{FrameRate, Scene, load_scene};
use tests::text::assert_contains;
use tests::{settings, unwatched};
use tracer::{RenderSettings, trace_frame, trace_truth};

use crate::{Folder, load_shipped, shipped};

const WIDTH: u32 = 64;
const HEIGHT: u32 = 18;
/// Motion of the bar at 60 frames per second, in pixels per frame.
const SPEED: f64 = 8.0;
/// Width of the bar, in pixels.
const BAR: f64 = 5.5;

/// Samples per pixel of pictures that are compared bit for bit.
const FEW: u32 = 16;

fn render_frame(scene: &Scene, velocity: VelocityKind) -> Frame {
    let mut settings = settings([WIDTH, HEIGHT], FEW);
    settings.options.velocity = velocity;
    trace_frame(scene, &settings, &unwatched).unwrap()
}

fn render_truth(scene: &Scene, samples: u32, alignment: Alignment) -> Truth {
    let settings = settings([WIDTH, HEIGHT], samples);
    trace_truth(scene, &settings, alignment, &unwatched).unwrap()
}

/// Measures the middle of the bar's smear, in pixels right of the picture's, and its length without
/// the bar.
fn measure_smear(truth: &Truth) -> [f64; 2] {
    let coverage = &truth.mean().coverage[1];
    let mut moments = [0.0; 3];
    for y in 0..HEIGHT {
        for x in 0..WIDTH {
            let place = f64::from(x) + 0.5 - 0.5 * f64::from(WIDTH);
            for (power, moment) in moments.iter_mut().enumerate() {
                *moment += f64::from(*coverage.at(x, y)) * place.powi(power as i32);
            }
        }
    }
    let middle = moments[1] / moments[0];
    // Squared widths of boxes add up: the bar's, the smear's and the pixel's.
    let width = 12.0 * (moments[2] / moments[0] - middle * middle);
    [middle, (width - BAR * BAR - 1.0).max(0.0).sqrt()]
}

#[test]
fn a_bar_smears_by_its_speed_and_the_shutter_of_each_rate() {
    let folder = tests::root().join("tests/fixtures/bar");
    for (variant, length) in [
        // Half of a frame of 20, 8 and 3.33 pixels.
        ("24fps", 10.0),
        ("60fps", 4.0),
        ("144fps", 0.5 * SPEED * 60.0 / 144.0),
        // A 48th of a second, in which 60 frames of 8 pixels make 10, is 0.5, 1.25 and 3 frames.
        ("24fps_1-48s", 10.0),
        ("60fps_1-48s", 10.0),
        ("144fps_1-48s", 10.0),
        ("144fps_1-120s", 4.0),
    ] {
        let scene = load_scene(&folder, Some(variant)).unwrap();
        for (alignment, side) in [(Alignment::Trailing, -0.5), (Alignment::Centred, 0.0)] {
            let [middle, actual] = measure_smear(&render_truth(&scene, 64, alignment));
            // Some 4 sigma at 64 samples per pixel.
            assert!(
                (actual - length).abs() < 0.1,
                "{variant}: {actual} {length}"
            );
            let off = middle - side * length;
            assert!(off.abs() < 0.05, "{variant}: {off}");
        }
        let rate = FrameRate::in_word(variant).unwrap();
        let step = SPEED * 60.0 / rate.per_second;
        for kind in [VelocityKind::Instantaneous, VelocityKind::PreviousFrame] {
            let frame = render_frame(&scene, kind);
            let [right, down] = *frame.velocity.at(WIDTH / 2, HEIGHT / 2);
            assert!((f64::from(right) - step).abs() < 1e-3, "{variant}: {right}");
            assert!(down.abs() < 1e-3);
            assert!((frame.exposure * step - length).abs() < 1e-9, "{variant}");
            let kept_rate = Some(rate.per_second).filter(|rate| *rate != 60.0);
            assert_eq!(frame.frames_per_second, kept_rate);
        }
    }
}

/// Compares a scene at the rate of its file with the scene without a rate.
fn assert_same_at_60(name: &str) {
    let at_60 = format!("{name}@60fps");
    let [plain, same] = [name, &at_60].map(load_shipped);
    assert_ne!(plain.hash, same.hash);
    assert_eq!(same.id.to_string(), at_60);
    let frame = |scene| render_frame(scene, VelocityKind::Instantaneous);
    assert_same_frame(&frame(&plain), &frame(&same), name);
    let truth = |scene| render_truth(scene, FEW, Alignment::Trailing);
    assert_same_truth(&truth(&plain), &truth(&same), name);
}

#[test]
fn at_60_frames_per_second_a_scene_is_as_its_file_says() {
    assert_same_at_60("fan");
    assert_same_at_60("sliding_panel@seal7");
}

#[test]
#[ignore = "prove: all scenes of the catalogue"]
fn at_60_frames_per_second_every_scene_is_as_its_file_says() {
    shipped().iter().for_each(|name| assert_same_at_60(name));
}

fn assert_same_frame(one: &Frame, other: &Frame, what: &str) {
    let mut other = other.clone();
    (other.provenance, other.frames_per_second) = (one.provenance.clone(), one.frames_per_second);
    assert!(*one == other, "{what}: the frames differ");
}

fn assert_same_truth(one: &Truth, other: &Truth, what: &str) {
    let mut other = other.clone();
    other.provenance = one.provenance.clone();
    assert!(*one == other, "{what}: the truths differ");
}

/// Writes a scene of paths, key shapes, a moving camera that zooms, and a rolling shutter. All its
/// times are multiplied by `times`.
fn write_paths(folder: &Folder, times: f64, exposure: f64) {
    let mesh = folder.read("mesh.obj");
    folder.write("moved.obj", mesh.replace("v 1 1 0", "v 1.4 1.2 0.3"));
    folder.write("bent.obj", mesh.replace("v 1 1 0", "v 1.5 0.8 -0.2"));
    let text = include_str!("../fixtures/paths/scene.toml");
    let mut parts = text.split("time = ");
    let head = parts.next().expect("a first part");
    let head = head.replace("rolling = 0.1", &format!("rolling = {:?}", 0.1 * times));
    let mut scene = head.replace("exposure = 0.5", &format!("exposure = {exposure:?}"));
    for part in parts {
        let (time, rest) = part.split_once(',').expect("a key's time is first");
        let time: f64 = time.parse().expect("a number");
        scene += &format!("time = {:?},{rest}", time * times);
    }
    folder.write("scene.toml", scene);
}

#[test]
fn a_scene_at_a_rate_is_the_scene_with_its_times_written_for_it() {
    for (variant, exposure) in [
        ("24fps", 0.5),
        ("144fps", 0.5),
        ("23.976fps", 0.5),
        ("144fps_1-48s", 3.0),
        ("48fps_1-96s", 0.5),
    ] {
        let rate = FrameRate::in_word(variant).unwrap();
        let folder = Folder::new();
        write_paths(&folder, 1.0, 0.5);
        let made = load_scene(&folder.path, Some(variant)).unwrap();
        write_paths(&folder, rate.frames_per_written_frame(), exposure);
        let written = folder.load().unwrap();
        for kind in [VelocityKind::Instantaneous, VelocityKind::PreviousFrame] {
            let [made, written] = [&made, &written].map(|scene| render_frame(scene, kind));
            assert_same_frame(&made, &written, variant);
        }
        for alignment in [Alignment::Trailing, Alignment::Centred] {
            let [made, written] =
                [&made, &written].map(|scene| render_truth(scene, FEW, alignment));
            assert_same_truth(&made, &written, variant);
        }
    }
}

#[test]
fn frames_of_a_sequence_follow_at_the_rate() {
    // The second frame at 120 frames per second is the first one at 60.
    let folder = Folder::new();
    write_paths(&folder, 1.0, 0.5);
    let [plain, fast] =
        [None, Some("120fps")].map(|variant| load_scene(&folder.path, variant).unwrap());
    let mut fast = fast.at_frame(2);
    assert_eq!(fast.id.to_string(), "square@120fps/0002");
    // The shutters have to be open for the same time, since samples are chosen for that time.
    fast.exposure = 2.0 * plain.exposure;
    let [one, other] =
        [plain.at_frame(1), fast].map(|scene| render_frame(&scene, VelocityKind::Instantaneous));
    assert_eq!(one.depth, other.depth);
    assert_eq!(one.color, other.color);
    for (one, other) in one.velocity.pixels.iter().zip(&other.velocity.pixels) {
        // The quotient of differences is over half the time.
        let off = [0, 1].map(|axis| (one[axis] - 2.0 * other[axis]).abs());
        assert!(off.iter().all(|off| *off < 1e-3), "{one:?} {other:?}");
    }
}

#[test]
fn every_rate_has_a_name_and_a_hash_of_its_own() {
    let folder = Folder::new();
    let variants = "24fps 24fps_1-48s 24fps_1-50s 23.976fps fast@24fps unlit@24fps seal7@24fps";
    let variants = std::iter::once(None).chain(variants.split(' ').map(Some));
    let scenes = variants.map(|variant| load_scene(&folder.path, variant).unwrap());
    let scenes: Vec<Scene> = scenes.collect();
    for (index, scene) in scenes.iter().enumerate() {
        let others = scenes[..index].iter();
        assert!(others.clone().all(|other| other.hash != scene.hash));
        assert_eq!(scene.id.rate.unwrap_or_default(), scene.rate());
        assert_eq!(scene.written_exposure, 0.5);
    }
    assert_eq!(scenes[5].id.to_string(), "square@fast@24fps");
    assert_eq!([scenes[1].exposure, scenes[2].exposure], [0.5; 2]);
    // A sealed variant changes the scene of the file, and then the rate.
    let keys = |scene: &Scene| scene.objects[0].motion.keys[0].time;
    let sealed = load_scene(&folder.path, Some("seal7")).unwrap();
    assert_eq!(keys(&scenes[7]), keys(&sealed) * (24.0 / 60.0));
}

#[test]
fn times_beyond_the_keys_are_refused() {
    let check = |variant: &str, alignment| {
        let scene = load_shipped(&format!("flag@{variant}"));
        let settings = RenderSettings::default();
        let truth = settings.check_truth(&scene, alignment).map(drop);
        truth.err().map(|error| error.to_string())
    };
    // The shapes go from -1 to 1 of 60 frames per second: from -0.4 to 0.4 of 24, and from -2.4 to
    // 2.4 of 144.
    assert_eq!(check("144fps", Alignment::Trailing), None);
    assert_eq!(check("24fps", Alignment::Centred), None);
    for (variant, parts) in [
        ("24fps", ["at frame -0.5", "begin at frame -0.4"]),
        ("144fps_1-48s", ["at frame -3,", "begin at frame -2.4"]),
    ] {
        let text = check(variant, Alignment::Trailing).unwrap();
        assert_contains(&text, &[variant, "the shapes of object cloth"]);
        assert_contains(&text, &parts);
    }
    let text = check("24fps", Alignment::Leading).unwrap();
    assert!(text.contains("end at frame 0.4"), "{text}");
    // Times that the velocity since the previous frame needs are refused as well.
    let scene = load_shipped("flag@24fps");
    let mut settings = RenderSettings::default();
    assert!(settings.check_frame(&scene).is_ok());
    settings.options.velocity = VelocityKind::PreviousFrame;
    assert!(settings.check_frame(&scene).is_err());
}

/// Names of variants, and a part of the message.
const BAD_RATES: [(&str, &str); 6] = [
    ("0fps", "0 frames per second; allowed: 1 to 1000"),
    ("-24fps", "-24 frames per second; allowed"),
    ("2000fps", "2000 frames per second; allowed"),
    (
        "24fps_1-0s",
        "a shutter time of 1/0 s; allowed: 1/1 to 1/100000",
    ),
    ("24fps@24fps", r#"variant "24fps" is unknown"#),
    ("slow@24fps", r#"variant "slow" is unknown"#),
];

#[test]
fn names_that_are_no_rates_are_refused() {
    let folder = Folder::new();
    for (variant, part) in BAD_RATES {
        let refused = load_scene(&folder.path, Some(variant)).unwrap_err();
        assert_contains(&refused.to_string(), &[part]);
    }
}
