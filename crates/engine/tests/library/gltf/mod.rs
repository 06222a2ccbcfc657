//! Export to glTF: a player of the format shows what the tracer renders.

mod played;

use engine::{Timeline, export_gltf};
use glam::{DAffine3, DVec3};
use played::Played;
use scene::{Interpolation, Key, Mesh, Motion, Scene, Turn};
use serde_json::Value;
use tempfile::TempDir;
use tests::random::Random;

use crate::{load_shipped, shipped_with_variants};

/// Random times for comparing poses.
const TIMES: usize = 100;
/// Upper limit on the distance between two poses of a point, relative to the larger of a metre and
/// its distance from the origin.
const TOLERANCE: f64 = 1e-5;

#[test]
fn scenes_play_as_the_tracer_poses_them() {
    // Parents that turn, key shapes, and a camera that carries a dashboard.
    for name in ["railing", "flag", "cockpit", "walker"] {
        assert_plays(&load_shipped(name));
    }
}

#[test]
#[ignore = "prove: all scenes of the catalogue with all variants"]
fn every_scene_and_variant_plays_as_the_tracer_poses_it() {
    for name in shipped_with_variants() {
        assert_plays(&load_shipped(&name));
    }
}

#[test]
fn turns_beyond_half_a_circle_and_cubic_paths_are_kept() {
    let turn = |axis: DVec3, degrees: f64| Turn {
        axis: axis.normalize(),
        angle: degrees.to_radians(),
    };
    let key = |time: f64, x: f64, orientation, turn| Key {
        time,
        translation: DVec3::new(x, x * x, 0.0),
        orientation,
        scale: DVec3::new(1.0, 1.0 + 0.1 * x, 1.0),
        turn,
    };
    // More than two turns in two frames, then half a turn about another axis.
    let first = turn(DVec3::Z, 800.0);
    let second = turn(DVec3::new(1.0, 1.0, 0.0), 170.0);
    let rotated =
        |turn: Turn, from: glam::DQuat| glam::DQuat::from_axis_angle(turn.axis, turn.angle) * from;
    let start = glam::DQuat::from_rotation_y(0.3);
    let middle = rotated(first, start);
    let keys = vec![
        key(-1.0, -2.0, start, first),
        key(1.0, 1.0, middle, second),
        key(1.5, 3.0, rotated(second, middle), Turn::NONE),
    ];
    for interpolation in [Interpolation::Linear, Interpolation::Cubic] {
        let motion = Motion {
            keys: keys.clone(),
            interpolation,
        };
        let mut scene = load_shipped("flat_field");
        scene.objects[0].motion = motion.clone();
        scene.camera.motion = motion;
        for key in &mut scene.camera.motion.keys {
            key.scale = DVec3::ONE;
        }
        assert_plays(&scene);
    }
}

/// Loads a scene, one object of which turns steadily, in degrees per frame.
fn spinning_scene(speed: f64) -> Scene {
    let mut scene = load_shipped("flat_field");
    let start = scene.objects[0].motion.keys[0];
    let axis = DVec3::new(0.6, 0.0, 0.8);
    scene.objects[0].motion = tests::shapes::spin(start.translation, axis, speed.to_radians());
    scene
}

#[test]
fn an_animation_turns_as_fast_as_its_times_can_tell() {
    let slow = spinning_scene(1000.0);
    assert_plays(&slow);
    let fast = spinning_scene(240_000.0);
    let folder = export(&fast).unwrap();
    let (played, timeline) = (Played::read(folder.path()), Timeline::of(&fast));
    for time in [-1.7, -1.0, 0.0, 0.3, 1.0] {
        let x = |pose: DAffine3| pose.transform_vector3(DVec3::X).normalize();
        let traced = x(fast.object_to_world(0, time));
        let shown = x(played.to_world(1, timeline.seconds(time)));
        // The limit of the exporter, and the rounding of the time that is asked for.
        assert!(
            traced.angle_between(shown) < 2e-3,
            "{traced}, {shown} at {time}"
        );
    }
    for speed in [250_000.0, 1e7, -1e12] {
        let error = export(&spinning_scene(speed)).unwrap_err();
        let (speed, object) = (speed.abs(), &fast.objects[0].name);
        let words =
            format!("object \"{object}\" turns by up to {speed} degrees per frame; allowed: 240");
        assert!(error.contains(&words), "{error}");
    }
    let mut scene = load_shipped("flat_field");
    scene.camera.motion = tests::shapes::spin(DVec3::ZERO, DVec3::Y, 1e6);
    let error = export(&scene).unwrap_err();
    assert!(error.contains("the camera turns by up to"), "{error}");
}

#[test]
fn a_zoom_is_refused_since_gltf_cannot_say_it() {
    let mut scene = load_shipped("flat_field");
    scene.camera.vertical_fov = vec![(-1.0, 0.6), (1.0, 0.7)];
    let error = export(&scene).unwrap_err();
    assert!(error.contains("field of view changes"), "{error}");
}

#[test]
fn a_texture_of_holes_is_joined_with_that_of_the_color() {
    let mut scene = load_shipped("railing");
    let material = (scene.materials.iter_mut()).find(|material| material.diffuse_texture.is_some());
    let material = material.expect("a textured material");
    let texture = material.diffuse_texture.unwrap();
    material.opacity_texture = Some(texture);
    let name = material.name.clone();
    let original = image::open(&scene.textures[texture].path);
    let original = original.unwrap().to_rgb8();
    scene.textures[texture].texels[0][3] = 0.25;
    let folder = export(&scene).unwrap();
    let joined = format!("textures/{texture}_with_opacity_{texture}.png");
    let joined = image::open(folder.path().join(joined)).unwrap().to_rgba8();
    assert_eq!(joined.dimensions(), original.dimensions());
    for (pixel, given) in joined.pixels().zip(original.pixels()) {
        assert_eq!(pixel.0[..3], given.0[..]);
    }
    let opacity = |x| joined.get_pixel(x, 0).0[3];
    assert_eq!([opacity(0), opacity(1)], [64, 255]);
    assert!(Played::read(folder.path()).has_holes(&name));
}

#[test]
fn films_blend_glass_transmits_and_what_gltf_cannot_say_is_refused() {
    let mut scene = load_shipped("glasshouse");
    let document = read_document(&export(&scene).unwrap());
    let materials = document["materials"].as_array().unwrap();
    let named = |name: &str| {
        materials
            .iter()
            .find(|material| material["name"] == name)
            .unwrap()
    };
    let (frost, glass) = (named("frost"), named("glass"));
    assert_eq!(frost["alphaMode"], "BLEND");
    assert_eq!(glass["alphaMode"], "OPAQUE");
    let transmission = &glass["extensions"]["KHR_materials_transmission"];
    assert_eq!(transmission["transmissionFactor"], 1.0);
    assert_eq!(glass["extensions"]["KHR_materials_ior"]["ior"], 1.5);
    let base = &glass["pbrMetallicRoughness"]["baseColorFactor"];
    assert!((base[0].as_f64().unwrap() - 0.9).abs() < 1e-6, "{base}");
    let used = document["extensionsUsed"].as_array().unwrap();
    assert!(used.contains(&"KHR_materials_transmission".into()));

    let glass = scene
        .materials
        .iter_mut()
        .find(|material| material.name == "glass");
    glass.unwrap().opacity = 0.5;
    let error = export(&scene).unwrap_err();
    let words = "material glass: opacity 0.5 beside glass";
    assert!(error.contains(words), "{error}");
}

#[test]
fn an_unlit_scene_is_exported_with_colours_alone() {
    let document = read_document(&export(&load_shipped("railing@unlit")).unwrap());
    assert!(!document.to_string().contains("KHR_lights_punctual"));
    for material in document["materials"].as_array().unwrap() {
        let base = &material["pbrMetallicRoughness"]["baseColorFactor"];
        for channel in 0..3 {
            assert_eq!(base[channel].as_f64(), Some(0.0), "{material}");
        }
        let emitted = material["emissiveFactor"].as_array().unwrap();
        let shines = emitted.iter().any(|part| part.as_f64() > Some(0.0));
        assert!(shines, "{material}");
    }
}

#[test]
fn a_colored_emissive_texture_is_one_texture_without_a_factor() {
    let scene = load_shipped("fence@unlit");
    let folder = export(&scene).unwrap();
    let document = read_document(&folder);
    let traced = scene
        .materials
        .iter()
        .find(|material| material.name == "red");
    let traced = traced.unwrap();
    let mut materials = document["materials"].as_array().unwrap().iter();
    let red = materials
        .find(|material| material["name"] == "red")
        .unwrap();
    assert_eq!(red["emissiveFactor"], serde_json::json!([1.0, 1.0, 1.0]));
    let texture = red["emissiveTexture"]["index"].as_u64().unwrap() as usize;
    let name = document["images"][texture]["uri"].as_str().unwrap();
    let tinted = frame::read_png(&folder.path().join(name)).unwrap();
    let original = &scene.textures[traced.emission_texture.unwrap()];
    let tinted = frame::scene_linear(&tinted, 0.0);
    for (tinted, texel) in tinted.pixels.iter().zip(&original.texels) {
        for channel in 0..3 {
            let error = tinted[channel] - texel[channel] * traced.emission[channel];
            // Half of the widest of 255 steps.
            assert!(error.abs() < 0.005, "{tinted:?} {texel:?}");
        }
    }
}

/// Reads the description of an exported scene.
fn read_document(folder: &TempDir) -> Value {
    let text = std::fs::read(folder.path().join("scene.gltf")).unwrap();
    serde_json::from_slice(&text).unwrap()
}

/// Exports a scene to a folder, or returns why not.
fn export(scene: &Scene) -> Result<TempDir, String> {
    let folder = tempfile::tempdir().unwrap();
    match export_gltf(scene, &tests::scenes().into(), "test", folder.path(), 4) {
        Ok(_) => Ok(folder),
        Err(error) => Err(error.to_string()),
    }
}

/// Exports a scene, and compares camera, objects and vertices at random times within the animation.
fn assert_plays(scene: &Scene) {
    let folder = export(scene).unwrap_or_else(|error| panic!("{error}"));
    let played = Played::read(folder.path());
    let by_components = Played::read(folder.path()).by_components();
    let timeline = Timeline::of(scene);
    let mut random = Random::new(7);
    for _ in 0..TIMES {
        let time = timeline.reach * f64::from(random.real(-1.0, 1.0));
        let seconds = timeline.seconds(time);
        let camera = scene.camera.motion.at(time);
        assert_close(scene, "camera", time, camera, played.to_world(0, seconds));
        for (index, object) in scene.objects.iter().enumerate() {
            let traced = scene.object_to_world(index, time);
            let pose = played.to_world(index + 1, seconds);
            assert_close(scene, &object.name, time, traced, pose);
            let pose = by_components.to_world(index + 1, seconds);
            assert_close(scene, &object.name, time, traced, pose);
        }
    }
    for (index, object) in scene.objects.iter().enumerate() {
        assert_eq!(played.node(index + 1).name(), Some(object.name.as_str()));
        assert_vertices(scene, index, &played, &timeline);
    }
}

/// Compares two poses' positions of the origin and of a point on each axis.
fn assert_close(scene: &Scene, what: &str, time: f64, traced: DAffine3, played: DAffine3) {
    for point in [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z] {
        let [traced, played] = [traced, played].map(|pose| pose.transform_point3(point));
        let error = (traced - played).length() / traced.length().max(1.0);
        let place = format!("{}: {what} at frame {time}", scene.id);
        assert!(
            error < TOLERANCE,
            "{place}: {traced} traced, {played} in glTF"
        );
    }
}

/// Compares the corners of all triangles, whatever their order.
fn assert_vertices(scene: &Scene, index: usize, played: &Played, timeline: &Timeline) {
    let mesh = &scene.meshes[scene.objects[index].mesh];
    for time in [-1.3, 0.0, 0.4] {
        let sorted = |mut corners: Vec<DVec3>| {
            corners.sort_by(|a, b| {
                let [a, b] = [a, b].map(|corner| corner.to_array());
                a.partial_cmp(&b).expect("finite")
            });
            corners
        };
        let traced = (mesh.triangles.iter().flatten()).map(|corner| vertex(mesh, *corner, time));
        let played_corners = played.corners(index + 1, timeline.seconds(time));
        assert_eq!(
            played_corners.len(),
            3 * mesh.triangles.len(),
            "{}",
            scene.id
        );
        if mesh.shapes.is_empty() {
            assert_eq!(
                sorted(played_corners),
                sorted(traced.collect()),
                "{}",
                scene.id
            );
            continue;
        }
        // Rounding may change the order of moved vertices, so sums over all of them are compared.
        let sum = |corners: &[DVec3]| {
            corners
                .iter()
                .map(|corner| *corner * corner.length())
                .sum::<DVec3>()
        };
        let traced: Vec<DVec3> = traced.collect();
        let error = (sum(&traced) - sum(&played_corners)).length() / traced.len() as f64;
        assert!(error < TOLERANCE, "{} at frame {time}: {error}", scene.id);
    }
}

/// Returns a vertex in its object's space: on a straight line between two shapes, or beyond the
/// last two.
fn vertex(mesh: &Mesh, corner: u32, time: f64) -> DVec3 {
    let at = |positions: &[glam::Vec3]| positions[corner as usize].as_dvec3();
    if mesh.shapes.is_empty() {
        return at(&mesh.positions);
    }
    let after = mesh.shapes.partition_point(|shape| shape.time <= time);
    let after = after.clamp(1, mesh.shapes.len() - 1);
    let [from, to] = [&mesh.shapes[after - 1], &mesh.shapes[after]];
    let part = (time - from.time) / (to.time - from.time);
    at(&from.positions).lerp(at(&to.positions), part)
}
