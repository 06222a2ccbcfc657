//! The shipped scenes: their files and their motions.

use glam::{DVec2, DVec3};
use scene::{Scene, SceneListing, list_scenes};
use tests::scenes;

use crate::{load_shipped, shipped_with_variants};

/// Projects a world point into the still camera's picture, in pixels.
fn project(scene: &Scene, point: DVec3) -> DVec2 {
    let seen = (scene.camera.motion.at(0.0).inverse()).transform_point3(point);
    let focal = f64::from(scene.height) / 2.0 / (scene.camera.vertical_fov[0].1 / 2.0).tan();
    let middle = DVec2::new(f64::from(scene.width), f64::from(scene.height)) / 2.0;
    middle + focal * DVec2::new(seen.x, -seen.y) / -seen.z
}

/// Returns the index of an object.
fn object_index(scene: &Scene, name: &str) -> usize {
    let index = scene.objects.iter().position(|object| object.name == name);
    index.unwrap_or_else(|| panic!("{} has no object {name}", scene.id))
}

/// Returns the smallest and largest pixel coordinates of an object at a time.
fn pixel_range(scene: &Scene, name: &str, time: f64) -> [DVec2; 2] {
    let index = object_index(scene, name);
    let to_world = scene.object_to_world(index, time);
    let positions = &scene.meshes[scene.objects[index].mesh].positions;
    let world = |position: &glam::Vec3| to_world.transform_point3(position.as_dvec3());
    let pixels = positions
        .iter()
        .map(|position| project(scene, world(position)));
    let none = [DVec2::INFINITY, DVec2::NEG_INFINITY];
    pixels.fold(none, |[least, largest], pixel| {
        [least.min(pixel), largest.max(pixel)]
    })
}

fn list() -> Vec<SceneListing> {
    list_scenes(scenes()).unwrap_or_else(|error| panic!("{error}"))
}

/// Expects that a scene loads with some of its variants.
fn assert_loads(listing: &SceneListing, variants: &[String]) {
    let scene = load_shipped(&listing.name);
    assert_eq!(scene.exposes, listing.exposes);
    assert_eq!(scene.family, listing.family);
    for variant in variants {
        let name = format!("{}@{variant}", listing.name);
        let changed = load_shipped(&name);
        assert_eq!(changed.id.to_string(), name);
        assert_ne!(changed.hash, scene.hash);
    }
}

#[test]
#[ignore = "prove: all variants of all scenes of the catalogue"]
fn every_scene_loads_with_every_variant() {
    for listing in list() {
        assert_loads(&listing, &listing.variants);
    }
}

#[test]
fn every_scene_loads_with_its_first_variant() {
    let listings = list();
    let names = listings.iter().map(|listing| listing.name.as_str());
    let names: Vec<&str> = names.collect();
    let expected = "cockpit creep crossing dolly fan fence flag flat_field foliage frame_edge glasshouse neon ornaments \
                    pan_sky panel_over_texture railing ramp_floor reversal roll shallow_focus sliding_panel sparks \
                    two_spheres walker wheel_roll wires";
    for name in expected.split_whitespace() {
        assert!(names.contains(&name), "{name} is missing");
    }
    assert!(names.is_sorted());
    for listing in &listings {
        assert_loads(listing, &listing.variants[..listing.variants.len().min(1)]);
    }
}

#[test]
fn the_generator_reproduces_the_shipped_files() {
    for file in generator::generate_files() {
        let bytes = std::fs::read(scenes().join(&file.path));
        let path = file.path;
        let bytes = bytes.unwrap_or_else(|error| panic!("{path}: {error}"));
        let is_same = bytes == file.bytes;
        assert!(is_same, "{path} differs; run `cargo run -p generator`");
    }
}

#[test]
fn the_panel_moves_at_the_speed_of_its_variant() {
    let all = shipped_with_variants();
    let variants: Vec<&str> = (all.iter())
        .filter_map(|name| name.strip_prefix("sliding_panel@"))
        .collect();
    assert_eq!(variants.len(), 20, "five speeds in four directions");
    for variant in variants {
        let (speed, angle) = variant.split_once("px_").unwrap();
        let angle: f64 = angle.strip_suffix("deg").unwrap().parse().unwrap();
        let speed: f64 = speed.parse().unwrap();
        let scene = load_shipped(&format!("sliding_panel@{variant}"));
        let panel = object_index(&scene, "panel");
        let centre = |time| project(&scene, scene.object_to_world(panel, time).translation);
        let [before, after] = [-0.5, 0.5].map(centre);
        // Screen y points down.
        let (sine, cosine) = angle.to_radians().sin_cos();
        let expected = speed * DVec2::new(cosine, -sine);
        // Keys are written to a micrometre: 1e-4 pixels each.
        let actual = after - before;
        assert!(actual.distance(expected) < 3e-4, "{variant}: {actual}");
    }
}

#[test]
fn the_lorry_stops_within_a_sequence() {
    let scene = load_shipped("reversal@stopping");
    let lorry = object_index(&scene, "lorry");
    let at = |time| scene.object_to_world(lorry, time).translation.x;
    let steps = [-1.0, 0.0, 1.0, 2.0].map(|time| at(time + 1.0) - at(time));
    let due = [0.6, 0.6, 0.0, 0.0];
    let is_due = |(step, due): (f64, f64)| (step - due).abs() < 1e-9;
    assert!(steps.into_iter().zip(due).all(is_due), "{steps:?}");
}

#[test]
fn the_panel_keeps_clear_of_the_border() {
    let all = shipped_with_variants();
    for name in all.iter().filter(|name| name.contains("panel")) {
        let scene = load_shipped(name);
        let [width, height] = [scene.width, scene.height].map(f64::from);
        // Trailing and leading shutters reach as far as the exposure on either side.
        for time in [-scene.exposure, 0.0, scene.exposure] {
            let [least, largest] = pixel_range(&scene, "panel", time);
            let clear = least.min(DVec2::new(width, height) - largest).min_element();
            assert!(clear >= 30.0, "{name} at {time}: {clear} pixels");
            // A square of 80 pixels; its sides appear as less than a tenth of one.
            assert!((largest - least).distance(DVec2::splat(80.0)) < 0.1);
        }
    }
}

#[test]
fn the_white_sphere_hides_red_light_that_the_trailing_shutter_sees() {
    let scene = load_shipped("two_spheres");
    let [red, red_end] = pixel_range(&scene, "red", 0.0);
    let [_, hidden] = pixel_range(&scene, "white", 0.0);
    let [_, hidden_before] = pixel_range(&scene, "white", -scene.exposure);
    // Part of the red sphere is hidden at the instant, and more than 30 pixels of it come into
    // view.
    assert!(red.x < hidden.x && hidden.x < red_end.x);
    let travel = hidden.x - hidden_before.x;
    assert!(travel > 30.0, "{travel}");
    let speed = travel / scene.exposure;
    // The silhouette of a sphere off the axis widens by a few per cent.
    assert!((speed - 64.0).abs() < 3.0, "{speed} pixels per frame");
}

#[test]
fn the_car_is_seen_whole_behind_the_railing_and_its_wheels_roll() {
    let scene = load_shipped("railing");
    for name in ["car", "wheel_rear_near", "wheel_front_near", "aeroplane"] {
        for time in [-scene.exposure, 0.0, scene.exposure] {
            let [least, largest] = pixel_range(&scene, name, time);
            assert!(least.min_element() > 30.0, "{name} at {time}");
            assert!(largest.x < 610.0 && largest.y < 330.0, "{name} at {time}");
        }
    }
    let speed = |name| (pixel_range(&scene, name, 0.5)[0] - pixel_range(&scene, name, -0.5)[0]).x;
    assert!((48.0..64.0).contains(&speed("car")));
    assert!((3.0..10.0).contains(&speed("aeroplane")));

    // A rolling wheel is still where it touches the road, and its top moves twice as fast as the
    // car.
    let wheel = object_index(&scene, "wheel_front_near");
    let velocity = |height: f64| {
        let to_wheel = scene.object_to_world(wheel, 0.0).inverse();
        let axle = scene.object_to_world(wheel, 0.0).translation;
        let point = to_wheel.transform_point3(DVec3::new(axle.x, height, axle.z));
        let at = |time| scene.object_to_world(wheel, time).transform_point3(point);
        (at(1e-4) - at(-1e-4)) / 2e-4
    };
    // 1e-4 metres per frame: degrees in the file have four decimals, and the difference quotient is
    // of second order.
    assert!(velocity(0.0).length() < 1e-4, "{}", velocity(0.0));
    assert!(velocity(0.64).distance(DVec3::new(1.8, 0.0, 0.0)) < 1e-4);
}

#[test]
fn the_fan_turns_at_the_speed_of_its_variant() {
    let variants = ["fan", "fan@5deg", "fan@20deg", "fan@45deg", "fan@60deg"];
    for (name, degrees) in variants.into_iter().zip([45.0, 5.0, 20.0, 45.0, 60.0]) {
        let scene = load_shipped(name);
        let fan = object_index(&scene, "fan");
        let blade = |time| scene.object_to_world(fan, time).transform_vector3(DVec3::X);
        let turned = blade(0.0).angle_between(blade(1.0)).to_degrees();
        // 1e-6 degrees: an angle from a cosine keeps half of the digits.
        assert!((turned - degrees).abs() < 1e-6, "{}: {turned}", scene.id);
        assert!(blade(0.01).y > 0.0, "anticlockwise");
    }
}
