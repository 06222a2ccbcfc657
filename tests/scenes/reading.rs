//! Scenes on disk: what is read from their files, and what it comes to mean.

use std::f64::consts::{PI, TAU};

use crate::scene_folder::{self, Folder, OBJ, SCENE};
use frame::{Efficiency, ShutterProfile};
use glam::{DVec3, Vec2, Vec3};
use tracer::{Background, Family, Interpolation, Parent, load_scene};

#[test]
fn the_documented_example_loads() {
    let folder = Folder::new();
    let readme = include_str!("../../scenes/README.md");
    let (_, example) = readme.split_once("```toml\n").unwrap();
    let (example, _) = example.split_once("```").unwrap();
    folder.write("scene.toml", example);
    // The same mesh with the names that the example uses.
    folder.write("car.obj", OBJ.replace("g left", "g wheel"));
    for shape in 0..3 {
        folder.write(
            &format!("flag_{shape}.obj"),
            OBJ.replace("v 1 1 0", &format!("v 1 1 {shape}")),
        );
    }
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));

    assert_eq!(scene.name, "square");
    assert_eq!(scene.family, Family::Overlap);
    assert_eq!((scene.exposure, scene.width, scene.height), (0.5, 640, 360));
    assert_eq!(scene.display.stops, 0.5);
    assert_eq!(scene.display.flip.count, 5);
    assert!(matches!(scene.background, Background::Gradient { .. }));
    assert_eq!(scene.sun.unwrap().angular_radius, 0.27f64.to_radians());
    let trapezoid = Efficiency::Trapezoid {
        rise: 0.2,
        fall: 0.1,
    };
    assert_eq!(scene.shutter_profile.efficiency, trapezoid);
    assert_eq!(scene.shutter_profile.rolling, 0.05);
    let names: Vec<_> = scene
        .objects
        .iter()
        .map(|object| object.name.as_str())
        .collect();
    assert_eq!(names, ["car", "wheel", "dashboard", "flag"]);
    assert_eq!(scene.meshes[scene.objects[3].mesh].shapes.len(), 3);
    let parents: Vec<_> = scene.objects.iter().map(|object| object.parent).collect();
    assert_eq!(
        parents,
        [
            Parent::World,
            Parent::Object(0),
            Parent::Camera,
            Parent::World
        ]
    );
    assert_eq!(scene.camera.motion.interpolation, Interpolation::Cubic);
    assert_eq!(scene.objects[0].motion.interpolation, Interpolation::Linear);

    let fast = load_scene(&folder.path, Some("fast")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!((fast.name.as_str(), fast.exposure), ("square@fast", 1.0));
    let table = Efficiency::Table(vec![0.0, 1.0, 1.0, 0.4]);
    let expected = ShutterProfile {
        efficiency: table,
        rolling: 0.0,
    };
    assert_eq!(fast.shutter_profile, expected);
    let moved = fast.object_to_world(0, 1.0).translation;
    assert_eq!(moved, DVec3::new(2.0, 0.0, 0.0));
}

#[test]
fn what_a_scene_leaves_out_has_its_documented_value() {
    let scene = Folder::new().load().unwrap();
    assert_eq!(scene.display.stops, 0.0);
    assert_eq!(scene.shutter_profile, ShutterProfile::default());
    let flip = scene.display.flip;
    assert_eq!((flip.start, flip.stop, flip.count), (-2.0, 2.0, 5));
    assert_eq!(scene.sun.unwrap().angular_radius, 0.0);
    assert_eq!(scene.objects[0].motion.keys[0].scale, DVec3::ONE);
}

#[test]
fn a_group_is_a_mesh_of_its_own_and_faces_keep_their_materials() {
    let scene = Folder::new().load().unwrap();
    let [whole, left] = [0, 1].map(|object| &scene.meshes[scene.objects[object].mesh]);
    assert_eq!((whole.triangles.len(), left.triangles.len()), (5, 3));
    assert_eq!(whole.slots, [0, 0, 1, 1, 0]);
    assert_eq!(left.slots, [0, 0, 1]);
    let names = |object: usize| -> Vec<&str> {
        let materials = scene.objects[object].materials.iter();
        materials
            .map(|index| scene.materials[*index].name.as_str())
            .collect()
    };
    assert_eq!(names(0), ["paint", "glow"]);
    assert_eq!(names(1), ["glow", "paint"]);
    assert_eq!(
        whole.normals,
        vec![Vec3::Z; whole.positions.len()],
        "normals have unit length"
    );
    assert_eq!(whole.texcoords[1], Vec2::new(1.0, 0.0));
    assert_eq!(whole.positions[whole.triangles[0][1] as usize], Vec3::X);
}

#[test]
fn a_material_is_changed_for_one_object_alone() {
    let scene = Folder::new().load().unwrap();
    let paint =
        |object: usize, slot: usize| &scene.materials[scene.objects[object].materials[slot]];
    assert_eq!(paint(0, 0).diffuse, Vec3::new(0.5, 0.6, 0.7));
    assert_eq!(paint(1, 1).diffuse, Vec3::new(0.1, 0.2, 0.3));
    assert_eq!(
        paint(1, 1).diffuse_texture,
        Some(0),
        "what is not changed stays"
    );
    let glow = paint(0, 1);
    assert_eq!(
        (glow.emission, glow.opacity),
        (Vec3::new(1.0, 2.0, 3.0), 0.25)
    );
}

#[test]
fn objects_of_one_mesh_share_it() {
    let folder = Folder::new();
    folder.edit("scene.toml", "group = \"left\"\n", "");
    let scene = folder.load().unwrap();
    assert_eq!(scene.meshes.len(), 1);
    assert_eq!((scene.objects[0].mesh, scene.objects[1].mesh), (0, 0));
}

/// The square with its corner (1, 1) elsewhere, and other numbers for the same normals.
fn bent() -> String {
    OBJ.replace("v 1 1 0", "v 3 5 0")
        .replace("vn 0 0 2", "vn 0 0 2\nvn 0 0 3")
        .replace("3/3/1 4/2/1", "3/3/2 4/2/1")
}

const SHAPES: &str =
    "shapes = [{ time = -1, mesh = \"mesh.obj\" }, { time = 1, mesh = \"bent.obj\" }]";

#[test]
fn key_shapes_are_one_mesh_that_deforms() {
    let folder = Folder::new();
    folder.write("bent.obj", bent());
    folder.edit(
        "scene.toml",
        "mesh = \"mesh.obj\"\nkeys",
        &format!("{SHAPES}\nkeys"),
    );
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let mesh = &scene.meshes[scene.objects[0].mesh];
    let times: Vec<f64> = mesh.shapes.iter().map(|shape| shape.time).collect();
    assert_eq!(times, [-1.0, 1.0]);
    assert_eq!(mesh.positions, mesh.shapes[0].positions);
    assert_eq!(mesh.triangles.len(), 5);
    for triangle in &mesh.triangles {
        for vertex in triangle.map(|vertex| vertex as usize) {
            let [from, to] = [0, 1].map(|shape| mesh.shapes[shape].positions[vertex]);
            let expected = if from == Vec3::new(1.0, 1.0, 0.0) {
                Vec3::new(3.0, 5.0, 0.0)
            } else {
                from
            };
            assert_eq!(to, expected);
        }
    }
    for shape in &mesh.shapes {
        assert_eq!(shape.normals, vec![Vec3::Z; mesh.positions.len()]);
    }
    assert_eq!(mesh.texcoords.len(), mesh.positions.len());
    // Another object shows a group of the first file, as it is.
    assert!(scene.meshes[scene.objects[1].mesh].shapes.is_empty());
}

#[test]
fn a_group_of_key_shapes_deforms_and_a_variant_may_choose_them() {
    let folder = Folder::new();
    folder.write("bent.obj", bent());
    folder.edit(
        "scene.toml",
        "mesh = \"mesh.obj\"\ngroup",
        &format!("{SHAPES}\ngroup"),
    );
    folder.edit(
        "scene.toml",
        "[variant.fast.object.body]",
        &format!("[variant.fast.object.body]\n{SHAPES}"),
    );
    let fast = load_scene(&folder.path, Some("fast")).unwrap_or_else(|error| panic!("{error}"));
    let [body, part] = [0, 1].map(|object| &fast.meshes[fast.objects[object].mesh]);
    assert_eq!((body.shapes.len(), part.shapes.len()), (2, 2));
    assert_eq!(part.triangles.len(), 3);
}

#[test]
fn faces_of_key_shapes_without_normals_are_flat_beside_smooth_ones() {
    let folder = Folder::new();
    let flat = |text: String| {
        text.replace(
            "usemtl paint\nf 1/1/1 4/2/1 6/3/1",
            "usemtl paint\nf 1/1 4/2 6/3",
        )
    };
    folder.write("bent.obj", flat(bent()));
    folder.write("mesh.obj", flat(OBJ.to_owned()));
    folder.edit(
        "scene.toml",
        "mesh = \"mesh.obj\"\nkeys",
        &format!("{SHAPES}\nkeys"),
    );
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let mesh = &scene.meshes[0];
    let last = mesh.triangles.last().unwrap();
    for shape in &mesh.shapes {
        assert_eq!(
            last.map(|vertex| shape.normals[vertex as usize]),
            [Vec3::ZERO; 3]
        );
        assert_eq!(shape.normals[0], Vec3::Z);
    }
}

#[test]
fn texture_colours_are_decoded_and_opacities_are_not() {
    let folder = Folder::new();
    folder.edit(
        "mesh.mtl",
        "map_Kd dots.png",
        "map_Kd dots.png\nmap_d dots.png",
    );
    let scene = folder.load().unwrap();
    let paint = scene.materials.iter().find(|m| m.name == "paint").unwrap();
    let color = &scene.textures[paint.diffuse_texture.unwrap()];
    let opacity = &scene.textures[paint.opacity_texture.unwrap()];
    assert_eq!((color.width, color.height), (2, 1));
    // 128 of 255 is 0.215861 in IEC 61966-2-1; 1e-6 is the rounding of 32-bit floats.
    assert!((color.texels[0][0] - 0.215_861).abs() < 1e-6);
    assert_eq!(color.texels[0][1..], [0.0, 1.0, 1.0]);
    assert_eq!(opacity.texels[0][3], 128.0 / 255.0);
    assert_eq!(opacity.texels[1][3], 1.0);
}

#[test]
fn a_jpeg_is_a_texture_too_and_a_name_from_windows_finds_it() {
    let folder = Folder::new();
    // One colour, so that nothing is lost: 128 of 255.
    let grey = image::GrayImage::from_pixel(16, 8, image::Luma([128]));
    let mut bytes = std::io::Cursor::new(Vec::new());
    grey.write_to(&mut bytes, image::ImageFormat::Jpeg).unwrap();
    std::fs::create_dir(folder.path.join("paints")).unwrap();
    folder.write("paints/grey.jpg", bytes.into_inner());
    folder.edit("mesh.mtl", "map_Kd dots.png", "map_Kd paints\\grey.jpg");
    let scene = folder.load().unwrap();
    let paint = scene.materials.iter().find(|m| m.name == "paint").unwrap();
    let color = &scene.textures[paint.diffuse_texture.unwrap()];
    assert_eq!((color.width, color.height), (16, 8));
    for texel in &color.texels {
        assert!((texel[0] - 0.215_861).abs() < 1e-6, "{texel:?}");
        assert_eq!(*texel, [texel[0], texel[0], texel[0], 1.0]);
    }
}

#[test]
fn a_textures_factor_is_one_unless_given() {
    let folder = Folder::new();
    folder.write(
        "mesh.mtl",
        "newmtl paint\nmap_Kd dots.png\nmap_Ke dots.png\nnewmtl glow\n",
    );
    let scene = folder.load().unwrap();
    let material = |name| scene.materials.iter().find(|m| m.name == name).unwrap();
    assert_eq!(material("paint").diffuse, Vec3::ONE);
    assert_eq!(material("paint").emission, Vec3::ONE);
    assert_eq!(material("glow").diffuse, Vec3::splat(0.5));
    assert_eq!(material("glow").emission, Vec3::ZERO);
}

#[test]
fn other_ways_to_write_a_mesh_mean_the_same() {
    let plain = Folder::new().load().unwrap();
    let spaced = |text: &str| {
        text.replace("paint", "old  red paint")
            .replace("mesh.mtl", "my mesh.mtl")
    };
    let folder = Folder::new();
    folder.write(
        "my mesh.mtl",
        spaced(scene_folder::MTL).replace('\n', "\r\n"),
    );
    let written_otherwise = spaced(OBJ)
        .replace("f 1/1/1 2/2/1 3/3/1", "f -6/-3/-1 -5/-2/-1 -4/-1/-1")
        .replace("usemtl old", "  usemtl \t old")
        .replace("v 1 1 0", "v 2 2 0 2")
        .replace("v 0 1 0", "v 0 1 0 0.5 0.5 0.5")
        .replace("g left", "l 1 2 3\n\n# faces on the left\n o left")
        .replace('\n', "\r\n");
    folder.write("mesh.obj", written_otherwise);
    folder.edit(
        "scene.toml",
        "material.paint",
        "material.\"old  red paint\"",
    );
    let other = folder.load().unwrap_or_else(|error| panic!("{error}"));
    for (plain, other) in plain.meshes.iter().zip(&other.meshes) {
        assert_eq!(plain.positions, other.positions);
        assert_eq!(plain.normals, other.normals);
        assert_eq!(plain.texcoords, other.texcoords);
        assert_eq!(plain.triangles, other.triangles);
        assert_eq!(plain.slots, other.slots);
    }
    assert!(other.materials.iter().any(|m| m.name == "old  red paint"));
}

#[test]
fn faces_without_normals_are_flat_beside_smooth_ones() {
    let folder = Folder::new();
    let without = "usemtl paint\nf 1/1/1 4/2/1 6/3/1";
    folder.edit("mesh.obj", without, "usemtl paint\nf 1/1 6/3 4/2");
    let scene = folder.load().unwrap();
    let mesh = &scene.meshes[0];
    assert_eq!(mesh.normals.len(), mesh.positions.len());
    let last = mesh.triangles.last().unwrap();
    // Clockwise seen from +Z.
    assert_eq!(
        last.map(|corner| mesh.normals[corner as usize]),
        [Vec3::NEG_Z; 3]
    );
    assert_eq!(mesh.texcoords[last[1] as usize], Vec2::ONE);
}

#[test]
fn faces_without_a_material_are_grey() {
    let folder = Folder::new();
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
    let text = SCENE
        .replace("group = \"left\"\n", "")
        .replace("material.paint", "material.default");
    folder.write("scene.toml", text);
    let scene = folder.load().unwrap();
    assert_eq!(scene.meshes[0].normals, []);
    assert_eq!(scene.materials[0].name, "default");
    assert_eq!(scene.materials[0].diffuse, Vec3::splat(0.5));
}

/// The scene with other keys for its body.
fn with_keys(keys: &str) -> tracer::Scene {
    let folder = Folder::new();
    let old = "    { time = -1 },\n    { time = 1, translation = [1, 0, 0] },\n";
    folder.edit("scene.toml", old, keys);
    folder.load().unwrap_or_else(|error| panic!("{error}"))
}

/// Where the body's +X points at a time.
fn right_of_body(scene: &tracer::Scene, time: f64) -> DVec3 {
    scene.object_to_world(0, time).transform_vector3(DVec3::X)
}

#[test]
fn an_axis_and_degrees_turn_more_than_once() {
    let scene = with_keys(
        "{ time = 0, rotation = { axis = [0, 0, 2], degrees = 90 } },
         { time = 4, rotation = { axis = [0, 0, 1], degrees = 810 } },",
    );
    // Two turns in four frames: half a turn per frame, from +Y.
    for (time, expected) in [
        (0.0, DVec3::Y),
        (1.0, -DVec3::Y),
        (1.5, DVec3::X),
        (5.0, -DVec3::Y),
    ] {
        // 1e-12: rounding of sines in 64 bits.
        assert!(
            right_of_body(&scene, time).distance(expected) < 1e-12,
            "at {time}"
        );
    }
}

#[test]
fn quaternions_turn_steadily_the_shorter_way() {
    // Half of 120 degrees about (1, 1, 1), written with the sign that a naive mean would take the long way round.
    let scene = with_keys("{ time = 0 }, { time = 1, rotation = [-0.5, -0.5, -0.5, -0.5] },");
    let axis = DVec3::ONE.normalize();
    for time in [0.1, 0.25, 0.75, 1.0] {
        let expected = glam::DQuat::from_axis_angle(axis, time * TAU / 3.0) * DVec3::X;
        // 1e-12: rounding of sines in 64 bits.
        assert!(
            right_of_body(&scene, time).distance(expected) < 1e-12,
            "at {time}"
        );
    }
}

#[test]
fn a_turn_just_below_half_is_taken() {
    let scene = with_keys(
        "{ time = 0, rotation = [0, 0, 0, 1] },
         { time = 1, rotation = { axis = [0, 0, 1], degrees = 179.89 } },",
    );
    assert!(right_of_body(&scene, 0.5).y > 0.999);
}

#[test]
fn a_camera_looks_at_its_point_with_up_as_far_as_that_allows() {
    let folder = Folder::new();
    folder.edit(
        "scene.toml",
        "look_at = [0, 0, 0]",
        "look_at = [3, 4, 5]\nup = [1, 1, 7]",
    );
    let pose = folder.load().unwrap().camera.motion.at(0.0);
    // 1e-12: rounding of a quaternion in 64 bits.
    let forward = DVec3::new(3.0, 4.0, 0.0) / 5.0;
    assert!(pose.transform_vector3(-DVec3::Z).distance(forward) < 1e-12);
    let right = forward.cross(DVec3::new(1.0, 1.0, 7.0)).normalize();
    assert!(pose.transform_vector3(DVec3::X).distance(right) < 1e-12);
    assert_eq!(pose.translation, DVec3::new(0.0, 0.0, 5.0));
}

#[test]
fn cubic_keys_are_joined_smoothly() {
    let folder = Folder::new();
    let old = "    { time = -1 },\n    { time = 1, translation = [1, 0, 0] },\n]\n";
    let text = "    { time = -1, translation = [1, 0, 0] },\n    { time = 0 },\n    { time = 1, translation = [1, 0, 0] },\n]\n";
    folder.edit(
        "scene.toml",
        &format!("{old}\n[object.part]"),
        &format!("{text}interpolation = \"cubic\"\n[object.part]"),
    );
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    // The parabola through the keys.
    assert_eq!(scene.object_to_world(0, 0.5).translation.x, 0.25);
    // A variant's keys leave the interpolation as it is.
    let fast = load_scene(&folder.path, Some("fast")).unwrap();
    assert_eq!(fast.objects[0].motion.interpolation, Interpolation::Cubic);
    // Its still pose takes both back.
    folder.edit(
        "scene.toml",
        "keys = [\n    { time = -1 },\n    { time = 1, translation = [2, 0, 0] },\n]",
        "scale = 3",
    );
    let fast = load_scene(&folder.path, Some("fast")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(fast.objects[0].motion.keys.len(), 1);
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

#[test]
fn the_hash_follows_every_file_and_the_variant_but_not_the_place() {
    let hash = |folder: &Folder, variant| load_scene(&folder.path, variant).unwrap().hash;
    let plain = hash(&Folder::new(), None);
    assert_eq!(plain, hash(&Folder::new(), None), "folders in two places");
    assert_ne!(plain, hash(&Folder::new(), Some("fast")));
    for (file, from, to) in [
        ("scene.toml", "# A comment counts too", ""),
        ("mesh.obj", "vn 0 0 2", "vn 0 0 3"),
        ("mesh.mtl", "Kd 0.5", "Kd 0.4"),
    ] {
        let folder = Folder::new();
        if file == "scene.toml" {
            folder.write(file, format!("{SCENE}{from}\n"));
        } else {
            folder.edit(file, from, to);
        }
        assert_ne!(plain, hash(&folder, None), "{file}");
    }
    let folder = Folder::new();
    let white = frame::Raster::filled(2, 1, [1.0; 3]);
    frame::write_png(&folder.path.join("dots.png"), &white).unwrap();
    assert_ne!(plain, hash(&folder, None), "dots.png");
}
