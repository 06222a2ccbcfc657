//! Audits of velocity and depth that are wrong: the cause is named.

use engine::{Buffer, Capture, Cause};
use frame::VelocityKind;
use tracer::{PointMotion, RenderSettings};

use crate::audit::{HEIGHT, WIDTH, audit, load, trace};
use crate::audit_planted::{draw, expect, id_of, without_ids};

#[test]
fn motion_by_the_clock_is_named() {
    for name in ["fan", "railing", "roll"] {
        let scene = load(name);
        for rate in [60.0, 30.0, 120.0] {
            let motion = PointMotion {
                over: engine::FRAMES_PER_SECOND / rate,
                ..PointMotion::RIGHT
            };
            let velocity = trace(&scene, motion).velocity;
            let drawn = draw(&scene, 0.0);
            let found = audit(&scene, &Capture { velocity, ..drawn });
            assert!(!found.findings.is_empty(), "{name} at {rate}");
            for finding in &found.findings {
                assert_eq!(
                    finding.found.cause,
                    Cause::MotionOver(rate),
                    "{name}: {finding:#?}"
                );
            }
        }
    }
}

#[test]
fn a_wrong_sign_is_named_together_with_another_cause() {
    // The camera of cockpit moves along curves, and objects move before it.
    for (name, cause, motion) in [
        (
            "cockpit",
            Cause::CameraMotionMissing,
            PointMotion::WITHOUT_CAMERA,
        ),
        ("roll", Cause::HalfFrameOff, PointMotion::RIGHT),
        (
            "fan",
            Cause::MotionOver(60.0),
            PointMotion {
                over: 0.4,
                ..PointMotion::RIGHT
            },
        ),
    ] {
        let scene = load(name);
        let velocity = match cause {
            Cause::HalfFrameOff => {
                let mut settings = RenderSettings {
                    width: WIDTH,
                    height: HEIGHT,
                    ..RenderSettings::default()
                };
                settings.options.velocity = VelocityKind::Instantaneous;
                tracer::trace_motion(&scene, &settings, &motion)
                    .unwrap()
                    .velocity
            }
            _ => trace(&scene, motion).velocity,
        };
        for (turn, [x, y]) in [
            (Cause::WrongSign, [-1.0, -1.0]),
            (Cause::FlippedY, [1.0, -1.0]),
        ] {
            let velocity = velocity.map(|it| [x * it[0], y * it[1]]);
            let found = audit(
                &scene,
                &Capture {
                    velocity,
                    ..draw(&scene, 0.0)
                },
            );
            assert!(!found.findings.is_empty(), "{name}");
            for finding in &found.findings {
                let found = &finding.found;
                assert!(
                    found.cause == cause || found.looks_like.contains(&cause),
                    "{name} {turn:?}: {finding:#?}"
                );
                assert_eq!(found.turned, Some(turn), "{name}: {finding:#?}");
            }
        }
    }
    let scene = load("roll");
    let drawn = draw(&scene, 0.0);
    let velocity = drawn.velocity.map(|[x, y]| [-x / 60.0, -y / 60.0]);
    let found = audit(&scene, &Capture { velocity, ..drawn });
    let [finding] = found.findings.as_slice() else {
        panic!("{:#?}", found.findings);
    };
    assert!(
        finding
            .text
            .starts_with("velocity has the wrong sign and is 0.017 times as long"),
        "{}",
        finding.text
    );
    assert!(
        finding.text.contains("reverse `velocity_sign`"),
        "{}",
        finding.text
    );
}

#[test]
fn the_object_whose_depth_is_wrong_is_named() {
    let scene = load("fan");
    let fan = id_of(&scene, "fan");
    let drawn = draw(&scene, 0.0);
    let scaled = drawn
        .depth
        .zip(drawn.object_id.as_ref().unwrap(), |depth, id| {
            if *id == fan { 1.1 * depth } else { *depth }
        });
    let scaled = Capture {
        depth: scaled,
        ..drawn
    };
    for capture in [without_ids(&scaled), scaled] {
        let found = audit(&scene, &capture);
        let [finding] = found.findings.as_slice() else {
            panic!("{:#?}", found.findings);
        };
        let is_scale =
            matches!(finding.found.cause, Cause::DepthScale(scale) if (scale - 1.1).abs() < 0.001);
        assert!(
            is_scale && finding.object.as_deref() == Some("fan"),
            "{finding:#?}"
        );
        assert!(found.shows_scene);
        assert!(!finding.text.contains("near plane"), "{}", finding.text);
        assert_eq!(
            finding.text.contains("object.exr would show"),
            capture.object_id.is_none()
        );
    }
}

#[test]
fn linear_depth_has_no_near_plane_to_blame() {
    let scene = load("railing");
    let mut capture = draw(&scene, 0.0);
    for depth in &mut capture.depth.pixels {
        if *depth < 0.1 * frame::FAR_DEPTH {
            *depth = 1.0 / (0.5 / *depth + 0.01);
        }
    }
    let found = audit(&scene, &capture);
    expect(&found, Buffer::Depth, None, Cause::Unknown);
    let words = "depth is wrong in no known way; it differs by more than 1 % at ";
    assert!(
        found.findings[0].text.starts_with(words),
        "{}",
        found.findings[0].text
    );
    capture.convention.depth = filters::DepthKind::Reversed;
    capture.convention.near = Some(0.1);
    let found = audit(&scene, &capture);
    let [finding] = found.findings.as_slice() else {
        panic!("{:#?}", found.findings);
    };
    let is_planes =
        matches!(finding.found.cause, Cause::DepthPlanes(factor) if (factor - 2.0).abs() < 0.01);
    assert!(is_planes, "{finding:#?}");
}
