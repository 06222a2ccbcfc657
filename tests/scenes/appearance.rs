//! Finishes and environments read from a scene's files.

use std::path::Path;

use frame::{ExrFile, Image, Raster, write_exr};
use image::Rgb32FImage;
use scene::{Background, Finish};
use tests::exr_attribute::{ACES_CG, bytes_of, set_exr_attribute, to_aces_cg};

use crate::Folder;

/// Loads the finish of the second object's material `paint`, with more MTL statements and more keys
/// of its table in the scene.
fn load_finish(statements: &str, keys: &str) -> Finish {
    let folder = Folder::new();
    let (paint, diffuse) = ("Kd 0.5 0.6 0.7", "diffuse = [0.1, 0.2, 0.3]");
    folder.edit("mesh.mtl", paint, &format!("{paint}\n{statements}"));
    folder.edit("scene.toml", diffuse, &format!("{diffuse}\n{keys}"));
    let scene = folder.load().unwrap_or_else(|error| panic!("{error}"));
    let materials = scene.objects[1].materials.iter();
    let mut materials = materials.map(|index| &scene.materials[*index]);
    let paint = materials.find(|material| material.name == "paint");
    paint.expect("it is there").finish
}

#[test]
fn roughness_makes_gloss_and_metallic_makes_metal_and_a_scene_changes_them() {
    let coated = |roughness, index| Finish::Coated { roughness, index };
    let metal = |roughness| Finish::Conductor { roughness };
    let both = "metallic = false\nindex_of_refraction = 1.3";
    for (statements, keys, expected) in [
        ("", "", Finish::Diffuse),
        // Exporters write a refractive index for every material.
        ("Ni 1.45", "", Finish::Diffuse),
        ("Ni 0", "", Finish::Diffuse),
        ("Pm 0", "", Finish::Diffuse),
        ("Pr 0.5", "", coated(0.5, 1.5)),
        ("Pr 0.5\nPm 0\nNi 1.45", "", coated(0.5, 1.45)),
        ("Pr 0", "", coated(0.0, 1.5)),
        ("Pr 1\nNi 1", "", Finish::Diffuse),
        ("Pr 0.25\nPm 1", "", metal(0.25)),
        ("Pm 1\nNi 0.2\nPr 0", "", metal(0.0)),
        ("", "roughness = 0.1", coated(0.1, 1.5)),
        ("Pr 0.5\nNi 2", "roughness = 0.1", coated(0.1, 2.0)),
        ("Pr 0.5", "metallic = true", metal(0.5)),
        ("Pr 0.5\nPm 1", both, coated(0.5, 1.3)),
        ("Pr 0.5", "index_of_refraction = 1", Finish::Diffuse),
    ] {
        let actual = load_finish(statements, keys);
        assert_eq!(actual, expected, "{statements} then {keys}");
    }
}

/// Makes an image of two rows of four texels that count up from 0.
pub fn counting_image() -> Image {
    Raster::from_fn(4, 2, |x, y| [(x + 4 * y) as f32, 1.0, 0.5])
}

/// Writes a background's image, as Radiance HDR or OpenEXR by the ending of its name.
pub fn write_sky(path: &Path, image: &Image) {
    let (width, height) = (image.width, image.height);
    if path.extension().is_some_and(|ending| ending == "hdr") {
        let parts = image.pixels.as_flattened().to_vec();
        let picture = Rgb32FImage::from_raw(width, height, parts).unwrap();
        return picture.save(path).unwrap();
    }
    let mut file = ExrFile::new(width, height);
    file.push_color("", image);
    write_exr(path, &file).unwrap();
}

/// Makes the scene's folder with another background.
pub fn folder_with_background(background: &str) -> Folder {
    let folder = Folder::new();
    folder.edit("scene.toml", "constant = [0, 0, 0]", background);
    folder
}

#[test]
fn an_environment_in_other_primaries_is_converted_and_one_of_odd_pixels_is_refused() {
    let folder = folder_with_background("image = \"sky.exr\"");
    let path = folder.path.join("sky.exr");
    let color = [0.25, 0.5, 0.125];
    let save = || write_sky(&path, &Raster::filled(4, 2, to_aces_cg(color)));
    save();
    set_exr_attribute(
        &path,
        "chromaticities",
        "chromaticities",
        &bytes_of(&ACES_CG),
    );
    let Background::Map(map) = folder.load().unwrap().background else {
        panic!("it is a map");
    };
    for texel in map.texels {
        let is_near = texel
            .iter()
            .zip(color)
            .all(|(part, due)| (part - due).abs() < 1e-4);
        assert!(is_near, "{texel:?}");
    }
    let window = [1_i32, 0, 4, 1].map(i32::to_le_bytes).concat();
    for (name, kind, value, part) in [
        (
            "pixelAspectRatio",
            "float",
            bytes_of(&[2.0]),
            "its pixels are 2 times as wide as high",
        ),
        (
            "displayWindow",
            "box2i",
            window,
            "is not its display window",
        ),
        (
            "whiteLuminance",
            "float",
            bytes_of(&[100.0]),
            "a whiteLuminance of 100 cd/m2",
        ),
    ] {
        save();
        set_exr_attribute(&path, name, kind, &value);
        let error = folder.load().unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn an_environment_is_read_from_exr_and_hdr() {
    for name in ["sky.exr", "sky.hdr"] {
        let folder =
            folder_with_background(&format!("image = \"{name}\"\nstrength = 2\nrotation = 90"));
        write_sky(&folder.path.join(name), &counting_image());
        let Background::Map(map) = folder.load().unwrap().background else {
            panic!("{name} is a map");
        };
        assert_eq!((map.width, map.height, map.strength), (4, 2, 2.0));
        assert_eq!(map.rotation, std::f64::consts::FRAC_PI_2);
        // EXR stays linear, and the shared exponent of HDR holds these numbers exactly.
        let expected: Vec<[f32; 3]> = (0..8).map(|count| [count as f32, 1.0, 0.5]).collect();
        assert_eq!(map.texels, expected, "{name}");
    }
    let folder = folder_with_background("image = \"sky.exr\"");
    let path = folder.path.join("sky.exr");
    write_sky(&path, &counting_image());
    let before = folder.load().unwrap();
    let Background::Map(map) = before.background else {
        panic!("it is a map");
    };
    assert_eq!((map.strength, map.rotation), (1.0, 0.0));
    let mut brighter = counting_image();
    brighter.pixels[0] = [9.0; 3];
    write_sky(&path, &brighter);
    // The hash follows the image.
    assert_ne!(folder.load().unwrap().hash, before.hash);
}
