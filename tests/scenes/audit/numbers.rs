//! Velocity and depth of other numbers: the cause and its number are named.

use engine::{Buffer, Cause};

use super::{
    HEIGHT, WIDTH, audit, audit_depth, audit_velocity, draw, expect, id_of, load_moving,
    load_shipped, load_small, without_ids,
};

fn is_near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 0.01 * b.abs()
}

#[test]
fn other_numbers_of_velocity_are_named() {
    const LIMIT: f32 = 10.0;
    // Eight bits over the width.
    const STEP: f32 = 96.0 / 255.0;
    let scene = load_moving();
    let right = draw(&scene, 0.0).velocity;
    let changed =
        |change: fn([f32; 2]) -> [f32; 2]| audit_velocity(&scene, right.map(|it| change(*it)));
    type Row = (fn([f32; 2]) -> [f32; 2], fn(&Cause) -> bool);
    let rows: [Row; 13] = [
        (|_| [0.0; 2], |it| *it == Cause::Zero),
        (|[x, y]| [-x, -y], |it| *it == Cause::WrongSign),
        (|[x, y]| [x, -y], |it| *it == Cause::FlippedY),
        (|[x, y]| [-x, y], |it| *it == Cause::FlippedX),
        (|[x, y]| [y, x], |it| *it == Cause::SwappedAxes),
        (
            |it| it.map(|part| 2.0 * part),
            |it| matches!(it, Cause::Scale(found) if is_near(*found, 2.0)),
        ),
        (
            |it| it.map(|part| 0.5 * part),
            |it| matches!(it, Cause::Scale(found) if is_near(*found, 0.5)),
        ),
        (
            |it| it.map(|part| part / 60.0),
            |it| matches!(it, Cause::Scale(found) if is_near(*found, 1.0 / 60.0)),
        ),
        (
            |[x, y]| [2.0 * x, 3.0 * y],
            |it| matches!(it, Cause::ScaleOfAxes([x, y]) if is_near(*x, 2.0) && is_near(*y, 3.0)),
        ),
        (
            |[x, y]| [x - 0.25, y + 0.4],
            |it| matches!(it, Cause::Offset([x, y]) if is_near(*x, -0.25) && is_near(*y, 0.4)),
        ),
        (
            |[x, y]| [x, y].map(|part| part * (LIMIT / x.hypot(y)).min(1.0)),
            |it| matches!(it, Cause::Clipped(found) if is_near(*found, LIMIT.into())),
        ),
        (
            |it| it.map(|part| part.clamp(-LIMIT, LIMIT)),
            |it| matches!(it, Cause::ClippedAxes(found) if is_near(*found, LIMIT.into())),
        ),
        (
            |it| it.map(|part| (part / STEP).round() * STEP),
            |it| matches!(it, Cause::Steps(found) if is_near(*found, STEP.into())),
        ),
    ];
    for (change, is_cause) in rows {
        expect(&changed(change), Buffer::Velocity, None, is_cause);
    }
    let nonsense = changed(|[x, y]| [x.sin() * 9.0, (y * x).cos() * 9.0]);
    assert_eq!(nonsense.findings.len(), nonsense.velocity.len());
    let is_unknown = |it: &engine::Defect| it.found.cause == Cause::Unknown;
    assert!(nonsense.findings.iter().all(is_unknown), "{nonsense:#?}");
    let both = changed(|it| it.map(|part| -part / 60.0));
    let text = &both.findings[0].text;
    let begin = "velocity has the wrong sign and is 0.017 times as long";
    assert!(text.starts_with(begin), "{text}");
    assert!(text.contains("reverse `velocity_sign`"), "{text}");
}

#[test]
fn the_one_object_whose_velocity_is_wrong_is_named() {
    let scene = load_moving();
    let car = id_of(&scene, "car");
    let drawn = draw(&scene, 0.0);
    let velocity = drawn
        .velocity
        .zip(drawn.object_id.as_ref().unwrap(), |own, id| {
            if *id == car { [0.0; 2] } else { *own }
        });
    let found = audit_velocity(&scene, velocity);
    let finding = expect(&found, Buffer::Velocity, Some("car"), |it| {
        *it == Cause::Zero
    });
    let text = &finding.text;
    assert!(text.starts_with("velocity of `car` is zero"), "{text}");
    for object in &found.velocity {
        assert_eq!(object.is_right, object.object != "car", "{object:?}");
    }
    let car = found.velocity.iter().find(|own| own.object == "car");
    let car = car.unwrap();
    assert!((car.median - car.speed).abs() < 0.5, "{car:?}");
    assert_eq!(car.scale, Some(0.0), "{car:?}");
}

#[test]
fn other_numbers_of_depth_are_named() {
    let scene = load_small(None);
    let (_, scaled) = audit_depth(&scene, |_, depth| 100.0 * depth);
    expect(
        &scaled,
        Buffer::Depth,
        None,
        |it| matches!(it, Cause::DepthScale(scale) if (scale - 100.0).abs() < 0.01),
    );
    let view = scene.camera.view(0.0, WIDTH, HEIGHT);
    let (_, along_ray) = audit_depth(&scene, |at, depth| {
        let [x, y] = [at as u32 % WIDTH, at as u32 / WIDTH].map(|place| f64::from(place) + 0.5);
        let ray = view.ray(x, y);
        depth * (ray.direction.length() / view.depth(ray.at(1.0))) as f32
    });
    expect(&along_ray, Buffer::Depth, None, |it| {
        *it == Cause::DepthAlongRay
    });
    let mut capture = draw(&scene, 0.0);
    capture.depth = capture.depth.map(|depth| depth.min(1000.0));
    expect(
        &audit(&scene, &capture),
        Buffer::Depth,
        None,
        |it| matches!(it, Cause::DepthOfBackground(metres) if (metres - 1000.0).abs() < 0.1),
    );
}

#[test]
fn the_object_whose_depth_is_wrong_is_named() {
    let scene = load_small(None);
    let disc = id_of(&scene, "disc");
    let ids = draw(&scene, 0.0).object_id.unwrap();
    let (scaled, _) = audit_depth(&scene, |at, depth| match ids.pixels[at] == disc {
        true => 1.1 * depth,
        false => depth,
    });
    for capture in [without_ids(&scaled), scaled] {
        let found = audit(&scene, &capture);
        let finding = expect(
            &found,
            Buffer::Depth,
            Some("disc"),
            |it| matches!(it, Cause::DepthScale(scale) if (scale - 1.1).abs() < 0.001),
        );
        assert!(found.shows_scene);
        assert!(!finding.text.contains("near plane"), "{}", finding.text);
        let asks = finding.text.contains("object.exr would show");
        assert_eq!(asks, capture.object_id.is_none());
    }
}

#[test]
fn linear_depth_has_no_near_plane_to_blame() {
    let scene = load_shipped("railing");
    let (mut capture, found) = audit_depth(&scene, |_, depth| 1.0 / (0.5 / depth + 0.01));
    let finding = expect(&found, Buffer::Depth, None, |it| *it == Cause::Unknown);
    let words = "depth is wrong in no known way; it differs by more than 1 % at ";
    assert!(finding.text.starts_with(words), "{}", finding.text);
    capture.convention.depth = filters::DepthKind::Reversed;
    capture.convention.near = Some(0.1);
    expect(
        &audit(&scene, &capture),
        Buffer::Depth,
        None,
        |it| matches!(it, Cause::DepthPlanes(factor) if (factor - 2.0).abs() < 0.01),
    );
}
