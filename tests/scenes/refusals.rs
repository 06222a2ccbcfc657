//! Every slip in a scene's files is refused with its place, what was found and what is allowed.

use crate::scene_folder::{self, Folder, SCENE};
use tracer::{SceneError, list_scenes, load_scene};

/// What is wrong, a piece of a file, what to write instead, and the message that must come: paths lie below the scene's
/// folder, `{gone}` is what the operating system says about a missing file.
type Slip = (&'static str, &'static str, &'static str, &'static str);

/// Spoils a fresh folder with each slip in turn.
fn check(file: &str, slips: &[Slip]) {
    for (what, from, to, message) in slips {
        let folder = Folder::new();
        folder.edit(file, from, to);
        let error = folder.load().err();
        let error = error.unwrap_or_else(|| panic!("{what}: it loads, but must be refused"));
        assert_eq!(
            below(&folder, &error),
            message.replace("{gone}", &gone()),
            "{what}"
        );
    }
}

/// A message with paths below the scene's folder.
fn below(folder: &Folder, error: &SceneError) -> String {
    let prefix = format!("{}{}", folder.path.display(), std::path::MAIN_SEPARATOR);
    error.to_string().replace(&prefix, "")
}

/// What the operating system says about a missing file.
fn gone() -> String {
    std::fs::read("no such file").unwrap_err().to_string()
}

#[test]
fn slips_in_scene_toml_are_refused() {
    check("scene.toml", SCENE_SLIPS);
}

#[test]
fn slips_in_poses_are_refused() {
    check("scene.toml", POSE_SLIPS);
}

#[test]
fn slips_in_the_ways_between_keys_are_refused() {
    check("scene.toml", INTERPOLATION_SLIPS);
}

#[test]
fn slips_in_shutters_are_refused() {
    check("scene.toml", SHUTTER_SLIPS);
}

#[test]
fn slips_in_key_shapes_are_refused() {
    for (what, from, to, message) in SHAPE_SLIPS {
        let folder = Folder::new();
        let shapes =
            "shapes = [\n{ time = 0, mesh = \"mesh.obj\" },\n{ time = 1, mesh = \"bent.obj\" },\n]";
        folder.edit(
            "scene.toml",
            "mesh = \"mesh.obj\"\nkeys",
            &format!("{shapes}\nkeys"),
        );
        folder.write("bent.obj", scene_folder::OBJ);
        let file = if SCENE.contains(from) || shapes.contains(from) {
            "scene.toml"
        } else {
            "bent.obj"
        };
        folder.edit(file, from, to);
        let error = folder.load().err();
        let error = error.unwrap_or_else(|| panic!("{what}: it loads, but must be refused"));
        let expected = message.replace("{gone}", &gone());
        assert_eq!(below(&folder, &error), expected, "{what}");
    }
}

#[test]
fn slips_in_meshes_are_refused() {
    check("mesh.obj", OBJ_SLIPS);
}

#[test]
fn slips_in_materials_are_refused() {
    check("mesh.mtl", MTL_SLIPS);
}

#[test]
fn a_folder_without_a_scene_is_refused() {
    let folder = Folder::new();
    std::fs::remove_file(folder.path.join("scene.toml")).unwrap();
    let error = folder.load().unwrap_err();
    let expected = format!(
        "scene.toml: cannot be read: {}; a scene is a folder with a scene.toml",
        gone()
    );
    assert_eq!(below(&folder, &error), expected);
}

#[test]
fn a_folder_without_scenes_is_refused() {
    let folder = Folder::new();
    let error = list_scenes(&folder.path).unwrap_err();
    assert_eq!(error.path, folder.path);
    assert_eq!(
        error.reason,
        "holds no scene; a scene is a folder with a scene.toml"
    );
}

#[test]
fn a_scene_without_objects_is_refused() {
    let folder = Folder::new();
    let head = SCENE.split("[object.body]").next().unwrap();
    folder.write("scene.toml", head);
    let error = folder.load().unwrap_err();
    let expected = "scene.toml: no objects; a scene needs at least one [object.name] with a mesh";
    assert_eq!(below(&folder, &error), expected);
}

#[test]
fn an_unknown_variant_is_refused() {
    let folder = Folder::new();
    let error = load_scene(&folder.path, Some("slow")).unwrap_err();
    let expected = "scene.toml: variant \"slow\" is unknown; variants: fast";
    assert_eq!(below(&folder, &error), expected);
}

#[test]
fn an_empty_mesh_is_refused() {
    let folder = Folder::new();
    // Lines and points are no surface.
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\np 1\n");
    folder.edit("scene.toml", "group = \"left\"\n", "");
    let error = folder.load().unwrap_err();
    let expected = "mesh.obj: holds no faces; a mesh needs at least one f statement with 3 corners";
    assert_eq!(below(&folder, &error), expected);
}

#[test]
fn a_mesh_without_area_is_refused() {
    let folder = Folder::new();
    folder.write(
        "mesh.obj",
        "v 0 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 2 3 4\n",
    );
    let error = folder.load().unwrap_err();
    let expected = "mesh.obj: all 2 triangles have no area; a mesh needs at least one with area";
    assert_eq!(below(&folder, &error), expected);
}

#[test]
fn text_that_is_none_is_refused() {
    let folder = Folder::new();
    folder.write("mesh.obj", b"# caf\xe9\n");
    let error = folder.load().unwrap_err();
    let expected = "scene.toml:19: mesh mesh.obj cannot be read: it is not UTF-8 text";
    assert_eq!(below(&folder, &error), expected);
}

const KEYS: &str = "    { time = -1 },\n    { time = 1, translation = [1, 0, 0] },\n";

#[rustfmt::skip]
const SCENE_SLIPS: &[Slip] = &[
    ("not TOML", "exposure = 0.5", "exposure 0.5", 
        "scene.toml:3: key with no value; allowed: `=`"),
    ("unknown key", "exposure = 0.5", "exposure = 0.5\nshuter = 1", 
        "scene.toml:4: unknown key `shuter`; allowed: `exposes`, `family`, `exposure`, `size`, `shutter`, `display`, `camera`, `background`, `sun`, `object`, `variant`"),
    ("unknown key of the camera", "vertical_fov = 40", "vertical_fov = 40\nscale = 2", 
        "scene.toml:10: unknown key `scale`; allowed: `position`, `look_at`, `up`, `rotation`, `vertical_fov`, `keys`, `interpolation`"),
    ("unknown key of an object", "parent = \"body\"", "father = \"body\"", 
        "scene.toml:28: unknown key `father`; allowed: `mesh`, `shapes`, `group`, `parent`, `translation`, `rotation`, `scale`, `keys`, `interpolation`, `material`"),
    ("unknown key in a variant", "{ time = 1, translation = [2, 0, 0] }", "{ time = 1, move = [2, 0, 0] }", 
        "scene.toml:37: unknown key `move`; allowed: `time`, `translation`, `rotation`, `scale`"),
    ("unknown table in a variant", "[variant.fast.object.body]", "[variant.fast.objects.body]", 
        "scene.toml:34: variant \"fast\" changes \"objects\"; a variant may change: background, camera, exposure, object, shutter, sun"),
    ("unknown object in a variant", "[variant.fast.object.body]", "[variant.fast.object.boddy]", 
        "scene.toml:34: variant \"fast\" changes object \"boddy\", which the scene does not have; objects: body, part"),
    ("variant with a slash", "[variant.fast.object.body]", "[variant.\"../fast\".object.body]",
        "scene.toml:34: variant name \"../fast\"; allowed: letters, digits, _ and -"),
    ("missing key", "family = \"translation\"\n", "", 
        "scene.toml:1: missing key `family`"),
    ("missing key of the camera", "vertical_fov = 40\n", "", 
        "scene.toml:6: the camera has no vertical_fov; give it in degrees, once or in the keys"),
    ("wrong type", "exposure = 0.5", "exposure = \"half\"", 
        "scene.toml:3: invalid type: string \"half\"; allowed: a number"),
    ("too few numbers", "position = [0, 0, 5]", "position = [0, 5]", 
        "scene.toml:7: invalid length 2; allowed: an array of length 3"),
    ("bad family", "family = \"translation\"", "family = \"spin\"", 
        "scene.toml:2: unknown family `spin`; allowed: `translation`, `rotation`, `camera`, `thin`, `overlap`, `deforming`, `limits`"),
    ("empty sentence", "exposes = \"A square that slides.\"", "exposes = \" \"", 
        "scene.toml:1: exposes is empty; say in one sentence what the scene exposes"),
    ("NaN", "constant = [0, 0, 0]", "constant = [0, nan, 0]", 
        "scene.toml:12: found nan; allowed: finite numbers"),
    ("infinity", "position = [0, 0, 5]", "position = [0, 0, inf]", 
        "scene.toml:7: found inf; allowed: finite numbers"),
    ("too large for a number", "position = [0, 0, 5]", "position = [0, 0, 1e999]", 
        "scene.toml:7: found 1e999; allowed: finite numbers"),
    ("too large for a 32-bit number", "constant = [0, 0, 0]", "constant = [0, 1e99, 0]", 
        "scene.toml:12: found 1e99; allowed: numbers from -1e12 to 1e12"),
    ("no exposure", "exposure = 0.5", "exposure = 0", 
        "scene.toml:3: exposure is 0 frames; allowed: above 0 and finite (0.5 frames = 180 degrees)"),
    ("negative exposure", "exposure = 0.5", "exposure = -0.5", 
        "scene.toml:3: exposure is -0.5 frames; allowed: above 0 and finite (0.5 frames = 180 degrees)"),
    ("NaN exposure", "exposure = 0.5", "exposure = nan", 
        "scene.toml:3: found nan; allowed: finite numbers"),
    ("no size", "size = [64, 36]", "size = [0, 36]", 
        "scene.toml:4: size is [0, 36]; allowed: 1 to 16384 pixels each"),
    ("negative size", "size = [64, 36]", "size = [64, -36]", 
        "scene.toml:4: invalid value: integer `-36`; allowed: a whole number from 0"),
    ("absurd size", "size = [64, 36]", "size = [64, 16385]", 
        "scene.toml:4: size is [64, 16385]; allowed: 1 to 16384 pixels each"),
    ("too large an exposure", "exposure = 0.5", "exposure = 1e50", 
        "scene.toml:3: found 1e50; allowed: numbers from -1e12 to 1e12"),
    ("long exposure", "exposure = 0.5", "exposure = 10001", 
        "scene.toml:3: exposure is 1.0001e4 frames; allowed: 1e-9 to 10000 (0.5 frames = 180 degrees)"),
    ("exposure without length", "exposure = 0.5", "exposure = 1e-300", 
        "scene.toml:3: exposure is 1e-300 frames; allowed: 1e-9 to 10000 (0.5 frames = 180 degrees)"),
    ("too many pixels", "size = [64, 36]", "size = [16384, 16384]", 
        "scene.toml:4: size is [16384, 16384], 268435456 pixels; allowed: 67108864; give a smaller size"),
    ("integer beyond all", "position = [0, 0, 5]", "position = [0, 0, 999999999999999999999999999999999999999999]", 
        "scene.toml:7: found 999999999999999999999999999999999999999999; allowed: numbers from -1e12 to 1e12"),
    ("many stops", "[camera]", "[display]\nstops = 150\n[camera]", 
        "scene.toml:7: stops = 150; allowed: stops from -32 to 32"),
    ("wide flip range", "[camera]", "[display]\nflip = { start = -1, stop = 3e9, count = 5 }\n[camera]", 
        "scene.toml:7: flip stop = 3000000000; allowed: stops from -32 to 32"),
    ("many flip exposures", "[camera]", "[display]\nflip = { start = -1, stop = 1, count = 400 }\n[camera]", 
        "scene.toml:7: flip has 400 exposures; allowed: 2 to 128"),
    ("sun of no size", "irradiance = [1, 1, 1]", "irradiance = [1, 1, 1]\nangular_radius = 1e-20", 
        "scene.toml:17: the sun's angular_radius is 1e-20 degrees; allowed: 0 (a point) and 0.001 to below 90"),
    ("sun too bright for its size", "irradiance = [1, 1, 1]", "irradiance = [1e6, 1, 1]\nangular_radius = 0.001", 
        "scene.toml:16: irradiance gives the sun's disc of 0.001 degrees a radiance of 1.04e15; allowed: 1e12; lower it, or give a larger angular_radius"),
    ("narrow view", "vertical_fov = 40", "vertical_fov = 1e-300", 
        "scene.toml:9: vertical_fov is 1e-300 degrees; allowed: 0.001 to below 180"),
    ("line break in the sentence", "exposes = \"A square that slides.\"", "exposes = \"A square.\\n::error::it slides\"", 
        "scene.toml:1: the text holds the control character U+000A; allowed: one line of visible characters"),
    ("escape in a material", "[object.part.material.paint]", "[object.part.material.\"pa\\u001bint\"]", 
        "scene.toml:31: the text holds the control character U+001B; allowed: one line of visible characters"),
    ("text that turns round", "mesh = \"mesh.obj\"\ngroup", "mesh = \"\\u202ejbo.hsem\"\ngroup", 
        "scene.toml:26: the text holds the control character U+202E; allowed: one line of visible characters"),
    ("one flip exposure", "[camera]", "[display]\nflip = { start = -1, stop = 1, count = 1 }\n[camera]", 
        "scene.toml:7: flip has 1 exposures; allowed: 2 to 128"),
    ("flip range reversed", "[camera]", "[display]\nflip = { start = 1, stop = -1, count = 5 }\n[camera]", 
        "scene.toml:7: flip starts at 1 and stops at -1; stop must be above start"),
    ("camera looks at itself", "look_at = [0, 0, 0]", "look_at = [0, 0, 5]", 
        "scene.toml:8: the camera is at [0.0, 0.0, 5.0] and looks at the same point; give another look_at"),
    ("camera's up along its view", "look_at = [0, 0, 0]", "look_at = [0, 0, 0]\nup = [0, 0, -2]", 
        "scene.toml:9: the camera's up [0.0, 0.0, -2.0] is zero or parallel to its view; give an up across the view"),
    ("camera's default up along its view", "look_at = [0, 0, 0]", "look_at = [0, -3, 5]", 
        "scene.toml:8: the camera's up [0.0, 1.0, 0.0] is zero or parallel to its view; give an up across the view"),
    ("camera's up is nothing", "look_at = [0, 0, 0]", "look_at = [0, 0, 0]\nup = [0, 0, 0]", 
        "scene.toml:9: the camera's up [0.0, 0.0, 0.0] is zero or parallel to its view; give an up across the view"),
    ("camera looks nowhere", "look_at = [0, 0, 0]\n", "", 
        "scene.toml:6: a camera needs either look_at, with up or without, or rotation"),
    ("camera looks twice", "look_at = [0, 0, 0]", "look_at = [0, 0, 0]\nrotation = [0, 0, 0, 1]", 
        "scene.toml:6: a camera needs either look_at, with up or without, or rotation"),
    ("camera stands nowhere", "position = [0, 0, 5]\n", "", 
        "scene.toml:6: a camera needs either a position with look_at or rotation, or keys that hold these"),
    ("camera still and moving", "vertical_fov = 40", "vertical_fov = 40\nkeys = [{ time = 0, position = [0, 0, 0], rotation = [0, 0, 0, 1] }]", 
        "scene.toml:6: a camera needs either a position with look_at or rotation, or keys that hold these"),
    ("field of view of nothing", "vertical_fov = 40", "vertical_fov = 0", 
        "scene.toml:9: vertical_fov is 0.0 degrees; allowed: 0.001 to below 180"),
    ("field of view of a half-space", "vertical_fov = 40", "vertical_fov = 180", 
        "scene.toml:9: vertical_fov is 180.0 degrees; allowed: 0.001 to below 180"),
    ("no background", "constant = [0, 0, 0]\n", "", 
        "scene.toml:11: a background needs one of: constant = [r, g, b], gradient = { ground, horizon, zenith }, image = \"sky.exr\""),
    ("two backgrounds", "constant = [0, 0, 0]", "constant = [0, 0, 0]\ngradient = { ground = [0, 0, 0], horizon = [0, 0, 0], zenith = [0, 0, 0] }", 
        "scene.toml:11: a background needs one of: constant = [r, g, b], gradient = { ground, horizon, zenith }, image = \"sky.exr\""),
    ("dark light", "constant = [0, 0, 0]", "gradient = { ground = [0, 0, 0], horizon = [0, 0, 0], zenith = [0, -1, 0] }", 
        "scene.toml:12: zenith is [0.0, -1.0, 0.0]; allowed: 0 to 1e12"),
    ("sun nowhere", "direction = [0, 1, 0]", "direction = [0, 0, 0]", 
        "scene.toml:15: the sun's direction is [0, 0, 0]; give a direction towards the sun"),
    ("dark sun", "irradiance = [1, 1, 1]", "irradiance = [1, 1, -1]", 
        "scene.toml:16: irradiance is [1.0, 1.0, -1.0]; allowed: 0 to 1e12"),
    ("sun around us", "irradiance = [1, 1, 1]", "irradiance = [1, 1, 1]\nangular_radius = 90", 
        "scene.toml:17: the sun's angular_radius is 90.0 degrees; allowed: 0 (a point) and 0.001 to below 90"),
    ("albedo above 1", "diffuse = [0.1, 0.2, 0.3]", "diffuse = [0.1, 1.2, 0.3]", 
        "scene.toml:32: diffuse is [0.1, 1.2, 0.3]; allowed: 0 to 1"),
    ("negative emission", "diffuse = [0.1, 0.2, 0.3]", "emission = [0, 0, -1]", 
        "scene.toml:32: emission is [0.0, 0.0, -1.0]; allowed: 0 to 1e12"),
    ("opacity above 1", "diffuse = [0.1, 0.2, 0.3]", "opacity = 1.5", 
        "scene.toml:32: opacity is 1.5; allowed: 0 to 1"),
    ("texture missing", "diffuse = [0.1, 0.2, 0.3]", "emission_texture = \"gone.png\"", 
        "scene.toml:32: texture gone.png cannot be read: {gone}"),
    ("texture that is none", "diffuse = [0.1, 0.2, 0.3]", "opacity_texture = \"mesh.mtl\"", 
        "scene.toml:32: texture mesh.mtl is neither a PNG nor a JPEG file"),
    ("name with a blank", "[object.part]", "[object.\"a part\"]\nmesh = \"mesh.obj\"\n[object.part]", 
        "scene.toml:25: object name \"a part\"; allowed: letters, digits, _ and -"),
    ("name taken", "[object.part]", "[object.background]\nmesh = \"mesh.obj\"\n[object.part]", 
        "scene.toml:25: object name \"background\" is reserved; choose another name"),
    ("name given twice", "[object.part]", "[object.body]\nmesh = \"mesh.obj\"\n[object.part]", 
        "scene.toml:25: duplicate key"),
    ("mesh missing", "mesh = \"mesh.obj\"\ngroup", "mesh = \"gone.obj\"\ngroup", 
        "scene.toml:26: mesh gone.obj cannot be read: {gone}"),
    ("unknown group", "group = \"left\"", "group = \"middle\"", 
        "scene.toml:27: group \"middle\" is not in mesh.obj; groups: right, left"),
    ("unknown material", "[object.part.material.paint]", "[object.part.material.pain]", 
        "scene.toml:31: material \"pain\" is not in mesh.obj; materials: glow, paint"),
    ("unknown parent", "parent = \"body\"", "parent = \"nobody\"", 
        "scene.toml:28: object \"part\" has the parent \"nobody\", which the scene does not have; allowed: camera, body"),
    ("parent of itself", "parent = \"body\"", "parent = \"part\"", 
        "scene.toml:28: the parents of objects form a cycle: part -> part; give one of them another parent or none"),
    ("parents in a ring", "[object.body]\n", "[object.body]\nparent = \"part\"\n", 
        "scene.toml:19: the parents of objects form a cycle: body -> part -> body; give one of them another parent or none"),
    ("parent below its child", "[object.body]", "[object.first]\nmesh = \"mesh.obj\"\nparent = \"part\"\n[object.body]", 
        "scene.toml:20: object \"first\" stands before its parent \"part\"; move the parent above it"),
];

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

#[test]
fn numbers_that_carry_things_too_far_are_refused() {
    check("scene.toml", FAR_SLIPS);
}

#[rustfmt::skip]
const SHAPE_SLIPS: &[Slip] = &[
    ("one shape", "{ time = 1, mesh = \"bent.obj\" },\n", "", 
        "scene.toml:19: object \"body\" has 1 shapes; allowed: 2 to 16384, or a mesh in their place"),
    ("shapes out of order", "{ time = 1, mesh", "{ time = -1, mesh", 
        "scene.toml:21: object \"body\" has a shape at time -1 after one at 0; times must rise"),
    ("shapes at one time", "{ time = 1, mesh", "{ time = 0, mesh", 
        "scene.toml:21: object \"body\" has a shape at time 0 after one at 0; times must rise"),
    ("mesh and shapes", "shapes = [", "mesh = \"mesh.obj\"\nshapes = [", 
        "scene.toml:20: object \"body\" has both a mesh and shapes; give one or the other"),
    ("neither mesh nor shapes", "mesh = \"mesh.obj\"\ngroup = \"left\"\n", "", 
        "scene.toml:28: object \"part\" has no mesh; give it a mesh, or shapes if it deforms"),
    ("missing shape", "mesh = \"bent.obj\"", "mesh = \"gone.obj\"", 
        "scene.toml:21: mesh gone.obj cannot be read: {gone}"),
    ("fewer faces", "f 1/1/1 3/3/1 4/2/1\n", "", 
        "bent.obj: has 3 faces, mesh.obj has 4; key shapes must have the same faces in the same order"),
    ("another vertex", "f 1/1/1 3/3/1 4/2/1", "f 1/1/1 3/3/1 -1/2/1", 
        "bent.obj:15: the face has the vertices [1, 3, 6], in mesh.obj:15 it has [1, 3, 4]; key shapes must have the same faces in the same order"),
    ("another order", "f 1/1/1 3/3/1 4/2/1", "f 3/3/1 4/2/1 1/1/1", 
        "bent.obj:15: the face has the vertices [3, 4, 1], in mesh.obj:15 it has [1, 3, 4]; key shapes must have the same faces in the same order"),
    ("another material", "g left\nusemtl glow", "g left\nusemtl paint", 
        "bent.obj: has 3 triangles of group \"left\" with normals in material \"paint\" where mesh.obj has 2 triangles of group \"left\" with normals in material \"glow\"; key shapes must have the same groups, materials and kinds of faces"),
    ("another group", "g left", "g top", 
        "bent.obj: has 2 triangles of group \"top\" with normals in material \"glow\" where mesh.obj has 2 triangles of group \"left\" with normals in material \"glow\"; key shapes must have the same groups, materials and kinds of faces"),
    ("normals in one shape alone", "usemtl paint\nf 1/1/1 4/2/1 6/3/1", "usemtl paint\nf 1/1 4/2 6/3", 
        "bent.obj: has 1 triangles of group \"left\" without normals in material \"paint\" where mesh.obj has 1 triangles of group \"left\" with normals in material \"paint\"; key shapes must have the same groups, materials and kinds of faces"),
];

#[rustfmt::skip]
const SHUTTER_SLIPS: &[Slip] = &[
    ("ramps too long", "[camera]", "[shutter]\nrise = 0.75\nfall = 0.5\n[camera]", 
        "scene.toml:6: shutter rises during 0.75 and falls during 0.5 of the exposure; allowed: 0 and above, together at most 1"),
    ("negative ramp", "[camera]", "[shutter]\nfall = -0.5\n[camera]", 
        "scene.toml:6: shutter rises during 0 and falls during -0.5 of the exposure; allowed: 0 and above, together at most 1"),
    ("two kinds of shutter", "[camera]", "[shutter]\nfall = 0.5\nefficiency = [1, 1]\n[camera]", 
        "scene.toml:6: the shutter has both an efficiency and a rise or fall; give one or the other"),
    ("empty table", "[camera]", "[shutter]\nefficiency = []\n[camera]", 
        "scene.toml:6: efficiency holds 0 values; allowed: 2 and more, at equal steps from the opening to the closing"),
    ("negative efficiency", "[camera]", "[shutter]\nefficiency = [1, -1]\n[camera]", 
        "scene.toml:6: efficiency holds -1; allowed: 0 to 1"),
    ("dark shutter", "[camera]", "[shutter]\nefficiency = [0, 0, 0]\n[camera]", 
        "scene.toml:6: efficiency is 0 throughout, and no light passes; at least one value must be above 0"),
    ("endless rolling", "[camera]", "[shutter]\nrolling = inf\n[camera]", 
        "scene.toml:7: found inf; allowed: finite numbers"),
    ("unknown key of the shutter", "[camera]", "[shutter]\nopen = 0\n[camera]", 
        "scene.toml:7: unknown key `open`; allowed: `rise`, `fall`, `efficiency`, `rolling`"),
];

#[rustfmt::skip]
const INTERPOLATION_SLIPS: &[Slip] = &[
    ("unknown interpolation", "[object.part]\n", "interpolation = \"smooth\"\n[object.part]\n", 
        "scene.toml:25: interpolation of object \"body\" is \"smooth\"; allowed: linear, cubic"),
    ("unknown interpolation of the camera", "position = [0, 0, 5]\nlook_at = [0, 0, 0]", "keys = [{ time = 0, position = [0, 0, 5], look_at = [0, 0, 0] }]\ninterpolation = \"Cubic\"", 
        "scene.toml:8: interpolation of the camera is \"Cubic\"; allowed: linear, cubic"),
    ("interpolation of nothing", "scale = 2", "interpolation = \"cubic\"", 
        "scene.toml:29: object \"part\" has an interpolation but no keys; give it keys, or leave it out"),
    ("interpolation of a still camera", "vertical_fov = 40", "vertical_fov = 40\ninterpolation = \"cubic\"", 
        "scene.toml:10: the camera has an interpolation but no keys; give it keys, or leave it out"),
    ("scale through zero between keys", "keys = [\n    { time = -1 },\n    { time = 1, translation = [1, 0, 0] },\n", 
        "interpolation = \"cubic\"\nkeys = [\n{ time = -1, scale = 9 },\n{ time = 0, scale = 1 },\n{ time = 1, scale = 1 },\n{ time = 2, scale = 9 },\n", 
        "scene.toml:24: object \"body\" has scale [1.000, 1.000, 1.000] at time 0 and would have [0.000, 0.000, 0.000] at 0.5; each factor must keep its sign, between the keys and beyond them"),
];

#[rustfmt::skip]
const OBJ_SLIPS: &[Slip] = &[
    ("NaN vertex", "v 1 1 0", "v 1 nan 0", 
        "mesh.obj:4: v holds \"nan\"; allowed: finite numbers"),
    ("infinite vertex", "v 1 1 0", "v 1 inf 0", 
        "mesh.obj:4: v holds \"inf\"; allowed: finite numbers"),
    ("vertex too large", "v 1 1 0", "v 1 1e39 0", 
        "mesh.obj:4: v holds \"1e39\"; allowed: numbers from -1e12 to 1e12"),
    ("vertex too far", "v 1 1 0", "v 1 1e30 0", 
        "mesh.obj:4: v holds \"1e30\"; allowed: numbers from -1e12 to 1e12"),
    ("vertex thrown far by its weight", "v 1 1 0", "v 1 1 0 1e-38", 
        "mesh.obj:4: v has the weight 1e-38, which puts it beyond 1e12; leave the weight out"),
    ("index beyond 64 bits", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 99999999999999999999/3/1", 
        "mesh.obj:14: f has the vertex index \"99999999999999999999\"; allowed: whole numbers"),
    ("huge index", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 1000000000/3/1", 
        "mesh.obj:14: f has the vertex index 1000000000; allowed: 1 to 6, or -6 to -1"),
    ("smallest index", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 -9223372036854775808/3/1", 
        "mesh.obj:14: f has the vertex index -9223372036854775808; allowed: 1 to 6, or -6 to -1"),
    ("escape in a group", "g left", "g le\u{1b}[31mft", 
        "mesh.obj:16: the name after g holds the control character U+001B; allowed: one line of visible characters"),
    ("carriage return in a name", "usemtl glow", "usemtl gl\row", 
        "mesh.obj:17: the name after usemtl holds the control character U+000D; allowed: one line of visible characters"),
    ("vertex with a word", "v 1 1 0", "v 1 one 0", 
        "mesh.obj:4: v holds \"one\"; allowed: finite numbers"),
    ("vertex cut short", "v 1 1 0", "v 1 1", 
        "mesh.obj:4: v holds 2 numbers; allowed: 3 or 4 or 6"),
    ("vertex of five", "v 1 1 0", "v 1 1 0 1 1", 
        "mesh.obj:4: v holds 5 numbers; allowed: 3 or 4 or 6"),
    ("vertex of no weight", "v 1 1 0", "v 1 1 0 0", 
        "mesh.obj:4: v has the weight 0, which puts it at infinity; leave the weight out"),
    ("NaN texture coordinate", "vt 1 1", "vt NaN 1", 
        "mesh.obj:10: vt holds \"NaN\"; allowed: finite numbers"),
    ("NaN normal", "vn 0 0 2", "vn 0 nan 2", 
        "mesh.obj:11: vn holds \"nan\"; allowed: finite numbers"),
    ("normal of no length", "vn 0 0 2", "vn 0 0 0", 
        "mesh.obj:11: vn has no length; give it a direction"),
    ("index beyond the last", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 7/3/1", 
        "mesh.obj:14: f has the vertex index 7; allowed: 1 to 6, or -6 to -1"),
    ("index before the first", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 -7/3/1", 
        "mesh.obj:14: f has the vertex index -7; allowed: 1 to 6, or -6 to -1"),
    ("index 0", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 0/3/1", 
        "mesh.obj:14: f has the vertex index 0; allowed: 1 to 6, or -6 to -1"),
    ("texture index beyond the last", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 3/4/1", 
        "mesh.obj:14: f has the texture coordinate index 4; allowed: 1 to 3, or -3 to -1"),
    ("texture index before the first", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 3/-4/1", 
        "mesh.obj:14: f has the texture coordinate index -4; allowed: 1 to 3, or -3 to -1"),
    ("texture index 0", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 3/0/1", 
        "mesh.obj:14: f has the texture coordinate index 0; allowed: 1 to 3, or -3 to -1"),
    ("normal index without normals", "vn 0 0 2\n", "", 
        "mesh.obj:13: f has the normal index 1, but no normal stands above it"),
    ("index with a word", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 c/3/1", 
        "mesh.obj:14: f has the vertex index \"c\"; allowed: whole numbers"),
    ("corner without a vertex", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 /3/1", 
        "mesh.obj:14: f has the corner \"/3/1\"; allowed: v, v/vt, v//vn or v/vt/vn"),
    ("corner of four", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1 3/3/1/1", 
        "mesh.obj:14: f has the corner \"3/3/1/1\"; allowed: v, v/vt, v//vn or v/vt/vn"),
    ("two corners", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2/2/1", 
        "mesh.obj:14: f has 2 corners; allowed: 3 or more"),
    ("mixed corners", "f 1/1/1 2/2/1 3/3/1", "f 1/1/1 2//1 3/3/1", 
        "mesh.obj:14: f has corners with different kinds of indices: \"1/1/1 2//1 3/3/1\"; write all as v, v/vt, v//vn or v/vt/vn"),
    ("mixed faces", "f 1/1/1 2/2/1 3/3/1", "f 1 2 3", 
        "mesh.obj:15: the face has other kinds of indices than the faces before it; give texture coordinates and normals to all faces of a group and material, or to none"),
    ("texture without coordinates", "usemtl paint\nf 1/1/1 4/2/1 6/3/1\n", "usemtl paint\nf 1 4 6\n", 
        "scene.toml:19: material \"paint\" has a texture, but some faces of mesh.obj that use it have no texture coordinates (vt); add them, or take the texture away"),
    ("unknown material", "usemtl glow", "usemtl glowing", 
        "mesh.obj:17: usemtl names material \"glowing\", which no mtllib above it defines; materials: glow, paint"),
    ("material library missing", "mtllib mesh.mtl", "mtllib gone.mtl", 
        "mesh.obj:1: material library gone.mtl cannot be read: {gone}"),
    ("no material library", "mtllib mesh.mtl\n", "", 
        "mesh.obj:12: usemtl names material \"paint\", which no mtllib above it defines; materials: none"),
];

#[rustfmt::skip]
const MTL_SLIPS: &[Slip] = &[
    ("albedo above 1", "Kd 0.5 0.6 0.7", "Kd 0.5 1.6 0.7", 
        "mesh.mtl:2: Kd is [0.5, 1.6, 0.7]; allowed: 0 to 1"),
    ("negative albedo", "Kd 0.5 0.6 0.7", "Kd -0.5 0.6 0.7", 
        "mesh.mtl:2: Kd is [-0.5, 0.6, 0.7]; allowed: 0 to 1"),
    ("albedo of one number", "Kd 0.5 0.6 0.7", "Kd 0.5", 
        "mesh.mtl:2: Kd holds 1 numbers; allowed: 3"),
    ("NaN albedo", "Kd 0.5 0.6 0.7", "Kd 0.5 nan 0.7", 
        "mesh.mtl:2: Kd holds \"nan\"; allowed: finite numbers"),
    ("albedo from a spectrum", "Kd 0.5 0.6 0.7", "Kd spectral red.rfl", 
        "mesh.mtl:2: Kd holds \"spectral\"; allowed: finite numbers"),
    ("negative emission", "Ke 1 2 3", "Ke 1 2 -3", 
        "mesh.mtl:6: Ke is [1.0, 2.0, -3.0]; allowed: 0 to 1e12"),
    ("opacity above 1", "d 0.25", "d 25", 
        "mesh.mtl:7: d is 25; allowed: 0 to 1"),
    ("opacity with an option", "d 0.25", "d -halo 0.25", 
        "mesh.mtl:7: d holds \"-halo\"; allowed: finite numbers"),
    ("transparency", "d 0.25", "Tr 0.75", 
        "mesh.mtl:7: Tr is not read, since programs disagree about its meaning; write d (1 is opaque)"),
    ("texture missing", "map_Kd dots.png", "map_Kd gone.png", 
        "mesh.mtl:3: texture gone.png cannot be read: {gone}"),
    ("texture that is none", "map_Kd dots.png", "map_d mesh.obj", 
        "mesh.mtl:3: texture mesh.obj is neither a PNG nor a JPEG file"),
    ("texture without a name", "map_Kd dots.png", "map_Kd", 
        "mesh.mtl:3: map_Kd names no file; give it one"),
    ("texture with options", "map_Kd dots.png", "map_Kd -s 2 2 2 dots.png", 
        "mesh.mtl:3: map_Kd has options (\"-s 2 2 2 dots.png\"); allowed: a file name alone"),
    ("escape in a material", "newmtl glow", "newmtl gl\u{9b}ow", 
        "mesh.mtl:4: the name after newmtl holds the control character U+009B; allowed: one line of visible characters"),
    ("emission too bright", "Ke 1 2 3", "Ke 1 2 1e20", 
        "mesh.mtl:6: Ke holds \"1e20\"; allowed: numbers from -1e12 to 1e12"),
    ("material without a name", "newmtl glow", "newmtl", 
        "mesh.mtl:4: newmtl names no material; give it a name"),
    ("material twice", "newmtl glow", "newmtl paint", 
        "mesh.mtl:4: newmtl of material \"paint\" is given twice, first in mesh.mtl:1; delete one"),
    ("statement twice", "Ke 1 2 3", "Ke 1 2 3\nKe 1 2 3", 
        "mesh.mtl:7: Ke of material \"glow\" is given twice, first in mesh.mtl:6; delete one"),
    ("statement of no material", "newmtl paint", "Kd 1 1 1\nnewmtl paint", 
        "mesh.mtl:1: Kd stands before the first newmtl; move it below the newmtl of its material"),
];
