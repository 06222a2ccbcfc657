//! Motions of objects and of the camera.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use scene::{Interpolation, load_scene};

use crate::Folder;

/// Loads the scene with other keys for its body.
fn load_with_keys(keys: &str) -> scene::Scene {
    let folder = Folder::new();
    let old = "    { time = -1 },\n    { time = 1, translation = [1, 0, 0] },\n";
    folder.edit("scene.toml", old, keys);
    folder.load().unwrap_or_else(|error| panic!("{error}"))
}

/// Returns the direction of the body's +X at a time.
fn body_x(scene: &scene::Scene, time: f64) -> DVec3 {
    scene.object_to_world(0, time).transform_vector3(DVec3::X)
}

#[test]
fn an_axis_and_degrees_turn_more_than_once() {
    let scene = load_with_keys(
        "{ time = 0, rotation = { axis = [0, 0, 2], degrees = 90 } },
         { time = 4, rotation = { axis = [0, 0, 1], degrees = 810 } },",
    );
    // Two turns in four frames: half a turn per frame, from +Y.
    let expected = [DVec3::Y, -DVec3::Y, DVec3::X, -DVec3::Y];
    for (time, expected) in [0.0, 1.0, 1.5, 5.0].into_iter().zip(expected) {
        // 1e-12: rounding of sines in 64 bits.
        assert!(body_x(&scene, time).distance(expected) < 1e-12, "at {time}");
    }
}

#[test]
fn quaternions_turn_steadily_the_shorter_way() {
    // Half of 120 degrees about (1, 1, 1), with the sign that leads a naive mean the long way
    // round.
    let scene = load_with_keys("{ time = 0 }, { time = 1, rotation = [-0.5, -0.5, -0.5, -0.5] },");
    let axis = DVec3::ONE.normalize();
    for time in [0.1, 0.25, 0.75, 1.0] {
        let expected = glam::DQuat::from_axis_angle(axis, time * TAU / 3.0) * DVec3::X;
        // 1e-12: rounding of sines in 64 bits.
        assert!(body_x(&scene, time).distance(expected) < 1e-12, "at {time}");
    }
}

#[test]
fn a_turn_just_below_half_is_accepted() {
    let scene = load_with_keys(
        "{ time = 0, rotation = [0, 0, 0, 1] },
         { time = 1, rotation = { axis = [0, 0, 1], degrees = 179.89 } },",
    );
    assert!(body_x(&scene, 0.5).y > 0.999);
}

#[test]
fn cubic_keys_are_joined_smoothly() {
    let folder = Folder::new();
    let old = "    { time = -1 },\n    { time = 1, translation = [1, 0, 0] },\n]\n";
    let text = "    { time = -1, translation = [1, 0, 0] },\n    { time = 0 },\n    { time = 1, translation = [1, 0, 0] },\n]\n";
    let text = format!("{text}interpolation = \"cubic\"\n[object.part]");
    folder.edit("scene.toml", &format!("{old}\n[object.part]"), &text);
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    // The parabola through the keys.
    assert_eq!(scene.object_to_world(0, 0.5).translation.x, 0.25);
    // A variant's keys do not change the interpolation.
    let fast = load_scene(&folder.path, Some("fast")).unwrap();
    assert_eq!(fast.objects[0].motion.interpolation, Interpolation::Cubic);
    // A variant's still pose removes both.
    let keys = "keys = [\n    { time = -1 },\n    { time = 1, translation = [2, 0, 0] },\n]";
    folder.edit("scene.toml", keys, "scale = 3");
    let fast = load_scene(&folder.path, Some("fast")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(fast.objects[0].motion.keys.len(), 1);
}

#[test]
fn a_camera_looks_at_its_point_with_up_as_close_as_possible() {
    let folder = Folder::new();
    let target = "look_at = [3, 4, 5]\nup = [1, 1, 7]";
    folder.edit("scene.toml", "look_at = [0, 0, 0]", target);
    let pose = folder.load().unwrap().camera.motion.at(0.0);
    // 1e-12: rounding of a quaternion in 64 bits.
    let forward = DVec3::new(3.0, 4.0, 0.0) / 5.0;
    assert!(pose.transform_vector3(-DVec3::Z).distance(forward) < 1e-12);
    let right = forward.cross(DVec3::new(1.0, 1.0, 7.0)).normalize();
    assert!(pose.transform_vector3(DVec3::X).distance(right) < 1e-12);
    assert_eq!(pose.translation, DVec3::new(0.0, 0.0, 5.0));
}

#[test]
fn a_field_of_view_changes_between_keys_of_the_camera() {
    let folder = Folder::new();
    let still = "position = [0, 0, 5]\nlook_at = [0, 0, 0]\nvertical_fov = 40\n";
    let moving = "keys = [
        { time = -1, position = [0, 0, 5], look_at = [0, 0, 0], vertical_fov = 90 },
        { time = 0, position = [0, 0, 4], look_at = [0, 0, 0] },
        { time = 1, position = [0, 0, 3], rotation = { axis = [0, 1, 0], degrees = 90 }, vertical_fov = 45 },
    ]\n";
    folder.edit("scene.toml", still, moving);
    let camera = folder.load().unwrap().camera;
    assert_eq!(camera.vertical_fov, [(-1.0, PI / 2.0), (1.0, PI / 4.0)]);
    let forward = camera.motion.at(1.0).transform_vector3(-DVec3::Z);
    assert!(forward.distance(-DVec3::X) < 1e-12); // Rounding in 64 bits.
}
