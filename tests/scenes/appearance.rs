//! Finishes and environments read from a scene's files.

use image::{ImageBuffer, Rgb32FImage};
use tracer::{Background, EnvironmentMap, Finish, Scene};

use crate::scene_folder::Folder;

/// Loads the finish of the material `paint` with more MTL statements.
fn load_finish(statements: &str) -> Finish {
    let folder = Folder::new();
    folder.edit(
        "mesh.mtl",
        "Kd 0.5 0.6 0.7",
        &format!("Kd 0.5 0.6 0.7\n{statements}"),
    );
    finish_of(&folder.load().unwrap_or_else(|error| panic!("{error}")))
}

/// Returns the finish of the second object's material `paint`.
fn finish_of(scene: &Scene) -> Finish {
    let materials = scene.objects[1].materials.iter();
    let mut materials = materials.map(|index| &scene.materials[*index]);
    let paint = materials.find(|material| material.name == "paint");
    paint.expect("it is there").finish
}

fn load_refusal(folder: &Folder) -> String {
    let error = folder.load().expect_err("it must be refused").to_string();
    let prefix = format!("{}{}", folder.path.display(), std::path::MAIN_SEPARATOR);
    error.replace(&prefix, "")
}

#[test]
fn roughness_makes_gloss_and_metallic_makes_metal() {
    let coated = |roughness, index| Finish::Coated { roughness, index };
    let metal = |roughness| Finish::Conductor { roughness };
    for (statements, expected) in [
        ("", Finish::Diffuse),
        // Exporters write a refractive index for every material.
        ("Ni 1.45", Finish::Diffuse),
        ("Ni 0", Finish::Diffuse),
        ("Pm 0", Finish::Diffuse),
        ("Pr 0.5", coated(0.5, 1.5)),
        ("Pr 0.5\nPm 0\nNi 1.45", coated(0.5, 1.45)),
        ("Pr 0", coated(0.0, 1.5)),
        ("Pr 1\nNi 1", Finish::Diffuse),
        ("Pr 0.25\nPm 1", metal(0.25)),
        ("Pm 1\nNi 0.2\nPr 0", metal(0.0)),
    ] {
        assert_eq!(load_finish(statements), expected, "{statements}");
    }
}

#[test]
fn a_scene_changes_the_finish_of_one_object() {
    for (before, keys, expected) in [
        (
            "",
            "roughness = 0.1",
            Finish::Coated {
                roughness: 0.1,
                index: 1.5,
            },
        ),
        (
            "Pr 0.5\nNi 2",
            "roughness = 0.1",
            Finish::Coated {
                roughness: 0.1,
                index: 2.0,
            },
        ),
        (
            "Pr 0.5",
            "metallic = true",
            Finish::Conductor { roughness: 0.5 },
        ),
        (
            "Pr 0.5\nPm 1",
            "metallic = false\nindex_of_refraction = 1.3",
            Finish::Coated {
                roughness: 0.5,
                index: 1.3,
            },
        ),
        ("Pr 0.5", "index_of_refraction = 1", Finish::Diffuse),
    ] {
        let folder = Folder::new();
        folder.edit(
            "mesh.mtl",
            "Kd 0.5 0.6 0.7",
            &format!("Kd 0.5 0.6 0.7\n{before}"),
        );
        let diffuse = "diffuse = [0.1, 0.2, 0.3]";
        folder.edit("scene.toml", diffuse, &format!("{diffuse}\n{keys}"));
        assert_eq!(
            finish_of(&folder.load().unwrap()),
            expected,
            "{before} then {keys}"
        );
    }
}

#[test]
fn slips_in_finishes_are_refused() {
    for (statements, message) in [
        (
            "Pr 1.5",
            "mesh.mtl:3: Pr is 1.5; allowed: 0 (a mirror) and 0.01 to 1",
        ),
        (
            "Pr -0.5",
            "mesh.mtl:3: Pr is -0.5; allowed: 0 (a mirror) and 0.01 to 1",
        ),
        (
            "Pr 0.001",
            "mesh.mtl:3: Pr is 0.001; allowed: 0 (a mirror) and 0.01 to 1",
        ),
        (
            "Pr shiny",
            "mesh.mtl:3: Pr holds \"shiny\"; allowed: finite numbers",
        ),
        (
            "Pr 0.5\nPm 0.5",
            "mesh.mtl:4: Pm is 0.5; allowed: 0 (paint, wood, plastic) or 1 (bare metal), nothing between",
        ),
        (
            "Pm 1",
            "mesh.mtl:3: Pm makes a metal without a roughness; give it one (0 is a mirror)",
        ),
        ("Pr 0.5\nNi 0.9", "mesh.mtl:4: Ni is 0.9; allowed: 1 to 4"),
        (
            "Pr 0.5\nPr 0.5",
            "mesh.mtl:4: Pr of material \"paint\" is given twice, first in mesh.mtl:3; delete one",
        ),
    ] {
        let folder = Folder::new();
        folder.edit(
            "mesh.mtl",
            "Kd 0.5 0.6 0.7",
            &format!("Kd 0.5 0.6 0.7\n{statements}"),
        );
        assert_eq!(load_refusal(&folder), message);
    }
    for (keys, message) in [
        (
            "roughness = 2",
            "scene.toml:33: roughness is 2; allowed: 0 (a mirror) and 0.01 to 1",
        ),
        (
            "metallic = true",
            "scene.toml:33: metallic makes a metal without a roughness; give it one (0 is a mirror)",
        ),
        (
            "roughness = 1\nindex_of_refraction = 5",
            "scene.toml:34: index_of_refraction is 5; allowed: 1 to 4",
        ),
    ] {
        let folder = Folder::new();
        let diffuse = "diffuse = [0.1, 0.2, 0.3]";
        folder.edit("scene.toml", diffuse, &format!("{diffuse}\n{keys}"));
        assert_eq!(load_refusal(&folder), message);
    }
}

/// Makes an image of two rows of four texels that count up from 0.
fn counting_image() -> Rgb32FImage {
    ImageBuffer::from_fn(4, 2, |x, y| image::Rgb([(x + 4 * y) as f32, 1.0, 0.5]))
}

/// Makes the scene's folder with another background.
fn folder_with_background(background: &str) -> Folder {
    let folder = Folder::new();
    folder.edit("scene.toml", "constant = [0, 0, 0]", background);
    folder
}

#[test]
fn an_environment_is_read_from_exr_and_hdr() {
    for name in ["sky.exr", "sky.hdr"] {
        let folder =
            folder_with_background(&format!("image = \"{name}\"\nstrength = 2\nrotation = 90"));
        counting_image().save(folder.path.join(name)).unwrap();
        let Background::Map(map) = folder.load().unwrap().background else {
            panic!("{name} is a map");
        };
        let EnvironmentMap {
            width,
            height,
            texels,
            strength,
            rotation,
            ..
        } = map;
        assert_eq!((width, height, strength), (4, 2, 2.0));
        assert_eq!(rotation, std::f64::consts::FRAC_PI_2);
        // EXR stays linear, and the shared exponent of HDR holds these numbers exactly.
        let expected: Vec<[f32; 3]> = (0..8).map(|count| [count as f32, 1.0, 0.5]).collect();
        assert_eq!(texels, expected, "{name}");
    }
    let folder = folder_with_background("image = \"sky.exr\"");
    counting_image().save(folder.path.join("sky.exr")).unwrap();
    let before = folder.load().unwrap();
    assert!(
        matches!(before.background, Background::Map(map) if map.strength == 1.0 && map.rotation == 0.0)
    );
    let mut brighter = counting_image();
    brighter.put_pixel(0, 0, image::Rgb([9.0; 3]));
    brighter.save(folder.path.join("sky.exr")).unwrap();
    assert_ne!(
        folder.load().unwrap().hash,
        before.hash,
        "the hash follows the image"
    );
}

#[test]
fn slips_in_environments_are_refused() {
    let sky = "image = \"sky.exr\"";
    let gone = std::fs::read("no such file").unwrap_err();
    let needs = "scene.toml:11: a background needs one of: constant = [r, g, b], gradient = { ground, horizon, zenith }, \
                 image = \"sky.exr\"";
    for (background, image, message) in [
        (sky, None, format!("scene.toml:12: the background's image sky.exr cannot be read: {gone}")),
        (
            "image = \"dots.png\"",
            None,
            "scene.toml:12: the background's image dots.png is neither .exr nor .hdr; other formats do not hold radiance"
                .into(),
        ),
        (
            sky,
            Some(ImageBuffer::new(3, 2)),
            "scene.toml:12: the background's image sky.exr is 3 x 2; allowed: a map in longitude and latitude, twice as wide as high"
                .into(),
        ),
        (
            sky,
            Some(ImageBuffer::from_fn(4, 2, |x, y| image::Rgb([1.0, if [x, y] == [2, 1] { f32::NAN } else { 1.0 }, 0.0]))),
            "scene.toml:12: the background's image sky.exr holds [1.0, NaN, 0.0] at (2, 1); allowed: 0 to 1e12"
                .into(),
        ),
        (
            "image = \"sky.exr\"\nstrength = 0",
            Some(counting_image()),
            "scene.toml:13: strength is 0; allowed: above 0".into(),
        ),
        (
            "constant = [1, 1, 1]\nstrength = 2",
            None,
            "scene.toml:11: strength and rotation need an image; add one: image = \"sky.exr\"".into(),
        ),
        ("constant = [1, 1, 1]\nimage = \"sky.exr\"", None, needs.to_owned()),
    ] {
        let folder = folder_with_background(background);
        if let Some(image) = image {
            Rgb32FImage::save(&image, folder.path.join("sky.exr")).unwrap();
        }
        let found = load_refusal(&folder);
        assert_eq!(found.replace(&format!("{}/", folder.path.display()), ""), message);
    }
}
