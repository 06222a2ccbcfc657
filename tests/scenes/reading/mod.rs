//! Scenes read from files: the documented example, defaults and hashes, and the meaning of each
//! kind of file.

mod faces;
mod materials;
mod meshes;
mod motions;
mod polygons;

use frame::{Efficiency, ShutterProfile};
use glam::DVec3;
use scene::{Background, Family, Interpolation, Parent, load_scene};

use crate::{Folder, OBJ};

#[test]
fn the_documented_example_loads() {
    let folder = Folder::new();
    let readme = include_str!("../../../scenes/README.md");
    let (_, example) = readme.split_once("```toml\n").unwrap();
    let (example, _) = example.split_once("```").unwrap();
    folder.write("scene.toml", example);
    // The mesh has the names of the example.
    folder.write("car.obj", OBJ.replace("g left", "g wheel"));
    for shape in 0..3 {
        let bent = OBJ.replace("v 1 1 0", &format!("v 1 1 {shape}"));
        folder.write(&format!("flag_{shape}.obj"), bent);
    }
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));

    assert_eq!(scene.id.to_string(), "square");
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
    let objects = scene.objects.iter();
    let parents: Vec<_> = objects
        .map(|object| (object.name.as_str(), object.parent))
        .collect();
    let expected = [
        ("car", Parent::World),
        ("wheel", Parent::Object(0)),
        ("dashboard", Parent::Camera),
        ("window", Parent::Object(0)),
        ("flag", Parent::World),
    ];
    assert_eq!(parents, expected);
    assert_eq!(scene.meshes[scene.objects[4].mesh].shapes.len(), 3);
    assert_eq!(scene.camera.motion.interpolation, Interpolation::Cubic);
    let lens = scene.camera.lens.expect("the example has one");
    assert_eq!((lens.aperture, lens.focus), (0.02, 5.0));
    assert_eq!(scene.objects[0].motion.interpolation, Interpolation::Linear);

    let fast = load_scene(&folder.path, Some("fast")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(fast.id.to_string(), "square@fast");
    assert_eq!(fast.exposure, 1.0);
    let table = Efficiency::Table(vec![0.0, 1.0, 1.0, 0.4]);
    assert_eq!(fast.shutter_profile.efficiency, table);
    assert_eq!(fast.shutter_profile.rolling, 0.0);
    let moved = fast.object_to_world(0, 1.0).translation;
    assert_eq!(moved, DVec3::new(2.0, 0.0, 0.0));
}

#[test]
fn omitted_keys_have_their_documented_values() {
    let scene = Folder::new().load().unwrap();
    assert_eq!(scene.display.stops, 0.0);
    assert_eq!(scene.shutter_profile, ShutterProfile::default());
    let flip = scene.display.flip;
    assert_eq!((flip.start, flip.stop, flip.count), (-2.0, 2.0, 5));
    assert_eq!(scene.sun.unwrap().angular_radius, 0.0);
    assert_eq!(scene.objects[0].motion.keys[0].scale, DVec3::ONE);
}

#[test]
fn the_hash_depends_on_every_file_and_the_variant_but_not_on_the_path() {
    let hash = |folder: &Folder, variant| load_scene(&folder.path, variant).unwrap().hash;
    let plain = hash(&Folder::new(), None);
    assert_eq!(plain, hash(&Folder::new(), None), "folders in two places");
    assert_ne!(plain, hash(&Folder::new(), Some("fast")));
    for (file, from, to) in [
        ("scene.toml", "[camera]", "# A comment counts too\n[camera]"),
        ("mesh.obj", "vn 0 0 2", "vn 0 0 3"),
        ("mesh.mtl", "Kd 0.5", "Kd 0.4"),
    ] {
        let folder = Folder::new();
        folder.edit(file, from, to);
        assert_ne!(plain, hash(&folder, None), "{file}");
    }
    let folder = Folder::new();
    let white = frame::Raster::filled(2, 1, [1.0; 3]);
    frame::write_png(&folder.path.join("dots.png"), &white).unwrap();
    assert_ne!(plain, hash(&folder, None), "dots.png");
}
