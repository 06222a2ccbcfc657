//! Velocity of motions of any speed, against closed forms, and of points that stand still.

use frame::{Frame, VelocityKind};
use glam::{DQuat, DVec2, DVec3, Vec3};
use scene::{Parent, Scene, Shape};
use tracer::{PixelGrid, trace_further_velocities};

use crate::renders::{self, *};

const WIDTH: u32 = 33;
const HEIGHT: u32 = 21;
/// Focal length in pixels at a vertical field of view of 90 degrees.
const FOCAL: f64 = 0.5 * HEIGHT as f64;
/// Distance of the plane that every scene shows, in metres.
const DEPTH: f64 = 5.0;
/// Speeds in degrees, metres or radians per frame.
const SPEEDS: [f64; 5] = [20.0, 1e3, 1e6, 1e9, 1e12];
/// Tolerance, relative to the fastest pixel: 64-bit numbers hold an angle of 1e12 degrees to 4e-6
/// radians, and the difference quotient counts up to an error of 1e-5.
const TOLERANCE: f64 = 2e-5;

fn render_frame(scene: &Scene, velocity: VelocityKind) -> Frame {
    renders::render_frame(scene, &settings_with([WIDTH, HEIGHT], 1, velocity))
}

/// Compares every pixel's velocity with the exact one at its place, in pixels from the centre, +y
/// up.
fn expect_velocity(scene: &Scene, kind: VelocityKind, exact: impl Fn(DVec2) -> DVec2) {
    let frame = render_frame(scene, kind);
    let pixels = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y)));
    let both = pixels.map(|(x, y)| {
        let [right, down] = frame.velocity.at(x, y).map(f64::from);
        let right_of_centre = f64::from(x) + 0.5 - 0.5 * f64::from(WIDTH);
        let above_centre = 0.5 * f64::from(HEIGHT) - f64::from(y) - 0.5;
        let place = DVec2::new(right_of_centre, above_centre);
        (DVec2::new(right, -down), exact(place))
    });
    let both: Vec<(DVec2, DVec2)> = both.collect();
    let fastest = both.iter().map(|pair| pair.1.length()).fold(0.0, f64::max);
    for (velocity, expected) in both {
        assert!(
            velocity.distance(expected) <= TOLERANCE * fastest,
            "{kind}: {velocity}, not {expected} (y up)"
        );
    }
}

/// Returns the point of the plane that is seen at a place.
fn point_at(place: DVec2) -> DVec3 {
    (place * DEPTH / FOCAL).extend(-DEPTH)
}

/// Returns the velocity on screen of a point of the plane that moves relative to the camera.
fn screen_motion(place: DVec2, velocity: DVec3) -> DVec2 {
    (FOCAL * velocity.truncate() + place * velocity.z) / DEPTH
}

/// Makes a scene of a large box, whose front is the plane.
fn box_scene() -> Scene {
    let mut scene = empty_scene("box");
    let centre = placed(DVec3::new(0.3, -0.2, -DEPTH - 1.0));
    add(
        &mut scene,
        cuboid(Vec3::new(30.0, 30.0, 2.0)),
        glowing(1.0),
        centre,
    );
    scene
}

#[test]
fn a_spin_of_any_speed_has_the_velocity_of_its_angular_velocity() {
    let axis = DVec3::new(0.6, 0.0, 0.8);
    for rate in SPEEDS.map(f64::to_radians) {
        let mut scene = box_scene();
        let centre = scene.objects[0].motion.keys[0].translation;
        scene.objects[0].motion = spin(centre, axis, rate);
        expect_velocity(&scene, VelocityKind::Instantaneous, |place| {
            screen_motion(place, rate * axis.cross(point_at(place) - centre))
        });
        // The spinning parent of an object that stands beside its axis.
        let parent = add(
            &mut scene,
            rectangle(0.001, 0.001),
            glowing(1.0),
            spin(centre, axis, rate),
        );
        scene.objects.swap(0, parent);
        scene.objects[parent].motion = placed(DVec3::ZERO);
        scene.objects[parent].parent = Parent::Object(0);
        expect_velocity(&scene, VelocityKind::Instantaneous, |place| {
            screen_motion(place, rate * axis.cross(point_at(place) - centre))
        });
    }
}

#[test]
fn a_spin_of_any_speed_is_followed_to_the_frame_before() {
    for rate in SPEEDS.map(f64::to_radians) {
        let mut scene = box_scene();
        let centre = DVec3::new(0.0, 0.0, -DEPTH - 1.0);
        scene.objects[0].motion = spin(centre, DVec3::Z, rate);
        expect_velocity(&scene, VelocityKind::PreviousFrame, |place| {
            place - DVec2::from_angle(-rate).rotate(place)
        });
    }
}

#[test]
fn a_camera_that_turns_at_any_speed_has_the_velocity_of_its_angular_velocity() {
    for axis in [DVec3::Y, DVec3::Z, DVec3::new(0.6, 0.0, 0.8)] {
        for rate in SPEEDS.map(f64::to_radians) {
            for mut scene in [box_scene(), empty_scene("background")] {
                scene.camera.motion = spin(DVec3::ZERO, axis, rate);
                expect_velocity(&scene, VelocityKind::Instantaneous, |place| {
                    screen_motion(place, -rate * axis.cross(point_at(place)))
                });
            }
        }
    }
}

#[test]
fn what_comes_closer_at_any_speed_has_the_velocity_of_perspective() {
    for speed in SPEEDS {
        let velocity = speed * DVec3::new(0.8, -0.5, 1.3);
        let mut scene = box_scene();
        let centre = scene.objects[0].motion.keys[0].translation;
        scene.objects[0].motion = drift(centre, velocity);
        let exact = |place| screen_motion(place, velocity);
        expect_velocity(&scene, VelocityKind::Instantaneous, exact);
        // Shapes of its mesh that move likewise.
        let mut scene = box_scene();
        let at_rest = scene.meshes[0].positions.clone();
        let shape = |time: f32| Shape {
            time: f64::from(time),
            positions: (at_rest.iter())
                .map(|place| *place + time * velocity.as_vec3())
                .collect(),
            normals: Vec::new(),
        };
        scene.meshes[0].shapes = vec![shape(0.0), shape(1.0)];
        expect_velocity(&scene, VelocityKind::Instantaneous, exact);
    }
}

#[test]
fn a_zoom_of_any_speed_scales_the_picture() {
    let half_pi = std::f64::consts::FRAC_PI_2;
    // The field of view is below half a turn in the moment before.
    for speed in [20.0, 1e3, 3e4] {
        let mut scene = box_scene();
        scene.camera.vertical_fov = vec![(-1e-3 / speed, half_pi + 1e-3), (0.0, half_pi)];
        let exact = |place: DVec2| place * speed;
        expect_velocity(&scene, VelocityKind::Instantaneous, exact);
    }
}

#[test]
fn what_stands_still_under_a_still_camera_has_no_velocity_at_all() {
    let mut scene = empty_scene("still");
    let tilt = DQuat::from_axis_angle(DVec3::new(0.36, 0.48, 0.8), 0.7);
    scene.camera.motion = turned(DVec3::new(0.31, 1.73, 2.97), tilt);
    scene.camera.vertical_fov = vec![(0.0, 1.1)];
    // Everything below is placed relative to the camera's view.
    let ahead = |x: f64, y: f64| DVec3::new(0.31, 1.73, 2.97) + tilt * DVec3::new(x, y, -DEPTH);
    let wall = turned(ahead(-2.1, 0.3), DQuat::from_rotation_x(0.4) * tilt);
    add(&mut scene, rectangle(3.0, 7.0), glowing(1.0), wall);
    add(
        &mut scene,
        rectangle(0.3, 0.2),
        glowing(1.0),
        placed(DVec3::new(0.0, 0.1, 0.7)),
    );
    scene.objects[1].parent = Parent::Object(0);
    let spinning = spin(ahead(2.3, 0.1), tilt * DVec3::Z, 0.3);
    let mover = add(&mut scene, cuboid(Vec3::ONE), glowing(1.0), spinning) as u32 + 1;
    for kind in VelocityKind::ALL {
        let frame = render_frame(&scene, kind);
        let settings = settings_with([WIDTH, HEIGHT], 1, kind);
        let grid = PixelGrid::of_picture(WIDTH, HEIGHT);
        let (next, z) = trace_further_velocities(&scene, &settings, &grid).unwrap();
        let mut seen = [0; 4];
        for (pixel, id) in frame.object_id.pixels.iter().enumerate() {
            seen[*id as usize] += 1;
            let [x, y] = frame.velocity.pixels[pixel];
            let [next_x, next_y] = next.pixels[pixel];
            if *id != mover {
                // All numbers are 0, not -0, which has another direction.
                let bits = [x, y, next_x, next_y, z.pixels[pixel]].map(f32::to_bits);
                assert_eq!(bits, [0; 5], "{kind}: object {id} at pixel {pixel}");
            } else if kind != VelocityKind::CameraOnly {
                assert!(x.hypot(y) > 0.0 && next_x.hypot(next_y) > 0.0);
            }
        }
        assert!(seen.iter().all(|count| *count > 0), "{seen:?}");
    }
}
