//! Refusals of mistakes in a scene's files. Each message has the place, what was found and what is
//! allowed.
//!
//! Most are in `slips/`, one file per kind of file.

use frame::Raster;
use scene::{SceneError, list_scenes, load_scene};
use serde::Deserialize;

use crate::appearance::{counting_image, folder_with_background, write_sky};
use crate::{Folder, OBJ, SCENE};

/// A mistake in a file of a scene.
#[derive(Deserialize)]
struct Slip {
    name: String,
    from: String,
    /// The text in its place; nothing if the lines are removed.
    to: Option<String>,
    message: String,
}

#[derive(Deserialize)]
struct Slips {
    slip: Vec<Slip>,
}

/// Puts each slip into a new folder, in the first of the files that contains its text, and compares
/// the messages.
fn check_slips(slips: &str, files: &[&str], prepare: impl Fn(&Folder)) {
    let slips: Slips = toml::from_str(slips).unwrap();
    for slip in slips.slip {
        let folder = Folder::new();
        prepare(&folder);
        let (from, to) = match slip.to {
            Some(to) => (slip.from, to),
            None => (slip.from + "\n", String::new()),
        };
        let file = files.iter().find(|file| folder.read(file).contains(&from));
        folder.edit(file.expect(&slip.name), &from, &to);
        assert_refused(&folder, &slip.name, &slip.message);
    }
}

fn assert_refused(folder: &Folder, what: &str, message: &str) {
    let error = folder.load().err();
    let error = error.unwrap_or_else(|| panic!("{what}: it loads, but must be refused"));
    let gone = std::fs::read("no such file").unwrap_err().to_string();
    let expected = message.replace("{gone}", &gone);
    assert_eq!(relative_message(folder, &error), expected, "{what}");
}

/// Formats a message with paths below the scene's folder.
fn relative_message(folder: &Folder, error: &SceneError) -> String {
    let prefix = format!("{}{}", folder.path.display(), std::path::MAIN_SEPARATOR);
    error.to_string().replace(&prefix, "")
}

#[test]
fn slips_in_each_file_are_refused() {
    let keep = |_: &Folder| {};
    check_slips(include_str!("slips/scene.toml"), &["scene.toml"], keep);
    check_slips(include_str!("slips/materials.toml"), &["mesh.mtl"], keep);
    check_slips(include_str!("slips/meshes.toml"), &["mesh.obj"], keep);
    let slips = include_str!("slips/shapes.toml");
    check_slips(slips, &["scene.toml", "bent.obj"], |folder| {
        let shapes =
            "shapes = [\n{ time = 0, mesh = \"mesh.obj\" },\n{ time = 1, mesh = \"bent.obj\" },\n]";
        let mesh = "mesh = \"mesh.obj\"\nkeys";
        folder.edit("scene.toml", mesh, &format!("{shapes}\nkeys"));
        folder.write("bent.obj", OBJ);
    });
}

#[test]
fn whole_files_that_say_nothing_are_refused() {
    let refuse = |file: &str, text: &[u8], message: &str| {
        let folder = Folder::new();
        folder.edit("scene.toml", "group = \"left\"\n", "");
        folder.write(file, text);
        assert_refused(&folder, file, message);
    };
    let empty = SCENE.split("[object.body]").next().unwrap();
    let says = "scene.toml: no objects; a scene needs at least one [object.name] with a mesh";
    refuse("scene.toml", empty.as_bytes(), says);
    // Lines and points are not surfaces.
    let lines = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\np 1\n";
    let says = "mesh.obj: holds no faces; a mesh needs at least one f statement with 3 corners";
    refuse("mesh.obj", lines, says);
    let flat = b"v 0 0 0\nv 1 1 1\nv 2 2 2\nv 3 3 3\nf 1 2 3 4\n";
    let says = "mesh.obj: all 2 triangles have no area; a mesh needs at least one with area";
    refuse("mesh.obj", flat, says);
    let says = "scene.toml:19: mesh mesh.obj cannot be read: it is not UTF-8 text";
    refuse("mesh.obj", b"# caf\xe9\n", says);
    let folder = Folder::new();
    std::fs::remove_file(folder.path.join("scene.toml")).unwrap();
    let message = "scene.toml: cannot be read: {gone}; a scene is a folder with a scene.toml";
    assert_refused(&folder, "no scene", message);
}

#[test]
fn a_folder_without_scenes_and_an_unknown_variant_are_refused() {
    let folder = Folder::new();
    let error = list_scenes(&folder.path).unwrap_err();
    assert_eq!(error.path, folder.path);
    let due = "holds no scene; a scene is a folder with a scene.toml";
    assert_eq!(error.reason, due);
    // Nor has it a variant of any name.
    let error = load_scene(&folder.path, Some("slow")).unwrap_err();
    let expected = "scene.toml: variant \"slow\" is unknown; variants: fast";
    assert_eq!(relative_message(&folder, &error), expected);
}

#[test]
fn glass_that_no_light_passes_may_have_any_index_and_other_glass_not() {
    let folder = Folder::new();
    folder.edit("mesh.mtl", "newmtl glow", "Ni 9\nillum 4\nd 0\nnewmtl glow");
    assert!(folder.load().is_ok(), "nothing is blended");
    let parent = "parent = \"body\"";
    let blended = format!("{parent}\nalpha = \"blended\"");
    folder.edit("scene.toml", parent, &blended);
    let message = "scene.toml:26: material \"paint\" of mesh.obj is thin glass with an index of refraction of 9; allowed: 1 to 4";
    assert_refused(&folder, "glass", message);
}

#[test]
fn an_environment_that_cannot_be_decoded_is_refused() {
    for name in ["sky.exr", "sky.hdr"] {
        let folder = folder_with_background(&format!("image = \"{name}\""));
        std::fs::write(folder.path.join(name), "no picture").unwrap();
        let refusal = folder.load().unwrap_err().to_string();
        let part = format!("{name} cannot be decoded: ");
        assert!(refusal.contains(&part), "{refusal}");
    }
}

#[test]
fn environments_of_other_shapes_and_numbers_are_refused() {
    let holed = Raster::from_fn(4, 2, |x, y| {
        let green = if (x, y) == (2, 1) { f32::NAN } else { 1.0 };
        [1.0, green, 0.0]
    });
    let shape = "12: the background's image sky.exr is 3 x 2; allowed: a map in longitude and latitude, twice as wide as high";
    let number =
        "12: the background's image sky.exr holds [1.0, NaN, 0.0] at (2, 1); allowed: 0 to 1e12";
    let dark = ("\nstrength = 0", counting_image());
    for ((keys, image), message) in [
        (("", Raster::filled(3, 2, [0.0; 3])), shape),
        (("", holed), number),
        (dark, "13: strength is 0; allowed: above 0"),
    ] {
        let folder = folder_with_background(&format!("image = \"sky.exr\"{keys}"));
        write_sky(&folder.path.join("sky.exr"), &image);
        assert_refused(&folder, "sky.exr", &format!("scene.toml:{message}"));
    }
}
