//! Slips in poses, keys and interpolations.

use super::{Slip, check_slips};

#[test]
fn slips_in_poses_are_refused() {
    check_slips("scene.toml", POSE_SLIPS);
}

#[test]
fn slips_in_interpolations_are_refused() {
    check_slips("scene.toml", INTERPOLATION_SLIPS);
}

#[test]
fn numbers_that_place_things_too_far_away_are_refused() {
    check_slips("scene.toml", FAR_SLIPS);
}

const KEYS: &str = "    { time = -1 },\n    { time = 1, translation = [1, 0, 0] },\n";

#[rustfmt::skip]
const POSE_SLIPS: &[Slip] = &[
    ("keys out of order", KEYS, "{ time = 1 },\n{ time = -1 },\n", 
        "scene.toml:22: object \"body\" has a key at time -1 after one at 1; times must rise"),
    ("equal times", KEYS, "{ time = 1 },\n{ time = 1 },\n", 
        "scene.toml:22: object \"body\" has a key at time 1 after one at 1; times must rise"),
    ("no keys", KEYS, "", 
        "scene.toml:20: object \"body\" has 0 keys; allowed: 1 to 16384"),
    ("still and moving", "scale = 2", "scale = 2\nkeys = [{ time = 0 }]", 
        "scene.toml:29: object \"part\" has both keys and a still pose; write translation, rotation and scale into the keys"),
    ("zero quaternion", "scale = 2", "rotation = [0, 0, 0, 0]", 
        "scene.toml:29: rotation is the quaternion [0.0, 0.0, 0.0, 0.0], which has no length; write [0, 0, 0, 1] for no rotation"),
    ("zero quaternion in a key", KEYS, "{ time = 0, rotation = [0, 0, 0, 0] },\n", 
        "scene.toml:21: rotation is the quaternion [0.0, 0.0, 0.0, 0.0], which has no length; write [0, 0, 0, 1] for no rotation"),
    ("three numbers for a rotation", "scale = 2", "rotation = [0, 0, 1]", 
        "scene.toml:29: invalid length 3; allowed: an array of length 4"),
    ("a number for a rotation", "scale = 2", "rotation = 90", 
        "scene.toml:29: invalid type: integer `90`; allowed: { axis = [x, y, z], degrees = number } or a quaternion [x, y, z, w]"),
    ("unknown key of a rotation", "scale = 2", "rotation = { axis = [0, 0, 1], radians = 1 }", 
        "scene.toml:29: unknown key `radians`; allowed: `axis` or `degrees`"),
    ("axis of nothing", "scale = 2", "rotation = { axis = [0, 0, 0], degrees = 1 }", 
        "scene.toml:29: rotation has the axis [0, 0, 0]; give it a direction"),
    ("half a turn without a way", KEYS, "{ time = -1, rotation = [0, 0, 0, 1] },\n{ time = 1, rotation = [0, 0, 1, 0] },\n", 
        "scene.toml:22: object \"body\" turns by half a turn or more between two keys, so that its direction is ambiguous; allowed: below 179.9 degrees, or any number of degrees if both keys have { axis, degrees } with the same axis"),
    ("half a turn between axes", KEYS, "{ time = -1, rotation = { axis = [0, 0, 1], degrees = 90 } },\n{ time = 1, rotation = { axis = [0, 0, -1], degrees = 90 } },\n", 
        "scene.toml:22: object \"body\" turns by half a turn or more between two keys, so that its direction is ambiguous; allowed: below 179.9 degrees, or any number of degrees if both keys have { axis, degrees } with the same axis"),
    ("zero scale", "scale = 2", "scale = 0", 
        "scene.toml:29: scale is [0.0, 0.0, 0.0]; allowed: factors other than 0"),
    ("zero scale along one axis", "scale = 2", "scale = [1, 0, 1]", 
        "scene.toml:29: scale is [1.0, 0.0, 1.0]; allowed: factors other than 0"),
    ("text for a scale", "scale = 2", "scale = \"big\"", 
        "scene.toml:29: invalid type: string \"big\"; allowed: a number or [x, y, z]"),
    ("scale through zero", KEYS, "{ time = -1, scale = 1 },\n{ time = 1, scale = [1, 1, -1] },\n", 
        "scene.toml:22: object \"body\" has scale [1.000, 1.000, 1.000] at time -1 and would have [1.000, 1.000, -1.000] at 1; each factor must keep its sign, between the keys and beyond them"),
    ("scale through zero beyond the keys", KEYS, "{ time = -1, scale = 1 },\n{ time = 0, scale = 0.4 },\n", 
        "scene.toml:22: object \"body\" has scale [1.000, 1.000, 1.000] at time -1 and would have [-0.200, -0.200, -0.200] at 1; each factor must keep its sign, between the keys and beyond them"),
];

#[rustfmt::skip]
const INTERPOLATION_SLIPS: &[Slip] = &[
    ("unknown interpolation", "[object.part]\n", "interpolation = \"smooth\"\n[object.part]\n", 
        "scene.toml:25: unknown word `smooth`; allowed: `linear` or `cubic`"),
    ("unknown interpolation of the camera", "position = [0, 0, 5]\nlook_at = [0, 0, 0]", "keys = [{ time = 0, position = [0, 0, 5], look_at = [0, 0, 0] }]\ninterpolation = \"Cubic\"", 
        "scene.toml:8: unknown word `Cubic`; allowed: `linear` or `cubic`"),
    ("interpolation of nothing", "scale = 2", "interpolation = \"cubic\"", 
        "scene.toml:29: object \"part\" has an interpolation but no keys; give it keys, or leave it out"),
    ("interpolation of a still camera", "vertical_fov = 40", "vertical_fov = 40\ninterpolation = \"cubic\"", 
        "scene.toml:10: the camera has an interpolation but no keys; give it keys, or leave it out"),
    ("scale through zero between keys", "keys = [\n    { time = -1 },\n    { time = 1, translation = [1, 0, 0] },\n", 
        "interpolation = \"cubic\"\nkeys = [\n{ time = -1, scale = 9 },\n{ time = 0, scale = 1 },\n{ time = 1, scale = 1 },\n{ time = 2, scale = 9 },\n", 
        "scene.toml:24: object \"body\" has scale [1.000, 1.000, 1.000] at time 0 and would have [0.000, 0.000, 0.000] at 0.5; each factor must keep its sign, between the keys and beyond them"),
];

#[rustfmt::skip]
const FAR_SLIPS: &[Slip] = &[
    ("far away", "translation = [1, 0, 0] },\n]\n\n[object.part]", "translation = [1e12, 0, 0] },\n]\n\n[object.part]", 
        "scene.toml:18: object \"body\" gets as far as 1.3e12 m from the origin while it is rendered; allowed: 1e12 m; reduce its translations and scales, and those of its parents"),
    ("carried away by its parent", "scale = 2", "scale = 1e12", 
        "scene.toml:25: object \"part\" gets as far as 1.4e12 m from the origin while it is rendered; allowed: 1e12 m; reduce its translations and scales, and those of its parents"),
    ("shrunk to nothing", "scale = 2", "scale = 1e-300", 
        "scene.toml:25: object \"part\" is scaled by 1.0e-300, parents included; allowed: 1e-12 or more; give it a larger scale"),
    ("camera far away", "position = [0, 0, 5]", "position = [1e12, 1e12, 5]", 
        "scene.toml:6: the camera gets as far as 1.4e12 m from the origin while it is rendered; allowed: 1e12 m; reduce its translations and scales, and those of its parents"),
    ("keys too close", KEYS, "{ time = 0 },\n{ time = 1e-300, translation = [1, 0, 0] },\n", 
        "scene.toml:22: object \"body\" has keys at times 0.0 and 1e-300; allowed: 1e-6 frames apart or more"),
    ("keys at one time", KEYS, "{ time = 0 },\n{ time = 0, translation = [1, 0, 0] },\n", 
        "scene.toml:22: object \"body\" has a key at time 0 after one at 0; times must rise"),
    ("key at an absurd time", KEYS, "{ time = 0 },\n{ time = 1e300, translation = [1, 0, 0] },\n", 
        "scene.toml:22: found 1e300; allowed: numbers from -1e12 to 1e12"),
];
