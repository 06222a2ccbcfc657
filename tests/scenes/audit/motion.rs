//! Velocity of another motion: the cause is named.

use engine::{Cause, FRAMES_PER_SECOND};
use frame::VelocityKind;
use tracer::{PointMotion, Scene, trace_motion};

use super::{audit_velocity, load_moving, load_shipped, names, settings, trace_velocity};

/// Audits every known mistake in scenes, and expects that each is seen in one of them and named wherever it is.
fn assert_motions_named(scenes: &[Scene]) {
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
        for scene in scenes {
            let found = audit_velocity(scene, trace_velocity(scene, &motion));
            seen += usize::from(!found.findings.is_empty());
            let is_clock = matches!(cause, Cause::MotionOver(_));
            let is_silent = found.findings.is_empty();
            assert!(!is_clock || !is_silent, "{}: {cause:?}", scene.id);
            for finding in &found.findings {
                let is_named = match is_clock {
                    true => finding.found.cause == cause,
                    false => names(finding, |it| *it == cause),
                };
                assert!(is_named, "{}, {cause:?}: {finding:#?}", scene.id);
            }
        }
        assert!(seen > 0, "{cause:?} is seen in no scene");
    }
}

#[test]
fn other_motion_is_named() {
    assert_motions_named(&[load_moving()]);
}

#[test]
#[ignore = "prove: scenes in which things turn, drive, and the camera moves"]
fn other_motion_of_shipped_scenes_is_named() {
    assert_motions_named(&["fan", "railing", "roll"].map(load_shipped));
}

#[test]
fn a_wrong_sign_is_named_together_with_another_cause() {
    let scene = load_moving();
    let mut over_0_4 = PointMotion::RIGHT;
    over_0_4.over = 0.4;
    let instant = settings(VelocityKind::Instantaneous);
    let derivative = trace_motion(&scene, &instant, &PointMotion::RIGHT);
    let without_camera = trace_velocity(&scene, &PointMotion::WITHOUT_CAMERA);
    for (cause, velocity) in [
        (Cause::CameraMotionMissing, without_camera),
        (Cause::HalfFrameOff, derivative.unwrap().velocity),
        (Cause::MotionOver(60.0), trace_velocity(&scene, &over_0_4)),
    ] {
        for (turn, [x, y]) in [
            (Cause::WrongSign, [-1.0, -1.0]),
            (Cause::FlippedY, [1.0, -1.0]),
        ] {
            let found = audit_velocity(&scene, velocity.map(|it| [x * it[0], y * it[1]]));
            assert!(!found.findings.is_empty(), "{cause:?}");
            for finding in &found.findings {
                assert!(names(finding, |it| *it == cause), "{turn:?}: {finding:#?}");
                assert_eq!(finding.found.turned, Some(turn), "{finding:#?}");
            }
        }
    }
}
