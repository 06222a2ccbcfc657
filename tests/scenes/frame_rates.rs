//! Scenes at other frame rates than that of their files.

use frame::{Alignment, Frame, Truth, VelocityKind};
use tests::{scenes, unwatched};
use tracer::{FrameRate, RenderSettings, Scene, list_scenes, load_scene, trace_frame, trace_truth};

use crate::scene_folder::Folder;

const WIDTH: u32 = 64;
const HEIGHT: u32 = 36;
/// Motion of the bar at 60 frames per second, in pixels per frame.
const SPEED: f64 = 8.0;
/// Width of the bar, in pixels.
const BAR: f64 = 5.5;

fn settings() -> RenderSettings {
    RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        samples_per_pixel: 256,
        ..RenderSettings::default()
    }
}

fn render_frame(scene: &Scene, velocity: VelocityKind) -> Frame {
    let mut settings = settings();
    settings.options.velocity = velocity;
    trace_frame(scene, &settings, &unwatched).unwrap()
}

fn render_truth(scene: &Scene, alignment: Alignment) -> Truth {
    trace_truth(scene, &settings(), alignment, &unwatched).unwrap()
}

/// Writes a bar that moves right through the middle of the picture at the instant. A metre at its distance is a pixel.
fn bar_folder() -> Folder {
    let folder = Folder::new();
    let half = 0.5 * BAR;
    folder.write(
        "bar.obj",
        format!("mtllib mesh.mtl\nv -{half} -99 0\nv {half} -99 0\nv {half} 99 0\nv -{half} 99 0\nusemtl glow\nf 1 2 3 4\n"),
    );
    folder.write("mesh.mtl", "newmtl glow\nKd 0 0 0\nKe 1 1 1\n");
    folder.write(
        "scene.toml",
        format!(
            "exposes = \"A bar that moves.\"\nfamily = \"translation\"\nexposure = 0.5\nsize = [64, 36]\n\
             [camera]\nposition = [0, 0, {}]\nlook_at = [0, 0, 0]\nvertical_fov = 90\n\
             [background]\nconstant = [0, 0, 0]\n[object.bar]\nmesh = \"bar.obj\"\nkeys = [\n\
             {{ time = -1, translation = [{}, 0, 0] }},\n{{ time = 0, translation = [0, 0, 0] }},\n]\n",
            0.5 * f64::from(HEIGHT),
            -SPEED
        ),
    );
    folder
}

/// Measures the middle of the bar's smear, in pixels right of the picture's, and its length without the bar.
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
    // Squared widths of boxes add up: those of bar, smear and pixel.
    let width = 12.0 * (moments[2] / moments[0] - middle * middle);
    [middle, (width - BAR * BAR - 1.0).max(0.0).sqrt()]
}

#[test]
fn a_bar_smears_by_its_speed_and_the_shutter_of_each_rate() {
    let folder = bar_folder();
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
        let scene = load_scene(&folder.path, Some(variant)).unwrap();
        for (alignment, side) in [(Alignment::Trailing, -0.5), (Alignment::Centred, 0.0)] {
            let [middle, found] = measure_smear(&render_truth(&scene, alignment));
            // Some 10 sigma at 256 samples per pixel.
            assert!((found - length).abs() < 0.1, "{variant}: {found} {length}");
            let expected = side * length;
            assert!(
                (middle - expected).abs() < 0.05,
                "{variant}: {middle} {expected}"
            );
        }
        let rate = FrameRate::in_word(variant).unwrap();
        let step = SPEED * 60.0 / rate.per_second;
        for kind in [VelocityKind::Instantaneous, VelocityKind::PreviousFrame] {
            let frame = render_frame(&scene, kind);
            let [right, down] = *frame.velocity.at(WIDTH / 2, HEIGHT / 2);
            assert!((f64::from(right) - step).abs() < 1e-3, "{variant}: {right}");
            assert!(down.abs() < 1e-3);
            assert!((frame.exposure * step - length).abs() < 1e-9, "{variant}");
            let own = Some(rate.per_second).filter(|rate| *rate != 60.0);
            assert_eq!(frame.frames_per_second, own);
        }
    }
}

#[test]
fn at_60_frames_per_second_every_scene_is_as_its_file_says() {
    let settings = RenderSettings {
        samples_per_pixel: 16,
        ..settings()
    };
    for listing in list_scenes(scenes()).unwrap() {
        let load = |variant| load_scene(&listing.folder, variant).unwrap();
        let frame = |scene: &Scene| trace_frame(scene, &settings, &unwatched).unwrap();
        let [plain, same] = [None, Some("60fps")].map(load);
        assert_ne!(plain.hash, same.hash);
        assert_eq!(same.id.to_string(), format!("{}@60fps", listing.name));
        assert_same_frame(&frame(&plain), &frame(&same), &listing.name);
    }
    let load = |variant| load_scene(scenes().join("fan"), variant).unwrap();
    for (plain, same) in [(None, "60fps"), (Some("seal7"), "seal7@60fps")] {
        let [plain, same] = [plain, Some(same)].map(load);
        let truth =
            |scene: &Scene| trace_truth(scene, &settings, Alignment::Trailing, &unwatched).unwrap();
        assert_same_truth(&truth(&plain), &truth(&same), &same.id.to_string());
    }
}

fn assert_same_frame(one: &Frame, other: &Frame, what: &str) {
    let other = Frame {
        provenance: one.provenance.clone(),
        frames_per_second: one.frames_per_second,
        ..other.clone()
    };
    assert!(*one == other, "{what}: the frames differ");
}

fn assert_same_truth(one: &Truth, other: &Truth, what: &str) {
    let other = Truth {
        provenance: one.provenance.clone(),
        ..other.clone()
    };
    assert!(*one == other, "{what}: the truths differ");
}

/// Writes a scene of paths, key shapes, a moving camera that zooms, and a rolling shutter. All its times are multiplied by `times`.
fn write_paths(folder: &Folder, times: f64, exposure: f64) {
    let moved = std::fs::read_to_string(folder.path.join("mesh.obj")).unwrap();
    folder.write("moved.obj", moved.replace("v 1 1 0", "v 1.4 1.2 0.3"));
    folder.write("bent.obj", moved.replace("v 1 1 0", "v 1.5 0.8 -0.2"));
    let at = |time: f64| format!("time = {:?}", time * times);
    let scene = format!(
        "exposes = \"Paths.\"\nfamily = \"deforming\"\nexposure = {exposure:?}\nsize = [64, 36]\n\
         [shutter]\nrise = 0.2\nfall = 0.1\nrolling = {:?}\n\
         [camera]\ninterpolation = \"cubic\"\nkeys = [\n\
         {{ {}, position = [-0.3, 0, 5], look_at = [0, 0, 0], vertical_fov = 40 }},\n\
         {{ {}, position = [0, 0.1, 5], look_at = [0, 0, 0], vertical_fov = 44 }},\n\
         {{ {}, position = [0.5, 0, 4.5], look_at = [0.2, 0, 0], vertical_fov = 41 }},\n]\n\
         [background]\nconstant = [0.1, 0.2, 0.3]\n[sun]\ndirection = [0.3, 1, 1]\nirradiance = [1, 1, 1]\n\
         [object.body]\nmesh = \"mesh.obj\"\nkeys = [\n\
         {{ {}, translation = [-1, 0, 0], rotation = {{ axis = [0, 0, 1], degrees = 250 }} }},\n\
         {{ {}, translation = [0, 0.2, 0], rotation = {{ axis = [0, 0, 1], degrees = 10 }} }},\n\
         {{ {}, translation = [1, 0, 0], rotation = {{ axis = [0, 0, 1], degrees = -90 }}, scale = 1.5 }},\n]\n\
         [object.part]\nparent = \"body\"\nshapes = [\n\
         {{ {}, mesh = \"mesh.obj\" }},\n{{ {}, mesh = \"moved.obj\" }},\n{{ {}, mesh = \"bent.obj\" }},\n]\n",
        0.1 * times,
        at(-5.0),
        at(-0.7),
        at(4.0),
        at(-4.0),
        at(-0.25),
        at(3.0),
        at(-3.0),
        at(0.1),
        at(3.5),
    );
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
            let [made, written] = [&made, &written].map(|scene| render_truth(scene, alignment));
            assert_same_truth(&made, &written, variant);
        }
    }
}

#[test]
fn frames_of_a_sequence_follow_at_the_rate() {
    // The second frame at 120 frames per second is the first one at 60.
    let folder = Folder::new();
    write_paths(&folder, 1.0, 0.5);
    let [plain, fast] = [None, Some("120fps")].map(|it| load_scene(&folder.path, it).unwrap());
    let fast = fast.at_frame(2);
    assert_eq!(fast.id.to_string(), "square@120fps/0002");
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
    let variants = [
        None,
        Some("24fps"),
        Some("24fps_1-48s"),
        Some("24fps_1-50s"),
        Some("23.976fps"),
        Some("fast@24fps"),
        Some("unlit@24fps"),
        Some("seal7@24fps"),
    ];
    let scenes = variants.map(|variant| load_scene(&folder.path, variant).unwrap());
    for (index, scene) in scenes.iter().enumerate() {
        let others = scenes[..index].iter();
        assert!(others.clone().all(|other| other.hash != scene.hash));
        assert_eq!(scene.id.rate.unwrap_or_default(), scene.rate());
        assert_eq!(scene.written_exposure, 0.5);
    }
    assert_eq!(scenes[5].id.to_string(), "square@fast@24fps");
    assert_eq!(
        [&scenes[1], &scenes[2]].map(|scene| scene.exposure),
        [0.5; 2]
    );
    // A sealed variant changes the scene of the file, and then the rate.
    let keys = |scene: &Scene| scene.objects[0].motion.keys[0].time;
    let sealed = load_scene(&folder.path, Some("seal7")).unwrap();
    assert_eq!(keys(&scenes[7]), keys(&sealed) * (24.0 / 60.0));
}

#[test]
fn times_beyond_the_keys_are_refused() {
    let check = |variant: &str, alignment| {
        let scene = load_scene(scenes().join("flag"), Some(variant)).unwrap();
        let settings = RenderSettings::default();
        let truth = settings.check_truth(&scene, alignment).map(drop);
        truth.err().map(|error| error.to_string())
    };
    // The shapes go from -1 to 1 of 60 frames per second: from -0.4 to 0.4 of 24, and from -2.4 to 2.4 of 144.
    assert_eq!(check("144fps", Alignment::Trailing), None);
    assert_eq!(check("24fps", Alignment::Centred), None);
    for (variant, parts) in [
        ("24fps", ["at frame -0.5", "begin at frame -0.4"]),
        ("144fps_1-48s", ["at frame -3,", "begin at frame -2.4"]),
    ] {
        let text = check(variant, Alignment::Trailing).unwrap();
        for part in ["the shapes of object cloth", variant]
            .into_iter()
            .chain(parts)
        {
            assert!(text.contains(part), "{text}: {part}");
        }
    }
    let text = check("24fps", Alignment::Leading).unwrap();
    assert!(text.contains("end at frame 0.4"), "{text}");
    // So are those that the velocity since the frame before needs.
    let scene = load_scene(scenes().join("flag"), Some("24fps")).unwrap();
    let mut settings = RenderSettings::default();
    assert!(settings.check_frame(&scene).is_ok());
    settings.options.velocity = VelocityKind::PreviousFrame;
    assert!(settings.check_frame(&scene).is_err());
}

#[test]
fn names_that_are_no_rates_are_refused() {
    let folder = Folder::new();
    for (variant, part) in [
        ("0fps", "0 frames per second; allowed: 1 to 1000"),
        ("-24fps", "-24 frames per second; allowed"),
        ("2000fps", "2000 frames per second; allowed"),
        ("NaNfps", "variant \"NaNfps\" is unknown"),
        (
            "24fps_1-0s",
            "a shutter time of 1/0 s; allowed: 1/1 to 1/100000",
        ),
        ("024fps", "variant \"024fps\" is unknown"),
        ("24fps@24fps", "variant \"24fps\" is unknown"),
        ("slow@24fps", "variant \"slow\" is unknown"),
    ] {
        let text = load_scene(&folder.path, Some(variant)).unwrap_err();
        let text = text.to_string();
        assert!(text.contains(part), "{variant}: {text}");
    }
    folder.edit("scene.toml", "[variant.fast.", "[variant.30fps.");
    let text = folder.load().unwrap_err().to_string();
    assert!(
        text.contains("variant \"30fps\" has the name of a frame rate"),
        "{text}"
    );
}
