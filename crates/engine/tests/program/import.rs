//! `import`: scenes made from foreign models. `export`: scenes as glTF.

use std::fmt::Write;
use std::fs;
use std::process::Output;

use engine::CaptureDescription;
use frame::Frame;
use scene::load_scene;
use tests::near::assert_near;
use tests::{settings, unwatched};
use tracer::trace_frame;

use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stdout};

/// House far from the origin, as exporters write one: Windows line ends, quads, a pentagon, indices
/// counted from the end, no normals, names with spaces.
const HOUSE: &str = include_str!("../fixtures/the_house.obj");
const MATERIALS: &str = include_str!("../fixtures/the_house.mtl");

/// Makes a folder with the house and its materials.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("my models")).unwrap();
    write_model(&sandbox, HOUSE);
    sandbox.put("my models/the house.mtl", MATERIALS);
    sandbox
}

/// Writes the model, and removes the previous model's scene.
fn write_model(sandbox: &Sandbox, text: &str) {
    sandbox.put("my models/the house.obj", text);
    _ = fs::remove_dir_all(sandbox.path("scenes/house"));
}

fn import_to(sandbox: &Sandbox, out: &str, more: &str) -> Output {
    let words = ["engine", "import", "my models/the house.obj", "--out", out];
    sandbox.shuttertruth(&[&words, &split(more)[..]].concat())
}

fn import(sandbox: &Sandbox, more: &str) -> Output {
    import_to(sandbox, "scenes/house", more)
}

/// Imports the house; returns the output, and the scene's frame at a quarter of the size that its
/// speeds are for.
fn import_and_render(sandbox: &Sandbox, more: &str) -> (String, Frame) {
    let output = import(sandbox, more);
    assert_done(&output);
    let scene = load_scene(sandbox.path("scenes/house"), None).unwrap();
    let settings = settings([160, 90], 1);
    let frame = trace_frame(&scene, &settings, &unwatched).unwrap();
    (stdout(&output), frame)
}

/// Returns the positions of the pixels that show an object, and their velocities, in pixels of
/// 320x180.
fn shown_pixels(frame: &Frame, object: &str) -> Vec<([f64; 2], [f64; 2])> {
    let mut names = frame.objects.iter();
    let id = names.position(|name| name == object).unwrap() as u32;
    let pixels = frame.object_id.pixels.iter().zip(&frame.velocity.pixels);
    let pixels = pixels
        .enumerate()
        .filter(|(_, (pixel_id, _))| **pixel_id == id);
    let read = pixels.map(|(at, (_, velocity))| {
        let place = [at % 160, at / 160].map(|pixel| 2.0 * pixel as f64 + 1.0);
        (place, velocity.map(|pixels| 2.0 * f64::from(pixels)))
    });
    read.collect()
}

fn speeds(frame: &Frame, object: &str) -> Vec<f64> {
    let shown = shown_pixels(frame, object).into_iter();
    shown.map(|(_, [x, y])| x.hypot(y)).collect()
}

/// Rounding of a plane hundreds of metres wide.
const STILL: f64 = 1e-3;

#[test]
fn an_imported_model_is_centred_and_slides_at_the_requested_speed() {
    let sandbox = set_up();
    let (said, frame) = import_and_render(&sandbox, "--slide 40px/frame");
    assert!(said.contains("slides 40 pixels per frame"), "{said}");
    let house = shown_pixels(&frame, "model");
    let count = house.len() as f64;
    let middle = [0, 1].map(|axis| house.iter().map(|(at, _)| at[axis]).sum::<f64>() / count);
    // The camera looks from the side and from above, so the visible part is not symmetric about the
    // middle.
    assert_near(middle[0], 160.0, 10.0);
    assert_near(middle[1], 90.0, 10.0);
    let inside =
        |(at, _): &([f64; 2], _)| (5.0..315.0).contains(&at[0]) && (5.0..175.0).contains(&at[1]);
    assert!(house.iter().all(inside), "the house is cut off");
    // The model's bounding sphere fills three quarters of the height, and the house fills most of
    // that sphere.
    let rows = house.iter().map(|(at, _)| at[1]);
    let height = rows.clone().fold(0.0, f64::max) - rows.fold(180.0, f64::min);
    assert!((70.0..135.0).contains(&height), "{height}");
    // 20 px at the middle. The front is nearer by a tenth or two, and the motion follows the
    // picture's rows.
    for (at, velocity) in &house {
        assert!(
            (17.0..26.0).contains(&velocity[0]) && velocity[1].abs() < 0.01,
            "{velocity:?} at {at:?}"
        );
    }
    assert!(speeds(&frame, "wall").iter().all(|speed| *speed < STILL));
    let stand = shown_pixels(&frame, "stand");
    assert!(stand.iter().all(|(_, velocity)| velocity[0] > 10.0));
}

#[test]
fn an_imported_model_spins_about_its_own_middle() {
    let sandbox = set_up();
    let (_, frame) = import_and_render(&sandbox, "--spin 20deg/frame");
    let house = shown_pixels(&frame, "model");
    // Counter-clockwise from above: near points move right. The farthest corner is 14.1 m from the
    // axis. At 57.7 m of distance and 247.3 px of focal length, no point moves faster than 14.1 x
    // 0.35 x 247.3 / 43 px.
    let fastest = speeds(&frame, "model").into_iter().fold(0.0, f64::max);
    assert!((12.0..29.0).contains(&fastest), "{fastest}");
    let moving_right = house.iter().filter(|(_, velocity)| velocity[0] > 0.0);
    let (right, all) = (moving_right.count(), house.len());
    assert!(right * 10 > all * 8, "{right} of {all}");
    assert!(speeds(&frame, "floor").iter().all(|speed| *speed < STILL));
}

#[test]
fn an_orbiting_camera_keeps_the_model_in_the_middle() {
    let sandbox = set_up();
    let (_, frame) = import_and_render(&sandbox, "--orbit 3deg/frame --exposure 1");
    assert_eq!(frame.exposure, 1.0);
    let [wall, model] = ["wall", "model"].map(|object| {
        let speeds = speeds(&frame, object);
        speeds.iter().sum::<f64>() / speeds.len() as f64
    });
    // The wall is 4 radii behind the camera's target, and the model's surface is within one.
    assert!(wall > 2.0 * model, "{wall} {model}");
}

#[test]
fn a_model_with_z_up_stands_upright() {
    let sandbox = set_up();
    let (_, upright) = import_and_render(&sandbox, "--slide 8px/frame");
    // The house is on its back: its y axis becomes z.
    let lying = HOUSE.lines().map(|line| match split(line)[..] {
        ["v", x, y, z] => format!("v {x} {} {y}\n", -z.parse::<f64>().unwrap()),
        _ => format!("{line}\n"),
    });
    write_model(&sandbox, &lying.collect::<String>());
    let (_, frame) = import_and_render(&sandbox, "--slide 8px/frame --up z");
    assert_eq!(frame.object_id, upright.object_id);
}

const SLIDE: &str = "--slide 40px/frame";

/// More words of `import`, and parts of the message.
const BAD_MOTIONS: [(&str, &[&str]); 6] = [
    ("", &["nothing would move", "spin such as 20deg/frame"]),
    ("--slide 40", &["40", "40px/frame"]),
    ("--slide 0px/frame", &["0px/frame", "40px/frame"]),
    ("--slide 40deg/frame", &["40deg/frame", "40px/frame"]),
    ("--slide fast", &["fast", "40px/frame"]),
    ("--slide 4px/frame --exposure 0", &["--exposure", "0"]),
];

#[test]
fn bad_requests_are_refused_with_the_way_out() {
    let sandbox = set_up();
    for (more, parts) in BAD_MOTIONS {
        assert_refused(&import(&sandbox, more), 2, parts);
    }
    for (out, parts) in [
        ("scenes/plate", ["scenes/plate", "exists already"]),
        ("scenes/my house", ["my house", "letters, digits, _ and -"]),
    ] {
        assert_refused(&import_to(&sandbox, out, SLIDE), 2, &parts);
    }
    let missing = "engine import no.obj --slide 4px/frame --out scenes/house";
    sandbox.refuse(missing, &["no.obj", "cannot read"]);
}

#[test]
fn bad_models_are_refused_with_the_way_out() {
    let sandbox = set_up();
    let refuse = |model: &str, parts: &[&str]| {
        write_model(&sandbox, model);
        assert_refused(&import(&sandbox, SLIDE), 2, parts);
    };
    let no_vertex = HOUSE.replace("f 7 6 10 9 8", "f 7 6 11 9 8");
    refuse(&no_vertex, &["the house.obj:16", "11", "1 to 10"]);
    let no_faces = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    refuse(no_faces, &["the house.obj", "face"]);
    let outside = MATERIALS.replace("Kd 0.6 0.2 0.1", "map_Kd ../scenes/dot.png");
    sandbox.put("my models/the house.mtl", outside);
    let dot = frame::Raster::filled(2, 2, [0.5; 3]);
    frame::write_png(&sandbox.path("scenes/dot.png"), &dot).unwrap();
    // Faces with a texture need coordinates. This is checked before the texture's path.
    refuse(HOUSE, &["texture", "import the model plain"]);
    let faces = "vt 0 0\r\nusemtl the roof\r\nf 3/1 8/1 9/1 4/1\r\nf 4/1 9/1 10/1 5/1";
    let textured = HOUSE.replace("usemtl the roof\r\nf 3 8 9 4\r\nf 4 9 10 5", faces);
    let parts = [
        "dot.png",
        "outside of the model's folder",
        "import the model plain",
    ];
    refuse(&textured, &parts);
    let left: Vec<_> = fs::read_dir(sandbox.path("scenes")).unwrap().collect();
    assert_eq!(left.len(), 2, "plate and dot.png alone: {left:?}");
}

#[test]
fn a_model_without_its_materials_imports_plain_on_request() {
    let sandbox = set_up();
    fs::remove_file(sandbox.path("my models/the house.mtl")).unwrap();
    let parts = ["the house.obj:2", "the house.mtl", "import the model plain"];
    assert_refused(&import(&sandbox, SLIDE), 2, &parts);
    let plain = format!("{SLIDE} --plain");
    let (_, frame) = import_and_render(&sandbox, &plain);
    assert!(!shown_pixels(&frame, "model").is_empty());
    // Errors of a plain model name their place too.
    write_model(&sandbox, &HOUSE.replace("f 7 6 10 9 8", "f 7 6 x 9 8"));
    let parts = ["my models/the house.obj:16", "\"x\""];
    assert_refused(&import(&sandbox, &plain), 2, &parts);
}

#[test]
fn glass_of_a_model_lets_light_pass_and_the_import_says_so() {
    let sandbox = set_up();
    let glass = MATERIALS.replace("Kd 0.6 0.2 0.1", "Kd 0.6 0.2 0.1\nd 0.3\nillum 4");
    sandbox.put("my models/the house.mtl", glass);
    let output = import(&sandbox, SLIDE);
    assert_done(&output);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("alpha = \"blended\""), "{said}");
    let scene = load_scene(sandbox.path("scenes/house"), None).unwrap();
    let mut materials = scene.materials.iter();
    let roof = materials
        .find(|material| material.name == "the roof")
        .unwrap();
    assert_eq!(roof.translucency.and_then(|roof| roof.glass), Some(1.5));
    assert_eq!(scene.notes, [""; 0]);
}

#[test]
fn a_byte_order_mark_does_not_hide_the_first_statement_of_a_model() {
    let sandbox = set_up();
    let (_, house) = HOUSE.split_once("mtllib").unwrap();
    write_model(&sandbox, &format!("\u{feff}mtllib{house}"));
    assert_done(&import(&sandbox, SLIDE));
    fs::remove_dir_all(sandbox.path("scenes/house")).unwrap();
    fs::remove_file(sandbox.path("my models/the house.mtl")).unwrap();
    assert_done(&import(&sandbox, &format!("{SLIDE} --plain")));
}

/// Imports a bumpy ball with this many steps around and along it.
fn import_ball(steps: usize) {
    let sandbox = set_up();
    let mut text = String::from("o ball\n");
    for row in 0..=steps {
        for column in 0..steps {
            let [around, down] = [column, row].map(|step| step as f64 / steps as f64);
            let around = around * std::f64::consts::TAU;
            let down = (down * 0.98 + 0.01) * std::f64::consts::PI;
            let radius = 2.0 + 0.1 * (9.0 * around).sin() * (7.0 * down).sin();
            let [x, z] = [around.cos(), around.sin()].map(|side| radius * down.sin() * side);
            writeln!(text, "v {x} {} {z}", radius * down.cos()).unwrap();
        }
    }
    for row in 0..steps {
        for column in 0..steps {
            let at = |row: usize, column: usize| 1 + row * steps + column % steps;
            let (a, b) = (at(row, column), at(row, column + 1));
            writeln!(text, "f {a} {b} {} {}", b + steps, a + steps).unwrap();
        }
    }
    write_model(&sandbox, &text);
    let (said, frame) = import_and_render(&sandbox, "--spin 10deg/frame");
    let mut lines = said.lines();
    let triangles = lines.find(|line| line.contains("triangles")).unwrap();
    let count: usize = triangles.split(' ').next().unwrap().parse().unwrap();
    assert!(count > 2 * steps * steps, "{said}");
    assert!(shown_pixels(&frame, "model").len() > 1000);
}

/// More corners than 16 bits can number.
#[test]
#[ignore = "prove: a model of many triangles"]
fn a_model_of_a_hundred_thousand_triangles_is_imported() {
    import_ball(257);
}

#[test]
#[ignore = "prove: a larger model"]
fn a_model_of_a_quarter_of_a_million_triangles_is_imported() {
    import_ball(360);
}

#[test]
fn a_scene_becomes_a_folder_that_says_when_its_frame_is() {
    let sandbox = Sandbox::new();
    let text = sandbox.done("engine export plate --gltf gltf");
    assert!(text.contains("the frame is at 0.083333 s"), "{text}");
    for name in ["scene.gltf", "scene.bin", "sky.exr"] {
        assert!(sandbox.path("gltf/plate").join(name).exists(), "no {name}");
    }
    let manifest: serde_json::Value = sandbox.read_json("gltf/plate/manifest.json");
    assert_eq!(manifest["objects"][0], "background");
    assert_eq!(manifest["seconds_per_frame"].as_f64(), Some(1.0 / 24.0));
    let times = ["previous", "instant", "next"].map(|name| manifest[name].as_f64());
    assert_eq!(times, [1.0, 2.0, 3.0].map(|frame| Some(frame / 24.0)));
}

#[test]
fn an_export_says_when_to_draw_each_sub_frame_and_begins_the_capture_s_description() {
    let sandbox = Sandbox::new();
    sandbox.done("engine export plate --gltf gltf --subframes 4");
    let manifest: serde_json::Value = sandbox.read_json("gltf/plate/manifest.json");
    let times = manifest["subframes"]["centred"].as_array().unwrap();
    // The shutter is open for half a frame of 1/24 s around the frame at 2/24 s.
    for (time, part) in times.iter().zip([-0.1875, -0.0625, 0.0625, 0.1875]) {
        let difference = time.as_f64().unwrap() - (2.0 + part) / 24.0;
        assert!(difference.abs() < 1e-12, "{time}");
    }
    assert_eq!(times.len(), 4);
    let described = CaptureDescription::read(&sandbox.path("gltf/plate")).unwrap();
    assert_eq!(described.scene, Some("plate".parse().unwrap()));
    assert_eq!(described.exposure, Some(0.5));
    assert_eq!(described.subframes, Some(4));
    let parts = ["--subframes 5", "even numbers from 4 to 4096"];
    sandbox.refuse("engine export plate --subframes 5", &parts);
}

#[test]
fn an_unlit_export_is_the_scene_that_run_takes_as_unlit() {
    let sandbox = Sandbox::new();
    sandbox.done("engine export plate --unlit --gltf flagged");
    sandbox.done("engine export plate@unlit --gltf named");
    let read =
        |folder: &str| fs::read(sandbox.path(folder).join("plate@unlit/scene.gltf")).unwrap();
    assert_eq!(read("flagged"), read("named"));
    sandbox.done("truths render --scenes plate@unlit --size 32x18 --samples-per-pixel 16 --out r");
    assert!(sandbox.path("r/plate@unlit/truth_trailing.exr").is_file());
}
