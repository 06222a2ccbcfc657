//! Audits of captures: mistakes are named, and correct captures pass.
//!
//! Most use `fixtures/audit`, a scene of few triangles.

mod numbers;
mod picture;
mod planted;
mod structure;

use std::sync::LazyLock;

use engine::{AuditedScene, Buffer, Capture, CaptureAudit, Cause, Defect, FRAMES_PER_SECOND};
use frame::{FAR_DEPTH, Vectors, VelocityKind};
use scene::{Scene, load_scene};
use tests::unwatched;
use tracer::{PointMotion, RenderSettings, trace_frame, trace_motion};

use super::capture;
use crate::{load_shipped, shipped};

const WIDTH: u32 = 96;
const HEIGHT: u32 = 54;

/// Loads a variant of the small scene.
fn load_small(variant: Option<&str>) -> Scene {
    load_scene(tests::root().join("tests/fixtures/audit"), variant)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Loads the small scene in which everything moves.
fn load_moving() -> Scene {
    load_small(Some("moving"))
}

/// Makes settings of an engine's output: the motion since the previous frame, unless stated
/// otherwise.
fn settings(velocity: VelocityKind) -> RenderSettings {
    settings_of_size([WIDTH, HEIGHT], velocity)
}

fn settings_of_size(size: [u32; 2], velocity: VelocityKind) -> RenderSettings {
    let mut settings = tests::settings_of(size, 4, 1);
    settings.options.velocity = velocity;
    settings
}

fn trace_velocity(scene: &Scene, motion: &PointMotion) -> Vectors {
    let settings = settings(VelocityKind::PreviousFrame);
    trace_motion(scene, &settings, motion).unwrap().velocity
}

/// Captures the scene as an engine draws it some frames after the instant.
fn draw(scene: &Scene, time: f64) -> Capture {
    draw_in_size(scene, time, [WIDTH, HEIGHT])
}

fn draw_in_size(scene: &Scene, time: f64, size: [u32; 2]) -> Capture {
    let settings = settings_of_size(size, VelocityKind::PreviousFrame);
    let scene = scene.clone().later_by(time);
    capture(trace_frame(&scene, &settings, &unwatched).unwrap())
}

/// A scene and a correct capture of it, traced once for all audits.
struct DrawnScene<'a> {
    scene: &'a Scene,
    capture: Capture,
    audited: AuditedScene<'a>,
}

impl<'a> DrawnScene<'a> {
    fn new(scene: &'a Scene) -> Self {
        Self::in_size(scene, [WIDTH, HEIGHT])
    }

    fn in_size(scene: &'a Scene, size: [u32; 2]) -> Self {
        let capture = draw_in_size(scene, 0.0, size);
        let audited = AuditedScene::trace(scene, capture.color.size()).unwrap();
        Self {
            scene,
            capture,
            audited,
        }
    }

    fn audit(&self, capture: &Capture) -> CaptureAudit {
        self.audited.audit(capture).unwrap()
    }

    /// Audits the capture with another velocity.
    fn audit_velocity(&self, velocity: Vectors) -> CaptureAudit {
        let capture = Capture {
            velocity,
            ..self.capture.clone()
        };
        self.audit(&capture)
    }

    /// Copies the capture with changed depth, except the background's.
    fn change_depth(&self, change: impl Fn(usize, f32) -> f32) -> Capture {
        let mut capture = self.capture.clone();
        for (at, depth) in capture.depth.pixels.iter_mut().enumerate() {
            if *depth < 0.1 * FAR_DEPTH {
                *depth = change(at, *depth);
            }
        }
        capture
    }
}

static STILL_SCENE: LazyLock<Scene> = LazyLock::new(|| load_small(None));
static MOVING_SCENE: LazyLock<Scene> = LazyLock::new(load_moving);
static UNLIT_SCENE: LazyLock<Scene> = LazyLock::new(|| load_small(Some("unlit")));

/// The small scene, of which the disc alone turns.
static STILL: LazyLock<DrawnScene> = LazyLock::new(|| DrawnScene::new(&STILL_SCENE));
/// The small scene in which everything moves.
static MOVING: LazyLock<DrawnScene> = LazyLock::new(|| DrawnScene::new(&MOVING_SCENE));
/// The small scene without light.
static UNLIT: LazyLock<DrawnScene> = LazyLock::new(|| DrawnScene::new(&UNLIT_SCENE));

fn without_ids(capture: &Capture) -> Capture {
    let object_id = None;
    Capture {
        object_id,
        ..capture.clone()
    }
}

/// Number of an object.
fn id_of(scene: &Scene, name: &str) -> u32 {
    let names = scene.object_names();
    names.iter().position(|known| known == name).unwrap() as u32
}

fn names(defect: &Defect, is_cause: impl Fn(&Cause) -> bool) -> bool {
    let mut causes =
        std::iter::once(&defect.explanation.cause).chain(&defect.explanation.looks_like);
    causes.any(is_cause)
}

/// Expects one finding, in a buffer and of all objects or one, with this cause or one that looks
/// like it.
#[track_caller]
fn expect<'a>(
    audit: &'a CaptureAudit,
    buffer: Buffer,
    object: Option<&str>,
    is_cause: impl Fn(&Cause) -> bool,
) -> &'a Defect {
    let [finding] = audit.findings.as_slice() else {
        panic!("{}: {:#?}", audit.scene, audit.findings);
    };
    assert_eq!(finding.buffer, buffer, "{finding:#?}");
    assert_eq!(finding.object.as_deref(), object, "{finding:#?}");
    assert!(names(finding, is_cause), "{}: {finding:#?}", audit.scene);
    finding
}

#[track_caller]
fn assert_passes(drawn: &DrawnScene, capture: &Capture) {
    let (verdict, id) = (drawn.audit(capture), &drawn.scene.id);
    let passes = verdict.findings.is_empty() && verdict.shows_scene;
    assert!(passes, "{id}: {:#?}", verdict.findings);
    assert!(verdict.velocity.iter().all(|object| object.is_right));
    assert!(verdict.alike > 0.999, "{id}: {}", verdict.alike);
}

#[test]
fn honest_frames_pass_with_ids_and_without() {
    for drawn in [&STILL, &MOVING, &UNLIT] {
        assert_passes(drawn, &without_ids(&drawn.capture));
        assert_passes(drawn, &drawn.capture);
    }
}

#[test]
fn right_vectors_pass_as_half_floats() {
    let mut capture = MOVING.capture.clone();
    let round = |part: f32| half::f16::from_f32(part).to_f32();
    capture.velocity = capture.velocity.map(|velocity| velocity.map(round));
    assert_passes(&MOVING, &capture);
}

#[test]
#[ignore = "prove: all scenes of the catalogue"]
fn honest_frames_of_every_scene_pass_with_ids_and_without() {
    let mut all = shipped();
    all.extend(["fan@unlit", "railing@unlit", "walker@unlit"].map(str::to_owned));
    for name in all {
        let scene = &load_shipped(&name);
        let drawn = &DrawnScene::new(scene);
        assert_passes(drawn, &drawn.capture);
        let tells_without_ids = ["fan", "railing", "roll", "flag", "crossing", "cockpit"];
        if tells_without_ids.contains(&scene.id.name.as_str()) {
            assert_passes(drawn, &without_ids(&drawn.capture));
        }
    }
}

/// Audits every known mistake in scenes, and expects that each is seen in one of them and named
/// wherever it is.
fn assert_motions_named(scenes: &[&DrawnScene]) {
    let by_the_clock = |rate: f64| PointMotion {
        over: FRAMES_PER_SECOND / rate,
        ..PointMotion::RIGHT
    };
    let motions = [
        (Cause::FrameLate, PointMotion::FRAME_LATE),
        (Cause::FrameEarly, PointMotion::FRAME_EARLY),
        (Cause::PreviousPixel, PointMotion::PREVIOUS_PIXEL),
        (Cause::PreviousBuffer, PointMotion::PREVIOUS_BUFFER),
        (Cause::MatrixNeverSet, PointMotion::MATRIX_NEVER_SET),
        (Cause::ObjectMotionMissing, PointMotion::WITHOUT_OBJECTS),
        (Cause::CameraMotionMissing, PointMotion::WITHOUT_CAMERA),
        (Cause::MotionOver(60.0), by_the_clock(60.0)),
        (Cause::MotionOver(30.0), by_the_clock(30.0)),
        (Cause::MotionOver(120.0), by_the_clock(120.0)),
    ];
    for (cause, motion) in motions {
        let mut seen = 0;
        for drawn in scenes {
            let scene = drawn.scene;
            let verdict = drawn.audit_velocity(trace_velocity(scene, &motion));
            seen += usize::from(!verdict.findings.is_empty());
            let is_clock = matches!(cause, Cause::MotionOver(_));
            let is_silent = verdict.findings.is_empty();
            assert!(!is_clock || !is_silent, "{}: {cause:?}", scene.id);
            for finding in &verdict.findings {
                // Without parents, an object's own motion is all of its motion.
                let is_of_object = finding.object.is_some() && cause == Cause::ObjectMotionMissing;
                // At the origin this car is behind the camera, where the trace has no motion.
                let is_behind = cause == Cause::MatrixNeverSet
                    && scene.id.name == "railing"
                    && finding.object.as_deref() == Some("car");
                let is_same = |named: &Cause| {
                    *named == cause
                        || is_of_object && *named == Cause::OwnMotionMissing
                        || is_behind && *named == Cause::Zero
                };
                let is_named = if is_clock {
                    finding.explanation.cause == cause
                } else {
                    names(finding, is_same)
                };
                assert!(is_named, "{}, {cause:?}: {finding:#?}", scene.id);
            }
        }
        assert!(seen > 0, "{cause:?} is seen in no scene");
    }
}

#[test]
fn other_motion_is_named() {
    assert_motions_named(&[&MOVING]);
}

#[test]
#[ignore = "prove: scenes in which things turn, drive, and the camera moves"]
fn other_motion_of_shipped_scenes_is_named() {
    let scenes = ["fan", "railing", "roll"].map(load_shipped);
    let drawn = scenes.each_ref().map(DrawnScene::new);
    assert_motions_named(&drawn.each_ref());
}

#[test]
fn a_wrong_sign_is_named_together_with_another_cause() {
    let scene = &*MOVING_SCENE;
    let mut over_0_4 = PointMotion::RIGHT;
    over_0_4.over = 0.4;
    let instant = settings(VelocityKind::Instantaneous);
    let derivative = trace_motion(scene, &instant, &PointMotion::RIGHT);
    let without_camera = trace_velocity(scene, &PointMotion::WITHOUT_CAMERA);
    for (cause, velocity) in [
        (Cause::CameraMotionMissing, without_camera),
        (Cause::HalfFrameOff, derivative.unwrap().velocity),
        (Cause::MotionOver(60.0), trace_velocity(scene, &over_0_4)),
    ] {
        for (turn, [x, y]) in [
            (Cause::WrongSign, [-1.0, -1.0]),
            (Cause::FlippedY, [1.0, -1.0]),
        ] {
            let turned = velocity.map(|vector| [x * vector[0], y * vector[1]]);
            let verdict = MOVING.audit_velocity(turned);
            assert!(!verdict.findings.is_empty(), "{cause:?}");
            for finding in &verdict.findings {
                assert!(
                    names(finding, |named| *named == cause),
                    "{turn:?}: {finding:#?}"
                );
                assert_eq!(
                    finding.explanation.turned.as_ref(),
                    Some(&turn),
                    "{finding:#?}"
                );
            }
        }
    }
}
