//! `import`: scenes made from foreign models.

use std::fmt::Write;
use std::fs;
use std::process::Output;

use frame::Frame;

use crate::sandbox::{Sandbox, assert_done, assert_refused, split, stdout};

/// House far from the origin, as exporters write one: Windows line ends, quads, a pentagon, indices counted from the
/// end, no normals, names with spaces.
const HOUSE: &str = "\
# Café, à la main\r
mtllib the house.mtl\r
o the house\r
v 990 -30 500\r
v 1010 -30 500\r
v 1010 -10 500\r
v 1000 0 500\r
v 990 -10 500\r
v 990 -30 480\r
v 1010 -30 480\r
v 1010 -10 480\r
v 1000 0 480\r
v 990 -10 480\r
usemtl the wall\r
f -10 -9 -8 -7 -6\r
f 7 6 10 9 8\r
f 1 6 7 2\r
f 1 5 10 6\r
f 2 7 8 3\r
usemtl the roof\r
f 3 8 9 4\r
f 4 9 10 5\r
";

const MATERIALS: &str = "newmtl the wall\r\nKd 0.8 0.7 0.6\r\nNs 12\r\nnewmtl the roof\r\nKd 0.6 0.2 0.1\r\nmap_Bump none.png\r\n";

/// Makes a folder with the house and its materials.
fn set_up() -> Sandbox {
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("my models")).unwrap();
    fs::write(sandbox.path("my models/the house.obj"), HOUSE).unwrap();
    fs::write(sandbox.path("my models/the house.mtl"), MATERIALS).unwrap();
    sandbox
}

fn import(sandbox: &Sandbox, more: &[&str]) -> Output {
    let words = [
        "engine",
        "import",
        "my models/the house.obj",
        "--out",
        "scenes/house",
    ];
    sandbox.shuttertruth(&[&words, more].concat())
}

/// Renders the imported scene's frame at half the size that its speeds are meant for.
fn render_frame(sandbox: &Sandbox) -> Frame {
    sandbox.execute(&split("truths render --scenes house --size 320x180 --samples-per-pixel 8 --replicates 2 --quiet --out out"));
    Frame::read(&sandbox.path("out/house/frame.exr")).unwrap()
}

/// Returns the pixels that show an object, and their velocities.
fn shown_pixels(frame: &Frame, object: &str) -> Vec<([f64; 2], [f64; 2])> {
    let id = frame
        .objects
        .iter()
        .position(|name| name == object)
        .unwrap() as u32;
    let pixels = frame
        .object_id
        .pixels
        .iter()
        .zip(&frame.velocity.pixels)
        .enumerate();
    pixels
        .filter(|(_, (found, _))| **found == id)
        .map(|(at, (_, velocity))| {
            let (x, y) = (at as u32 % 320, at as u32 / 320);
            (
                [f64::from(x) + 0.5, f64::from(y) + 0.5],
                velocity.map(f64::from),
            )
        })
        .collect()
}

#[test]
fn an_imported_model_is_centred_and_slides_at_the_requested_speed() {
    let sandbox = set_up();
    let output = import(&sandbox, &["--slide", "40px/frame"]);
    assert_done(&output);
    assert!(
        stdout(&output).contains("slides 40 pixels per frame"),
        "{}",
        stdout(&output)
    );
    let frame = render_frame(&sandbox);
    let house = shown_pixels(&frame, "model");
    let count = house.len() as f64;
    let middle = [0, 1].map(|axis| house.iter().map(|(at, _)| at[axis]).sum::<f64>() / count);
    // The camera looks from the side and from above, so that the seen part is not symmetric about the middle.
    assert!(
        (middle[0] - 160.0).abs() < 10.0 && (middle[1] - 90.0).abs() < 10.0,
        "{middle:?}"
    );
    let inside =
        |(at, _): &([f64; 2], _)| (5.0..315.0).contains(&at[0]) && (5.0..175.0).contains(&at[1]);
    assert!(house.iter().all(inside), "the house is cut off");
    // The model's bounding sphere fills three quarters of the height, and the house fills most of that sphere.
    let rows = house.iter().map(|(at, _)| at[1]);
    let height = rows.clone().fold(0.0, f64::max) - rows.fold(180.0, f64::min);
    assert!((70.0..135.0).contains(&height), "{height}");
    // 20 px at the middle. The front is nearer by a tenth or two, and the motion follows the picture's rows.
    for (at, velocity) in &house {
        assert!(
            (17.0..26.0).contains(&velocity[0]) && velocity[1].abs() < 0.01,
            "{velocity:?} at {at:?}"
        );
    }
    // Rounding of a plane that is hundreds of metres large.
    assert!(
        shown_pixels(&frame, "wall")
            .iter()
            .all(|(_, velocity)| velocity[0].hypot(velocity[1]) < 1e-3)
    );
    assert!(
        shown_pixels(&frame, "stand")
            .iter()
            .all(|(_, velocity)| velocity[0] > 10.0)
    );
}

#[test]
fn an_imported_model_spins_about_its_own_middle() {
    let sandbox = set_up();
    assert_done(&import(&sandbox, &["--spin", "20deg/frame"]));
    let frame = render_frame(&sandbox);
    let house = shown_pixels(&frame, "model");
    // Counter-clockwise from above: near points move right. The farthest corner is 14.1 m from the axis. At 57.7 m of
    // distance and 247.3 px of focal length, no point moves faster than 14.1 x 0.35 x 247.3 / 43 px.
    let fastest = house
        .iter()
        .map(|(_, velocity)| velocity[0].hypot(velocity[1]))
        .fold(0.0, f64::max);
    assert!((12.0..29.0).contains(&fastest), "{fastest}");
    let rightwards = house
        .iter()
        .filter(|(_, velocity)| velocity[0] > 0.0)
        .count();
    assert!(
        rightwards * 10 > house.len() * 8,
        "{rightwards} of {}",
        house.len()
    );
    assert!(
        shown_pixels(&frame, "floor")
            .iter()
            .all(|(_, velocity)| velocity[0].hypot(velocity[1]) < 1e-3)
    );
}

#[test]
fn an_orbiting_camera_keeps_the_model_in_the_middle() {
    let sandbox = set_up();
    assert_done(&import(
        &sandbox,
        &["--orbit", "3deg/frame", "--exposure", "1"],
    ));
    let frame = render_frame(&sandbox);
    assert_eq!(frame.exposure, 1.0);
    let speed = |object: &str| {
        let shown = shown_pixels(&frame, object);
        let sum: f64 = shown
            .iter()
            .map(|(_, velocity)| velocity[0].hypot(velocity[1]))
            .sum();
        sum / shown.len() as f64
    };
    // The wall is 4 radii behind the camera's target, and the model's surface is within one.
    assert!(
        speed("wall") > 2.0 * speed("model"),
        "{} {}",
        speed("wall"),
        speed("model")
    );
}

#[test]
fn a_model_with_z_up_stands_upright() {
    let sandbox = set_up();
    // The house lies on its back: its y axis becomes z.
    let lying: String = HOUSE
        .lines()
        .map(|line| match line.strip_prefix("v ") {
            Some(numbers) => {
                let numbers: Vec<f64> = numbers
                    .split_whitespace()
                    .map(|word| word.parse().unwrap())
                    .collect();
                format!("v {} {} {}\n", numbers[0], -numbers[2], numbers[1])
            }
            None => format!("{line}\n"),
        })
        .collect();
    assert_done(&import(&sandbox, &["--slide", "8px/frame"]));
    let upright = render_frame(&sandbox);
    fs::write(sandbox.path("my models/the house.obj"), lying).unwrap();
    fs::remove_dir_all(sandbox.path("scenes/house")).unwrap();
    assert_done(&import(&sandbox, &["--slide", "8px/frame", "--up", "z"]));
    assert_eq!(render_frame(&sandbox).object_id, upright.object_id);
}

#[test]
fn bad_models_are_refused_with_the_way_out() {
    let sandbox = set_up();
    let slide = ["--slide", "40px/frame"];
    assert_refused(
        &import(&sandbox, &[]),
        2,
        &["nothing would move", "spin such as 20deg/frame"],
    );
    for wrong in ["40", "0px/frame", "40deg/frame", "fast"] {
        assert_refused(
            &import(&sandbox, &["--slide", wrong]),
            2,
            &[wrong, "40px/frame"],
        );
    }
    assert_refused(
        &import(&sandbox, &["--slide", "4px/frame", "--exposure", "0"]),
        2,
        &["--exposure", "0"],
    );
    let to = |out: &str| {
        let words = [
            "engine",
            "import",
            "my models/the house.obj",
            "--slide",
            "4px/frame",
            "--out",
            out,
        ];
        sandbox.shuttertruth(&words)
    };
    assert_refused(&to("scenes/plate"), 2, &["scenes/plate", "exists already"]);
    assert_refused(
        &to("scenes/my house"),
        2,
        &["my house", "letters, digits, _ and -"],
    );
    let missing = [
        "engine",
        "import",
        "no.obj",
        "--slide",
        "4px/frame",
        "--out",
        "scenes/house",
    ];
    assert_refused(
        &sandbox.shuttertruth(&missing),
        2,
        &["no.obj", "cannot read"],
    );

    let obj = |text: &str| fs::write(sandbox.path("my models/the house.obj"), text).unwrap();
    obj(&HOUSE.replace("f 7 6 10 9 8", "f 7 6 11 9 8"));
    assert_refused(
        &import(&sandbox, &slide),
        2,
        &["the house.obj:16", "11", "1 to 10"],
    );
    obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    assert_refused(&import(&sandbox, &slide), 2, &["the house.obj", "face"]);
    obj(HOUSE);
    let outside = MATERIALS.replace("Kd 0.6 0.2 0.1", "map_Kd ../scenes/dot.png");
    fs::write(sandbox.path("my models/the house.mtl"), outside).unwrap();
    frame::write_png(
        &sandbox.path("scenes/dot.png"),
        &frame::Raster::filled(2, 2, [0.5; 3]),
    )
    .unwrap();
    // Faces with a texture need coordinates. This is checked before the texture's place.
    assert_refused(
        &import(&sandbox, &slide),
        2,
        &["texture", "import the model plain"],
    );
    obj(&HOUSE.replace(
        "usemtl the roof\r\nf 3 8 9 4\r\nf 4 9 10 5",
        "vt 0 0\r\nusemtl the roof\r\nf 3/1 8/1 9/1 4/1\r\nf 4/1 9/1 10/1 5/1",
    ));
    assert_refused(
        &import(&sandbox, &slide),
        2,
        &[
            "dot.png",
            "outside of the model's folder",
            "import the model plain",
        ],
    );
    assert!(
        !sandbox.path("scenes/house").exists(),
        "a refused import leaves nothing"
    );
    let left: Vec<_> = fs::read_dir(sandbox.path("scenes")).unwrap().collect();
    assert_eq!(left.len(), 2, "plate and dot.png alone: {left:?}");
}

#[test]
fn a_model_without_its_materials_imports_plain_on_request() {
    let sandbox = set_up();
    fs::remove_file(sandbox.path("my models/the house.mtl")).unwrap();
    let slide = ["--slide", "40px/frame"];
    assert_refused(
        &import(&sandbox, &slide),
        2,
        &["the house.obj:2", "the house.mtl", "import the model plain"],
    );
    assert_done(&import(&sandbox, &[&slide[..], &["--plain"]].concat()));
    assert!(!shown_pixels(&render_frame(&sandbox), "model").is_empty());
    // Errors of a plain model name their place too.
    let broken = HOUSE.replace("f 7 6 10 9 8", "f 7 6 x 9 8");
    fs::write(sandbox.path("my models/the house.obj"), broken).unwrap();
    fs::remove_dir_all(sandbox.path("scenes/house")).unwrap();
    let refused = import(&sandbox, &[&slide[..], &["--plain"]].concat());
    assert_refused(&refused, 2, &["my models/the house.obj:16", "\"x\""]);
}

#[test]
fn a_model_of_a_quarter_of_a_million_triangles_is_imported() {
    let sandbox = set_up();
    const STEPS: usize = 360;
    let mut text = String::from("o ball\n");
    for row in 0..=STEPS {
        for column in 0..STEPS {
            let (around, down) = (column as f64 / STEPS as f64, row as f64 / STEPS as f64);
            let (around, down) = (
                around * std::f64::consts::TAU,
                (down * 0.98 + 0.01) * std::f64::consts::PI,
            );
            let radius = 2.0 + 0.1 * (9.0 * around).sin() * (7.0 * down).sin();
            let [x, y, z] = [
                down.sin() * around.cos(),
                down.cos(),
                down.sin() * around.sin(),
            ];
            writeln!(text, "v {} {} {}", radius * x, radius * y, radius * z).unwrap();
        }
    }
    for row in 0..STEPS {
        for column in 0..STEPS {
            let at = |row: usize, column: usize| 1 + row * STEPS + column % STEPS;
            let (a, b) = (at(row, column), at(row, column + 1));
            writeln!(text, "f {a} {b} {} {}", b + STEPS, a + STEPS).unwrap();
        }
    }
    fs::write(sandbox.path("my models/the house.obj"), text).unwrap();
    let output = import(&sandbox, &["--spin", "10deg/frame"]);
    assert_done(&output);
    let said = stdout(&output);
    let triangles = said
        .lines()
        .find(|line| line.contains("triangles"))
        .unwrap();
    let count: usize = triangles.split(' ').next().unwrap().parse().unwrap();
    assert!(count > 2 * STEPS * STEPS, "{said}");
    assert!(shown_pixels(&render_frame(&sandbox), "model").len() > 4000);
}
