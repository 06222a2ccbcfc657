//! Velocity and depth of other numbers: the cause and its number are named.

use engine::{Buffer, Cause};

use super::*;

/// Returns whether two causes are of one kind, with numbers that differ by a hundredth at most.
fn is_like(actual: &Cause, due: &Cause) -> bool {
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= 0.01 * b.abs();
    match (actual, due) {
        (Cause::Scale(a), Cause::Scale(b))
        | (Cause::Clipped(a), Cause::Clipped(b))
        | (Cause::ClippedAxes(a), Cause::ClippedAxes(b))
        | (Cause::Steps(a), Cause::Steps(b)) => is_near((a, b)),
        (Cause::ScaleOfAxes(a), Cause::ScaleOfAxes(b)) | (Cause::Offset(a), Cause::Offset(b)) => {
            a.iter().zip(b).all(is_near)
        }
        _ => actual == due,
    }
}

#[test]
fn other_numbers_of_velocity_are_named() {
    const LIMIT: f32 = 10.0;
    // Eight bits over the width.
    const STEP: f32 = 96.0 / 255.0;
    let right = &MOVING.capture.velocity;
    let changed = |change: fn([f32; 2]) -> [f32; 2]| {
        MOVING.audit_velocity(right.map(|vector| change(*vector)))
    };
    type Change = fn([f32; 2]) -> [f32; 2];
    let rows: [(Change, Cause); 13] = [
        (|_| [0.0; 2], Cause::Zero),
        (|[x, y]| [-x, -y], Cause::WrongSign),
        (|[x, y]| [x, -y], Cause::FlippedY),
        (|[x, y]| [-x, y], Cause::FlippedX),
        (|[x, y]| [y, x], Cause::SwappedAxes),
        (|vector| vector.map(|part| 2.0 * part), Cause::Scale(2.0)),
        (|vector| vector.map(|part| 0.5 * part), Cause::Scale(0.5)),
        (
            |vector| vector.map(|part| part / 60.0),
            Cause::Scale(1.0 / 60.0),
        ),
        (|[x, y]| [2.0 * x, 3.0 * y], Cause::ScaleOfAxes([2.0, 3.0])),
        (|[x, y]| [x - 0.25, y + 0.4], Cause::Offset([-0.25, 0.4])),
        (
            |[x, y]| [x, y].map(|part| part * (LIMIT / x.hypot(y)).min(1.0)),
            Cause::Clipped(LIMIT.into()),
        ),
        (
            |vector| vector.map(|part| part.clamp(-LIMIT, LIMIT)),
            Cause::ClippedAxes(LIMIT.into()),
        ),
        (
            |vector| vector.map(|part| (part / STEP).round() * STEP),
            Cause::Steps(STEP.into()),
        ),
    ];
    for (change, due) in rows {
        let verdict = changed(change);
        expect(&verdict, Buffer::Velocity, None, |named| {
            is_like(named, &due)
        });
    }
    let nonsense = changed(|[x, y]| [x.sin() * 9.0, (y * x).cos() * 9.0]);
    assert_eq!(nonsense.findings.len(), nonsense.velocity.len());
    let is_unknown = |defect: &engine::Defect| defect.explanation.cause == Cause::Unknown;
    assert!(nonsense.findings.iter().all(is_unknown), "{nonsense:#?}");
    let both = changed(|vector| vector.map(|part| -part / 60.0));
    let text = &both.findings[0].text;
    let begin = "velocity has the wrong sign and is 0.017 times as long";
    assert!(text.starts_with(begin), "{text}");
    assert!(text.contains("reverse `velocity_sign`"), "{text}");
}

#[test]
fn the_one_object_whose_velocity_is_wrong_is_named() {
    let car = id_of(MOVING.scene, "car");
    let capture = &MOVING.capture;
    let ids = capture.object_id.as_ref().unwrap();
    let still = |velocity: &[f32; 2], id: &u32| if *id == car { [0.0; 2] } else { *velocity };
    let verdict = MOVING.audit_velocity(capture.velocity.zip(ids, still));
    let is_zero = |cause: &Cause| *cause == Cause::Zero;
    let finding = expect(&verdict, Buffer::Velocity, Some("car"), is_zero);
    let text = &finding.text;
    assert!(text.starts_with("velocity of `car` is zero"), "{text}");
    for object in &verdict.velocity {
        assert_eq!(object.is_right, object.object != "car", "{object:?}");
    }
    let car = verdict
        .velocity
        .iter()
        .find(|object| object.object == "car");
    let car = car.unwrap();
    assert!((car.median - car.speed).abs() < 0.5, "{car:?}");
    assert_eq!(car.scale, Some(0.0), "{car:?}");
}

#[test]
fn other_numbers_of_depth_are_named() {
    let scaled = STILL.audit(&STILL.change_depth(|_, depth| 100.0 * depth));
    let is_100 =
        |cause: &Cause| matches!(cause, Cause::DepthScale(by) if (by - 100.0).abs() < 0.01);
    expect(&scaled, Buffer::Depth, None, is_100);
    let view = tracer::View::new(&STILL.scene.camera, 0.0, WIDTH, HEIGHT);
    let along_ray = STILL.change_depth(|at, depth| {
        let [x, y] = [at as u32 % WIDTH, at as u32 / WIDTH].map(|place| f64::from(place) + 0.5);
        let ray = view.ray(x, y);
        depth * (ray.direction.length() / view.depth(ray.at(1.0))) as f32
    });
    let is_along = |cause: &Cause| *cause == Cause::DepthAlongRay;
    expect(&STILL.audit(&along_ray), Buffer::Depth, None, is_along);
    let mut capture = STILL.capture.clone();
    capture.depth = capture.depth.map(|depth| depth.min(1000.0));
    let is_km =
        |cause: &Cause| matches!(cause, Cause::DepthOfBackground(m) if (m - 1000.0).abs() < 0.1);
    expect(&STILL.audit(&capture), Buffer::Depth, None, is_km);
}

#[test]
fn the_object_whose_depth_is_wrong_is_named() {
    let disc = id_of(STILL.scene, "disc");
    let ids = STILL.capture.object_id.as_ref().unwrap();
    let scaled = STILL.change_depth(|at, depth| {
        if ids.pixels[at] == disc {
            1.1 * depth
        } else {
            depth
        }
    });
    for capture in [without_ids(&scaled), scaled] {
        let verdict = STILL.audit(&capture);
        let is_due =
            |cause: &Cause| matches!(cause, Cause::DepthScale(by) if (by - 1.1).abs() < 0.001);
        let finding = expect(&verdict, Buffer::Depth, Some("disc"), is_due);
        assert!(verdict.shows_scene);
        assert!(!finding.text.contains("near plane"), "{}", finding.text);
        let asks = finding.text.contains("object.exr would show");
        assert_eq!(asks, capture.object_id.is_none());
    }
}

#[test]
fn linear_depth_has_no_near_plane_to_blame() {
    let scene = load_shipped("railing");
    let drawn = DrawnScene::new(&scene);
    let mut capture = drawn.change_depth(|_, depth| 1.0 / (0.5 / depth + 0.01));
    let verdict = drawn.audit(&capture);
    let is_unknown = |cause: &Cause| *cause == Cause::Unknown;
    let finding = expect(&verdict, Buffer::Depth, None, is_unknown);
    let words = "depth is wrong in no known way; it differs by more than 1 % at ";
    assert!(finding.text.starts_with(words), "{}", finding.text);
    capture.convention.depth = filters::DepthKind::Reversed;
    capture.convention.near = Some(0.1);
    let is_twice =
        |cause: &Cause| matches!(cause, Cause::DepthPlanes(by) if (by - 2.0).abs() < 0.01);
    expect(&drawn.audit(&capture), Buffer::Depth, None, is_twice);
}
