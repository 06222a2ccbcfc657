//! Velocity and depth, against formulas.

use frame::{FAR_DEPTH, Frame, VelocityKind};
use glam::{DQuat, DVec2, DVec3, Vec3};
use scene::{Interpolation, Key, Motion, Parent, Scene, Turn};
use tracer::{PixelGrid, trace_further_velocities};

use crate::renders::{self, *};

const WIDTH: u32 = 33;
const HEIGHT: u32 = 21;
/// Focal length in pixels at a vertical field of view of 90 degrees.
const FOCAL: f64 = 0.5 * HEIGHT as f64;
/// Tolerance in pixels per frame.
const TOLERANCE: f64 = 1e-3;

fn render_frame(scene: &Scene, velocity: VelocityKind) -> Frame {
    renders::render_frame(scene, &settings_with([WIDTH, HEIGHT], 1, velocity))
}

/// Returns the centre of a pixel, in pixels from the picture's centre, +x right, +y **up**.
fn pixel_center(x: u32, y: u32) -> DVec2 {
    DVec2::new(
        f64::from(x) + 0.5 - 0.5 * f64::from(WIDTH),
        0.5 * f64::from(HEIGHT) - f64::from(y) - 0.5,
    )
}

/// Returns the point that a still camera at the origin sees at a position and depth.
fn point_at(place: DVec2, depth: f64) -> DVec3 {
    DVec3::new(place.x * depth / FOCAL, place.y * depth / FOCAL, -depth)
}

/// Returns the position at which a still camera at the origin sees a point, in pixels from the
/// centre, y up.
fn project(point: DVec3) -> DVec2 {
    FOCAL * DVec2::new(point.x, point.y) / -point.z
}

/// Returns the velocity on screen of a point that moves relative to the camera.
fn screen_motion(place: DVec2, depth: f64, velocity: DVec3) -> DVec2 {
    (FOCAL * DVec2::new(velocity.x, velocity.y) + place * velocity.z) / depth
}

/// Compares every pixel's velocity with the exact one at its position, y up.
fn expect_velocity(scene: &Scene, kind: VelocityKind, exact: impl Fn(DVec2) -> DVec2) {
    let frame = render_frame(scene, kind);
    for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
        let [right, down] = frame.velocity.at(x, y).map(f64::from);
        let expected = exact(pixel_center(x, y));
        assert!(
            DVec2::new(right, -down).distance(expected) < TOLERANCE,
            "{kind}: pixel ({x}, {y}) has {right} right, {down} down, not {expected} (y up)"
        );
    }
}

/// Compares both kinds of velocity: the derivative at the instant, and the motion since the
/// previous frame.
fn expect_velocities(
    scene: &Scene,
    derivative: impl Fn(DVec2) -> DVec2,
    previous: impl Fn(DVec2) -> DVec2,
) {
    expect_velocity(scene, VelocityKind::Instantaneous, derivative);
    expect_velocity(scene, VelocityKind::PreviousFrame, previous);
}

/// Makes a wall that fills the view, `depth` metres away at `t = 0`.
fn wall_scene(depth: f64, motion_at: impl Fn(DVec3) -> Motion) -> Scene {
    let mut scene = empty_scene("wall");
    let motion = motion_at(DVec3::new(0.0, 0.0, -depth));
    add(&mut scene, rectangle(1000.0, 1000.0), glowing(1.0), motion);
    scene
}

#[test]
fn a_translated_wall_moves_by_perspective() {
    let depth = 7.0;
    let velocity = DVec3::new(0.8, -0.5, 1.3);
    let scene = wall_scene(depth, |at| drift(at, velocity));
    expect_velocities(
        &scene,
        |place| screen_motion(place, depth, velocity),
        |place| place - project(point_at(place, depth) - velocity),
    );
}

#[test]
fn a_spinning_wall_moves_around_its_axis() {
    for rate in [0.3, -2.0, 40.0] {
        let scene = wall_scene(5.0, |at| spin(at, DVec3::Z, rate));
        expect_velocities(
            &scene,
            |place| rate * place.perp(),
            |place| place - DVec2::from_angle(-rate).rotate(place),
        );
    }
}

#[test]
fn a_tilted_turning_box_moves_as_its_points_do() {
    let axis = DVec3::new(0.6, 0.0, 0.8);
    let rate = 1.7;
    let centre = DVec3::new(0.3, -0.2, -6.0);
    let mut scene = empty_scene("box");
    let (mesh, motion) = (cuboid(Vec3::new(30.0, 30.0, 2.0)), spin(centre, axis, rate));
    add(&mut scene, mesh, glowing(1.0), motion);
    expect_velocity(&scene, VelocityKind::Instantaneous, |place| {
        screen_motion(place, 5.0, rate * axis.cross(point_at(place, 5.0) - centre))
    });
}

#[test]
fn a_child_moves_with_its_parent() {
    let mut scene = wall_scene(5.0, placed);
    let rate = 0.9;
    let turning = spin(DVec3::ZERO, DVec3::Z, rate);
    add(&mut scene, rectangle(0.001, 0.001), glowing(1.0), turning);
    scene.objects.swap(0, 1);
    scene.objects[1].parent = Parent::Object(0);
    let turned = |place: DVec2| rate * place.perp();
    expect_velocity(&scene, VelocityKind::Instantaneous, turned);
}

/// Makes a cubic motion through keys at -1, 0 and 1, with positions and angles about one axis.
fn smooth_motion(axis: DVec3, angle: impl Fn(f64) -> f64, place: impl Fn(f64) -> DVec3) -> Motion {
    let key = |time: f64| Key {
        time,
        translation: place(time),
        orientation: DQuat::from_axis_angle(axis, angle(time)),
        turn: Turn {
            axis,
            angle: angle(time + 1.0) - angle(time),
        },
        ..Key::REST
    };
    Motion {
        keys: [-1.0, 0.0, 1.0].map(key).to_vec(),
        interpolation: Interpolation::Cubic,
    }
}

#[test]
fn a_dolly_makes_everything_stream_from_the_centre() {
    let (depth, speed) = (4.0, 0.6);
    for brake in [0.0, 0.2] {
        let mut scene = wall_scene(depth, placed);
        let place = |time: f64| (speed * time - brake * time * time) * DVec3::NEG_Z;
        scene.camera.motion = match brake {
            0.0 => drift(DVec3::ZERO, speed * DVec3::NEG_Z),
            _ => smooth_motion(DVec3::Y, |_| 0.0, place),
        };
        expect_velocities(
            &scene,
            |place| place * speed / depth,
            |place| place * (1.0 - depth / (depth + speed + brake)),
        );
    }
}

#[test]
fn pans_and_rolls_move_near_and_infinite_things_alike() {
    let rate = 0.2;
    for axis in [DVec3::Y, DVec3::Z, DVec3::new(0.6, 0.0, 0.8)] {
        for growth in [0.0, 0.05] {
            let angle = |time: f64| rate * time + growth * time * time;
            let motion = match growth {
                0.0 => spin(DVec3::ZERO, axis, rate),
                _ => smooth_motion(axis, angle, |_| DVec3::ZERO),
            };
            for mut scene in [wall_scene(4.0, placed), empty_scene("background")] {
                scene.camera.motion = motion.clone();
                expect_velocities(
                    &scene,
                    |place| screen_motion(place, 4.0, -rate * axis.cross(point_at(place, 4.0))),
                    |place| {
                        let before = DQuat::from_axis_angle(axis, angle(-1.0));
                        place - project(before.inverse() * point_at(place, 4.0))
                    },
                );
            }
        }
    }
}

#[test]
fn an_orbit_moves_and_turns_the_camera_at_once() {
    let (depth, radius, rate) = (4.0, 5.0, 0.15);
    let mut scene = wall_scene(depth, placed);
    // Around a point straight ahead, which the camera keeps in the middle.
    let place = |time: f64| {
        let (sine, cosine) = (rate * time).sin_cos();
        radius * DVec3::new(sine, 0.0, cosine - 1.0)
    };
    scene.camera.motion = smooth_motion(DVec3::Y, |time| rate * time, place);
    // The slope at the middle key goes from the first key to the last.
    let velocity = DVec3::new(radius * rate.sin(), 0.0, 0.0);
    expect_velocities(
        &scene,
        |place| {
            let turned = rate * DVec3::Y.cross(point_at(place, depth));
            screen_motion(place, depth, -velocity - turned)
        },
        |at| {
            let before = DQuat::from_rotation_y(-rate).inverse();
            at - project(before * (point_at(at, depth) - place(-1.0)))
        },
    );
}

#[test]
fn a_zoom_scales_the_picture_by_the_focal_length() {
    for (interpolation, growth) in [(Interpolation::Linear, 0.0), (Interpolation::Cubic, 0.05)] {
        let mut scene = wall_scene(4.0, placed);
        let half_pi = std::f64::consts::FRAC_PI_2;
        let angle = |time: f64| half_pi - 0.1 * time + growth * time * time;
        scene.camera.motion.interpolation = interpolation;
        scene.camera.vertical_fov = [-1.0, 0.0, 1.0].map(|time| (time, angle(time))).to_vec();
        expect_velocities(
            &scene,
            // d/dt of 1 / tan(angle / 2) at 45 degrees, where the angle shrinks by 0.1 per frame.
            |place| place * 0.1,
            |place| place * (1.0 - 1.0 / (0.5 * angle(-1.0)).tan()),
        );
    }
}

#[test]
fn objects_carried_by_the_camera_stand_still() {
    let mut scene = wall_scene(4.0, placed);
    scene.camera.motion = spin(DVec3::new(1.0, 2.0, 3.0), DVec3::Y, 2.0);
    scene.objects[0].parent = Parent::Camera;
    // With velocity from only the camera, a dashboard counts as part of the world.
    expect_velocities(&scene, |_| DVec2::ZERO, |_| DVec2::ZERO);
}

#[test]
fn the_velocity_at_a_turning_point_is_that_before_it() {
    let depth = 4.0;
    let keys = [(-2.0, -1.0), (0.0, 0.0), (1.0, -3.0)];
    let scene = wall_scene(depth, |at| {
        through(keys.map(|(time, x)| key(time, at + x * DVec3::X)))
    });
    let before = DVec2::new(0.5 * FOCAL / depth, 0.0);
    expect_velocity(&scene, VelocityKind::Instantaneous, |_| before);
}

#[test]
fn points_behind_the_previous_camera_get_the_derivative() {
    let (depth, speed) = (1.0, 3.0);
    // The wall comes from behind, through the camera.
    let scene = wall_scene(depth, |at| drift(at, speed * DVec3::NEG_Z));
    let derivative = |place: DVec2| -place * speed / depth;
    expect_velocity(&scene, VelocityKind::PreviousFrame, derivative);
}

/// Samples the motion to the next frame, y up, and the change of depth, at the place of every
/// pixel.
fn trace_further(scene: &Scene, kind: VelocityKind) -> Vec<(DVec2, DVec2, f64)> {
    let settings = settings_with([WIDTH, HEIGHT], 1, kind);
    let grid = PixelGrid::of_picture(WIDTH, HEIGHT);
    let (next, z) = trace_further_velocities(scene, &settings, &grid).unwrap();
    let places = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| pixel_center(x, y)));
    (places.zip(next.pixels).zip(z.pixels))
        .map(|((place, next), z)| {
            let [right, down] = next.map(f64::from);
            (place, DVec2::new(right, -down), f64::from(z))
        })
        .collect()
}

#[track_caller]
fn expect_next(actual: DVec2, expected: DVec2) {
    assert!(
        actual.distance(expected) < TOLERANCE,
        "{actual}, {expected}"
    );
}

#[test]
fn further_velocities_are_differences_of_places_and_depths() {
    let (axis, rate) = (DVec3::new(0.6, 0.0, 0.8), 0.3);
    let centre = DVec3::new(0.3, -0.2, -6.0);
    let speed = DVec3::new(0.2, -0.1, 0.4);
    let mut scene = empty_scene("box");
    let (mesh, motion) = (cuboid(Vec3::new(30.0, 30.0, 2.0)), spin(centre, axis, rate));
    add(&mut scene, mesh, glowing(1.0), motion);
    scene.camera.motion = drift(DVec3::ZERO, speed);
    let seen = |point: DVec3, time: f64| {
        let turn = DQuat::from_axis_angle(axis, rate * time);
        centre + turn * (point - centre) - time * speed
    };
    for kind in [VelocityKind::Instantaneous, VelocityKind::PreviousFrame] {
        for (place, next, z) in trace_further(&scene, kind) {
            let point = point_at(place, 5.0);
            expect_next(next, project(seen(point, 1.0)) - place);
            let expected = match kind {
                VelocityKind::PreviousFrame => seen(point, -1.0).z - point.z,
                _ => -(rate * axis.cross(point - centre) - speed).z,
            };
            expect_near("velocity_z", z, expected, 1e-5);
        }
    }
}

#[test]
fn a_steady_motion_goes_on_to_the_next_frame_as_it_came() {
    let mut scene = wall_scene(7.0, |at| drift(at, DVec3::new(0.8, -0.5, 0.0)));
    scene.camera.motion = drift(DVec3::ZERO, DVec3::new(-0.3, 0.2, 0.0));
    for kind in VelocityKind::ALL {
        let velocity = render_frame(&scene, kind).velocity;
        let further = trace_further(&scene, kind);
        for ([right, down], (_, next, z)) in velocity.pixels.iter().zip(further) {
            assert!(*right > 0.4, "{kind}: {right}");
            expect_next(next, DVec2::new(f64::from(*right), -f64::from(*down)));
            assert!(z.abs() < 1e-6, "{kind}: {z}");
        }
    }
}

#[test]
fn the_background_and_what_passes_the_camera_have_further_velocities_too() {
    let (depth, speed, rate) = (1.0, 3.0, 0.2);
    let wall = wall_scene(depth, |at| drift(at, speed * DVec3::Z));
    for (place, next, z) in trace_further(&wall, VelocityKind::PreviousFrame) {
        expect_next(next, place * speed / depth);
        expect_near("velocity_z", z, -speed, 1e-6);
    }
    let mut sky = empty_scene("background");
    sky.camera.motion = spin(DVec3::ZERO, DVec3::Y, rate);
    for (place, next, z) in trace_further(&sky, VelocityKind::Instantaneous) {
        let later = DQuat::from_rotation_y(rate).inverse() * point_at(place, 1.0);
        expect_next(next, project(later) - place);
        assert_eq!(z, 0.0);
    }
}

#[test]
fn depth_is_the_distance_along_the_view_axis() {
    let mut scene = empty_scene("tilted");
    let tilt = DQuat::from_axis_angle(DVec3::new(0.0, 0.8, 0.6), 0.7);
    let centre = DVec3::new(2.0, 1.0, -9.0);
    scene.camera.motion = turned(
        DVec3::new(100.0, 3.0, -20.0),
        DQuat::from_axis_angle(DVec3::new(0.6, 0.8, 0.0), 2.1),
    );
    let panel = turned(centre, tilt);
    add(&mut scene, rectangle(12.0, 7.0), glowing(1.0), panel);
    scene.objects[0].parent = Parent::Camera;
    let frame = render_frame(&scene, VelocityKind::Instantaneous);
    let normal = tilt * DVec3::Z;
    let mut hits = 0;
    for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
        let direction = point_at(pixel_center(x, y), 1.0);
        let depth = centre.dot(normal) / direction.dot(normal);
        let inside = tilt.inverse() * (depth * direction - centre);
        let actual = *frame.depth.at(x, y);
        if inside.x.abs() < 6.0 && inside.y.abs() < 3.5 {
            hits += 1;
            expect_near("depth", f64::from(actual), depth, 1e-5 * depth);
        } else {
            assert_eq!(actual, FAR_DEPTH);
        }
    }
    assert!(hits > 50, "only {hits} pixels show the panel");
}
