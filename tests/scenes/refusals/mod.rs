//! Refusals of slips in a scene's files. Each names its place, what was found and what is allowed.

mod materials;
mod meshes;
mod motions;
mod scene_tables;

use tracer::{SceneError, list_scenes, load_scene};

use crate::scene_folder::{Folder, SCENE};

/// Slip: its name, a piece of a file, its replacement and the expected message. Paths in the message lie below the
/// scene's folder. `{gone}` stands for the operating system's text about a missing file.
type Slip = (&'static str, &'static str, &'static str, &'static str);

/// Puts each slip into a fresh folder, and compares the messages.
fn check_slips(file: &str, slips: &[Slip]) {
    for (what, from, to, message) in slips {
        let folder = Folder::new();
        folder.edit(file, from, to);
        let error = folder.load().err();
        let error = error.unwrap_or_else(|| panic!("{what}: it loads, but must be refused"));
        assert_eq!(
            relative_message(&folder, &error),
            message.replace("{gone}", &missing_file_text()),
            "{what}"
        );
    }
}

/// Formats a message with paths below the scene's folder.
fn relative_message(folder: &Folder, error: &SceneError) -> String {
    let prefix = format!("{}{}", folder.path.display(), std::path::MAIN_SEPARATOR);
    error.to_string().replace(&prefix, "")
}

/// Returns the operating system's text about a missing file.
fn missing_file_text() -> String {
    std::fs::read("no such file").unwrap_err().to_string()
}

#[test]
fn a_folder_without_a_scene_is_refused() {
    let folder = Folder::new();
    std::fs::remove_file(folder.path.join("scene.toml")).unwrap();
    let error = folder.load().unwrap_err();
    let expected = format!(
        "scene.toml: cannot be read: {}; a scene is a folder with a scene.toml",
        missing_file_text()
    );
    assert_eq!(relative_message(&folder, &error), expected);
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
    assert_eq!(relative_message(&folder, &error), expected);
}

#[test]
fn an_unknown_variant_is_refused() {
    let folder = Folder::new();
    let error = load_scene(&folder.path, Some("slow")).unwrap_err();
    let expected = "scene.toml: variant \"slow\" is unknown; variants: fast";
    assert_eq!(relative_message(&folder, &error), expected);
}

#[test]
fn an_empty_mesh_is_refused() {
    let folder = Folder::new();
    // Lines and points are not surfaces.
    folder.write("mesh.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\np 1\n");
    folder.edit("scene.toml", "group = \"left\"\n", "");
    let error = folder.load().unwrap_err();
    let expected = "mesh.obj: holds no faces; a mesh needs at least one f statement with 3 corners";
    assert_eq!(relative_message(&folder, &error), expected);
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
    assert_eq!(relative_message(&folder, &error), expected);
}

#[test]
fn bytes_that_are_not_text_are_refused() {
    let folder = Folder::new();
    folder.write("mesh.obj", b"# caf\xe9\n");
    let error = folder.load().unwrap_err();
    let expected = "scene.toml:19: mesh mesh.obj cannot be read: it is not UTF-8 text";
    assert_eq!(relative_message(&folder, &error), expected);
}
