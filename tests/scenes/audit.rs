//! Audits of captures: planted defects of velocity and depth are named, and right ones pass.

use std::path::PathBuf;

use engine::{Capture, CaptureAudit, CaptureDescription, Cause, Defect, audit_capture};
use filters::Convention;
use frame::{FAR_DEPTH, Image, Vectors};
use tests::scenes;
use tracer::{PointLayers, PointMotion, RenderSettings, Scene, load_scene, trace_motion};

pub const WIDTH: u32 = 96;
pub const HEIGHT: u32 = 54;

pub fn load(name: &str) -> Scene {
    load_scene(scenes().join(name), None).unwrap_or_else(|error| panic!("{error}"))
}

/// Traces what an engine hands over: the motion since the frame before, unless it is another.
pub fn trace(scene: &Scene, motion: PointMotion) -> PointLayers {
    let mut settings = RenderSettings {
        width: WIDTH,
        height: HEIGHT,
        ..RenderSettings::default()
    };
    settings.options.velocity = frame::VelocityKind::PreviousFrame;
    trace_motion(scene, &settings, &motion).unwrap()
}

/// Makes a capture of layers, with another velocity.
pub fn capture(layers: &PointLayers, velocity: Vectors) -> Capture {
    Capture {
        folder: PathBuf::from("capture"),
        description: CaptureDescription {
            engine: "test".to_owned(),
            scene: None,
            exposure: None,
            alignment: None,
            instant: 0.0,
            subframes: None,
            stops: None,
        },
        convention: Convention::default(),
        color: Image::filled(WIDTH, HEIGHT, [0.5; 3]),
        velocity,
        depth: layers.depth.clone(),
        object_id: Some(layers.object_id.clone()),
        blurred: None,
        subframes: Vec::new(),
        notes: Vec::new(),
    }
}

pub fn audit(scene: &Scene, capture: &Capture) -> CaptureAudit {
    audit_capture(capture, scene).unwrap().0
}

/// Expects one defect, of all objects or of one, whose cause is the given one or looks like it.
fn expect(audit: &CaptureAudit, object: Option<&str>, is_cause: impl Fn(&Cause) -> bool) {
    let [defect] = audit.findings.as_slice() else {
        panic!("{}: {:#?}", audit.scene, audit.findings);
    };
    let named = defect.object.as_deref();
    assert!(
        object.is_none_or(|object| named == Some(object)),
        "{defect:#?}"
    );
    let mut causes = std::iter::once(&defect.found.cause).chain(&defect.found.looks_like);
    assert!(causes.any(is_cause), "{}: {defect:#?}", audit.scene);
}

#[test]
fn right_vectors_pass_as_half_floats() {
    let scene = load("roll");
    let layers = trace(&scene, PointMotion::RIGHT);
    let halves = (layers.velocity).map(|it| it.map(|part| half::f16::from_f32(part).to_f32()));
    assert_passes(&scene, &capture(&layers, halves));
}

fn assert_passes(scene: &Scene, capture: &Capture) {
    let found = audit(scene, capture);
    assert!(
        found.findings.is_empty(),
        "{}: {:#?}",
        scene.id,
        found.findings
    );
    assert!(found.velocity.iter().all(|object| object.is_right));
}

#[test]
fn other_motion_is_named() {
    let motions = [
        (Cause::FrameLate, PointMotion::FRAME_LATE),
        (Cause::FrameEarly, PointMotion::FRAME_EARLY),
        (Cause::PreviousPixel, PointMotion::PREVIOUS_PIXEL),
        (Cause::PreviousBuffer, PointMotion::PREVIOUS_BUFFER),
        (Cause::MatrixNeverSet, PointMotion::MATRIX_NEVER_SET),
        (Cause::ObjectMotionMissing, PointMotion::WITHOUT_OBJECTS),
        (Cause::CameraMotionMissing, PointMotion::WITHOUT_CAMERA),
    ];
    // Something turns in the fan; the camera moves in roll and cockpit.
    for (cause, motion) in motions {
        let mut seen = 0;
        for name in ["fan", "roll", "cockpit"] {
            let scene = load(name);
            let layers = trace(&scene, PointMotion::RIGHT);
            let velocity = trace(&scene, motion).velocity;
            let found = audit(&scene, &capture(&layers, velocity));
            seen += usize::from(!found.findings.is_empty());
            let is_named = |defect: &Defect| {
                defect.found.cause == cause || defect.found.looks_like.contains(&cause)
            };
            assert!(
                found.findings.iter().all(is_named),
                "{name}, {cause:?}: {:#?}",
                found.findings
            );
        }
        assert!(seen > 0, "{cause:?} is seen in no scene");
    }
}

#[test]
fn other_numbers_are_named() {
    let scene = load("roll");
    let layers = trace(&scene, PointMotion::RIGHT);
    let changed = |change: &dyn Fn([f32; 2]) -> [f32; 2]| {
        audit(
            &scene,
            &capture(&layers, layers.velocity.map(|it| change(*it))),
        )
    };
    let is_near = |a: f64, b: f64| (a - b).abs() <= 0.01 * b.abs();
    expect(&changed(&|_| [0.0; 2]), None, |it| *it == Cause::Zero);
    expect(&changed(&|[x, y]| [-x, -y]), None, |it| {
        *it == Cause::WrongSign
    });
    expect(&changed(&|[x, y]| [x, -y]), None, |it| {
        *it == Cause::FlippedY
    });
    expect(&changed(&|[x, y]| [-x, y]), None, |it| {
        *it == Cause::FlippedX
    });
    expect(&changed(&|[x, y]| [y, x]), None, |it| {
        *it == Cause::SwappedAxes
    });
    for scale in [2.0, 0.5, 1.0 / 60.0] {
        expect(
            &changed(&|[x, y]| [scale * x, scale * y]),
            None,
            |it| matches!(it, Cause::Scale(found) if is_near(*found, f64::from(scale))),
        );
    }
    expect(
        &changed(&|[x, y]| [2.0 * x, 3.0 * y]),
        None,
        |it| matches!(it, Cause::ScaleOfAxes([x, y]) if is_near(*x, 2.0) && is_near(*y, 3.0)),
    );
    expect(
        &changed(&|[x, y]| [x - 0.25, y + 0.4]),
        None,
        |it| matches!(it, Cause::Offset([x, y]) if is_near(*x, -0.25) && is_near(*y, 0.4)),
    );
    let limit = 16.0;
    let cut = |[x, y]: [f32; 2]| {
        let factor = (limit / x.hypot(y)).min(1.0);
        [x * factor, y * factor]
    };
    expect(
        &changed(&cut),
        None,
        |it| matches!(it, Cause::Clipped(found) if is_near(*found, 16.0)),
    );
    let clamped = |it: [f32; 2]| it.map(|part| part.clamp(-limit, limit));
    expect(
        &changed(&clamped),
        None,
        |it| matches!(it, Cause::ClippedAxes(found) if is_near(*found, 16.0)),
    );
    // Eight bits over the width.
    let step = 96.0 / 255.0;
    let stepped = |it: [f32; 2]| it.map(|part| (part / step).round() * step);
    expect(
        &changed(&stepped),
        None,
        |it| matches!(it, Cause::Steps(found) if is_near(*found, f64::from(step))),
    );
    let nonsense = changed(&|[x, y]| [x.sin() * 9.0, (y * x).cos() * 9.0]);
    let is_unknown = |defect: &Defect| defect.found.cause == Cause::Unknown;
    assert!(nonsense.findings.iter().all(is_unknown), "{nonsense:#?}");
    assert_eq!(nonsense.findings.len(), 2, "village and background");
}

#[test]
fn the_one_object_that_is_wrong_is_named() {
    let scene = load("railing");
    let layers = trace(&scene, PointMotion::RIGHT);
    let names: Vec<&str> = scene
        .objects
        .iter()
        .map(|object| object.name.as_str())
        .collect();
    let car = 1 + names.iter().position(|name| *name == "car").unwrap() as u32;
    let velocity = layers.velocity.zip(&layers.object_id, |velocity, object| {
        if *object == car { [0.0; 2] } else { *velocity }
    });
    let found = audit(&scene, &capture(&layers, velocity));
    expect(&found, Some("car"), |it| *it == Cause::Zero);
    assert!(
        found.findings[0]
            .text
            .starts_with("velocity of `car` is zero"),
        "{:#?}",
        found.findings
    );
    let wrong: Vec<&str> = (found.velocity.iter())
        .filter(|object| !object.is_right)
        .map(|object| object.object.as_str())
        .collect();
    assert_eq!(wrong, ["car"]);
    let car = found
        .velocity
        .iter()
        .find(|object| object.object == "car")
        .unwrap();
    assert!(
        (car.median - car.speed).abs() < 0.5 && car.scale == Some(0.0),
        "{car:?}"
    );
}

#[test]
fn wrong_depth_is_named() {
    let scene = load("railing");
    let layers = trace(&scene, PointMotion::RIGHT);
    let changed = |change: &dyn Fn(f32, usize) -> f32| {
        let mut capture = capture(&layers, layers.velocity.clone());
        for (at, depth) in capture.depth.pixels.iter_mut().enumerate() {
            *depth = change(*depth, at);
        }
        audit(&scene, &capture)
    };
    let surface = |depth: f32, changed: f32| {
        if depth < 0.1 * FAR_DEPTH {
            changed
        } else {
            depth
        }
    };
    expect(
        &changed(&|depth, _| surface(depth, 100.0 * depth)),
        None,
        |it| matches!(it, Cause::DepthScale(scale) if (scale - 100.0).abs() < 0.01),
    );
    let view = scene.camera.view(0.0, WIDTH, HEIGHT);
    let along_ray = |depth: f32, at: usize| {
        let ray = view.ray(
            (at as u32 % WIDTH) as f64 + 0.5,
            (at as u32 / WIDTH) as f64 + 0.5,
        );
        surface(
            depth,
            depth * (ray.direction.length() / view.depth(ray.at(1.0))) as f32,
        )
    };
    expect(&changed(&along_ray), None, |it| *it == Cause::DepthAlongRay);
    expect(
        &changed(&|depth, _| depth.min(1000.0)),
        None,
        |it| matches!(it, Cause::DepthOfBackground(metres) if (metres - 1000.0).abs() < 0.1),
    );
}

#[test]
fn a_picture_of_something_else_is_said_before_its_vectors() {
    let scene = load("railing");
    let other = trace(&load("fan"), PointMotion::RIGHT);
    let found = audit(&scene, &capture(&other, other.velocity.clone()));
    expect(&found, None, |it| *it == Cause::OtherView);
}
