//! Audits of frames that were drawn wrongly: what is wrong is named, and honest frames pass.

use std::fs;
use std::ops::ControlFlow;

use engine::{Buffer, Capture, CaptureAudit, Cause};
use frame::{Frame, Raster, VelocityKind};
use tests::scenes;
use tracer::{RenderSettings, Scene, load_scene, trace_frame};

use crate::audit::{HEIGHT, WIDTH, audit, capture, load};

/// Loads the unlit variant of a scene.
fn load_unlit(name: &str) -> Scene {
    load_scene(scenes().join(name), Some("unlit")).unwrap()
}

/// Captures the scene as an engine draws it some frames after the instant.
pub fn draw(scene: &Scene, time: f64) -> Capture {
    let mut settings = RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        samples_per_pixel: 4,
        replicates: 1,
        ..RenderSettings::default()
    };
    settings.options.velocity = VelocityKind::PreviousFrame;
    let scene = scene.clone().later_by(time);
    let watch = |_| ControlFlow::Continue(());
    let Frame {
        color,
        velocity,
        depth,
        object_id,
        ..
    } = trace_frame(&scene, &settings, &watch).unwrap();
    let layers = tracer::PointLayers {
        velocity: velocity.clone(),
        depth,
        object_id,
    };
    Capture {
        color,
        ..capture(&layers, velocity)
    }
}

pub fn without_ids(capture: &Capture) -> Capture {
    Capture {
        object_id: None,
        ..capture.clone()
    }
}

/// Turns the order of the rows round.
fn flip<T: Clone>(raster: &mut Raster<T>) {
    let rows = raster.pixels.chunks_exact(raster.width as usize).rev();
    raster.pixels = rows.flatten().cloned().collect();
}

/// Number of an object.
pub fn id_of(scene: &Scene, name: &str) -> u32 {
    let names = scene.object_names();
    names.iter().position(|own| own == name).unwrap() as u32
}

/// Expects one finding, in a buffer and of an object, whose cause is the given one or looks like it.
pub fn expect(audit: &CaptureAudit, buffer: Buffer, object: Option<&str>, cause: Cause) {
    let [finding] = audit.findings.as_slice() else {
        panic!("{}: {:#?}", audit.scene, audit.findings);
    };
    assert_eq!(finding.buffer, buffer, "{finding:#?}");
    assert_eq!(finding.object.as_deref(), object, "{finding:#?}");
    let is_named = finding.found.cause == cause || finding.found.looks_like.contains(&cause);
    assert!(is_named, "{cause:?}: {finding:#?}");
}

#[test]
fn honest_frames_pass_with_ids_and_without() {
    let listings = tracer::list_scenes(scenes()).unwrap();
    let mut all: Vec<Scene> = (listings.iter())
        .map(|listing| load_scene(&listing.folder, None).unwrap())
        .collect();
    all.extend(["fan", "railing", "walker"].map(load_unlit));
    for scene in &all {
        let drawn = draw(scene, 0.0);
        let mut captures = vec![drawn];
        let tells_without_ids = ["fan", "railing", "roll", "flag", "crossing", "cockpit"];
        if tells_without_ids.contains(&scene.id.name.as_str()) {
            captures.push(without_ids(&captures[0]));
        }
        for capture in captures {
            let found = audit(scene, &capture);
            assert!(
                found.findings.is_empty() && found.shows_scene,
                "{}: {:#?}",
                scene.id,
                found.findings
            );
            assert!(found.velocity.iter().all(|object| object.is_right));
            assert!(found.alike > 0.999, "{}: {}", scene.id, found.alike);
        }
    }
}

#[test]
fn a_frame_of_another_time_is_named_and_not_compared() {
    // Four blades at 45 degrees per frame look the same one frame late and one frame early.
    for (name, time, cause) in [
        ("fan", -1.0, Cause::DrawnLate(1)),
        ("railing", -1.0, Cause::DrawnLate(1)),
        ("railing", 2.0, Cause::DrawnEarly(2)),
        ("roll", -2.0, Cause::DrawnLate(2)),
    ] {
        let scene = load(name);
        let drawn = draw(&scene, time);
        for capture in [without_ids(&drawn), drawn] {
            let found = audit(&scene, &capture);
            assert!(!found.shows_scene, "{name}");
            expect(&found, Buffer::Picture, None, cause);
        }
    }
}

/// A disc of eight colours, which turns by 50 degrees per frame: only its colours do.
fn load_disc(folder: &std::path::Path) -> Scene {
    let mut obj = "mtllib disc.mtl\n".to_owned();
    let mut mtl = String::new();
    for corner in 0..64 {
        let angle = std::f64::consts::TAU * f64::from(corner) / 64.0;
        obj += &format!("v {} {} 0\n", angle.cos(), angle.sin());
    }
    obj += "v 0 0 0\n";
    for sector in 0..8 {
        let red = 0.1 * f64::from(sector + 1);
        mtl += &format!("newmtl m{sector}\nKd {red} {} 0.3\n", 0.9 - red);
        obj += &format!("usemtl m{sector}\n");
        for corner in 8 * sector..8 * sector + 8 {
            obj += &format!("f 65 {} {}\n", corner + 1, (corner + 1) % 64 + 1);
        }
    }
    fs::write(folder.join("disc.obj"), obj).unwrap();
    fs::write(folder.join("disc.mtl"), mtl).unwrap();
    let text = "\
exposes = \"nothing: it serves a test\"
family = \"rotation\"
exposure = 0.5
size = [96, 54]
[camera]
position = [0, 0, 3]
look_at = [0, 0, 0]
vertical_fov = 60.0
[background]
constant = [0.8, 0.8, 0.8]
[object.disc]
mesh = \"disc.obj\"
keys = [
    { time = -1, rotation = { axis = [0, 0, 1], degrees = -50 } },
    { time = 1, rotation = { axis = [0, 0, 1], degrees = 50 } },
]
";
    fs::write(folder.join("scene.toml"), text).unwrap();
    load_scene(folder, None).unwrap()
}

#[test]
fn colour_tells_the_time_where_nothing_else_does() {
    let folder = tempfile::tempdir().unwrap();
    let scene = load_disc(folder.path());
    let right = audit(&scene, &draw(&scene, 0.0));
    assert!(right.findings.is_empty(), "{:#?}", right.findings);
    let late = audit(&scene, &draw(&scene, -1.0));
    assert!(late.velocity.iter().all(|object| object.is_right));
    assert!(!late.shows_scene);
    expect(&late, Buffer::Picture, None, Cause::DrawnLate(1));
    // The colour alone, if all else says another time.
    let scene = load("railing");
    let mixed = Capture {
        color: draw(&scene, -1.0).color,
        ..draw(&scene, 0.0)
    };
    let found = audit(&scene, &mixed);
    assert!(found.shows_scene);
    expect(&found, Buffer::Color, None, Cause::DrawnLate(1));
}

#[test]
fn rows_upside_down_are_named() {
    let scene = load("railing");
    let drawn = draw(&scene, 0.0);
    let mut flipped = drawn.clone();
    flip(&mut flipped.color);
    flip(&mut flipped.velocity);
    flip(&mut flipped.depth);
    flip(flipped.object_id.as_mut().unwrap());
    for capture in [without_ids(&flipped), flipped] {
        let found = audit(&scene, &capture);
        assert!(!found.shows_scene);
        expect(&found, Buffer::Picture, None, Cause::UpsideDown);
    }
    let alone =
        |change: &dyn Fn(&mut Capture), buffer: Buffer, object: Option<&str>, shows: bool| {
            let mut capture = drawn.clone();
            change(&mut capture);
            let found = audit(&scene, &capture);
            assert_eq!(found.shows_scene, shows, "{:#?}", found.findings);
            expect(&found, buffer, object, Cause::UpsideDown);
        };
    alone(&|it| flip(&mut it.color), Buffer::Color, None, true);
    alone(&|it| flip(&mut it.depth), Buffer::Depth, None, true);
    alone(&|it| flip(&mut it.velocity), Buffer::Velocity, None, true);
    let flip_ids = |it: &mut Capture| flip(it.object_id.as_mut().unwrap());
    alone(&flip_ids, Buffer::ObjectId, None, false);
}

#[test]
fn an_object_that_is_not_drawn_is_no_pass() {
    let scene = load("fan");
    let fan = id_of(&scene, "fan");
    let mut still = scene.clone();
    // The fan goes far behind the wall.
    for key in &mut still.objects[fan as usize - 1].motion.keys {
        key.translation.z -= 50.0;
    }
    let drawn = draw(&still, 0.0);
    let found = audit(&scene, &drawn);
    assert!(!found.shows_scene);
    expect(&found, Buffer::Picture, Some("fan"), Cause::OtherView);
    assert!(
        found.findings[0].text.contains("0.0 % of its "),
        "{}",
        found.findings[0].text
    );
    // The rest of the picture agrees.
    assert!(found.alike > 0.8, "{}", found.alike);
    let without = audit(&scene, &without_ids(&drawn));
    assert!(!without.findings.is_empty());
    assert!(
        without.findings[0].text.contains("object.exr would show"),
        "{:#?}",
        without.findings
    );
}

#[test]
fn the_colours_of_unlit_scenes_are_compared() {
    let scene = load_unlit("railing");
    let drawn = draw(&scene, 0.0);
    let recolored = |names: &[&str], change: &dyn Fn([f32; 3]) -> [f32; 3]| {
        let ids: Vec<u32> = names.iter().map(|name| id_of(&scene, name)).collect();
        let color = drawn
            .color
            .zip(drawn.object_id.as_ref().unwrap(), |color, id| {
                if ids.contains(id) {
                    change(*color)
                } else {
                    *color
                }
            });
        audit(
            &scene,
            &Capture {
                color,
                ..drawn.clone()
            },
        )
    };
    let black = recolored(&["car"], &|_| [0.0; 3]);
    assert!(black.shows_scene && black.compares_color);
    let [finding] = black.findings.as_slice() else {
        panic!("{:#?}", black.findings);
    };
    assert_eq!(finding.object.as_deref(), Some("car"));
    assert!(
        finding
            .text
            .starts_with("colour of `car` is (0.000, 0.000, 0.000) in the mean, not ("),
        "{}",
        finding.text
    );
    let red = recolored(&["hills"], &|[red, green, blue]| [green, red, blue]);
    assert!(
        matches!(red.findings[0].found.cause, Cause::OtherColor(..)),
        "{:#?}",
        red.findings
    );
    let names = scene.object_names();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let bright = recolored(&names, &|color| color.map(|value| 2.0 * value));
    let [finding] = bright.findings.as_slice() else {
        panic!("{:#?}", bright.findings);
    };
    let is_twice =
        matches!(finding.found.cause, Cause::Brightness(scale) if (scale - 2.0).abs() < 0.05);
    assert!(
        is_twice && finding.text.contains("`color_scale` 2.0"),
        "{finding:#?}"
    );
    // Light is an engine's own affair.
    let lit = load("railing");
    let dark = audit(
        &lit,
        &Capture {
            color: drawn.color.map(|_| [0.0; 3]),
            ..draw(&lit, 0.0)
        },
    );
    assert!(
        dark.findings.is_empty() && !dark.compares_color,
        "{:#?}",
        dark.findings
    );
}
