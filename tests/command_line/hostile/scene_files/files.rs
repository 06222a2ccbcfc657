//! Kinds, sizes, names and places of files.

use std::fs;
use std::path::Path;

use tests::text::assert_contains;

use super::{assert_render_refused, render, with_sky, with_texture};
use crate::sandbox::{SCENE, Sandbox, assert_done, assert_refused, make_fifo};

#[cfg(unix)]
#[test]
fn an_irregular_file_is_refused_before_it_is_opened() {
    let zero = |path: &Path| std::os::unix::fs::symlink("/dev/zero", path).unwrap();
    let socket = |path: &Path| drop(std::os::unix::net::UnixListener::bind(path).unwrap());
    let folder = |path: &Path| fs::create_dir(path).unwrap();
    type Make<'a> = &'a dyn Fn(&Path);
    let kinds: [(Make, &str); 4] = [
        (&make_fifo, "it is a FIFO"),
        (&zero, "it is a device"),
        (&socket, "it is a socket"),
        (&folder, "it is a folder"),
    ];
    for (make, found) in kinds {
        for (file, place) in [
            ("scene.toml", "scene.toml: cannot be read"),
            ("plate.obj", "scene.toml:15: mesh"),
            ("plate.mtl", "plate.obj:1: material library"),
            ("paint.png", "plate.mtl:3: texture"),
            ("sky.exr", "scene.toml:12: the background's image"),
        ] {
            let sandbox = Sandbox::new();
            match file {
                "paint.png" => with_texture(&sandbox, file),
                "sky.exr" => with_sky(&sandbox, file),
                _ => fs::remove_file(sandbox.path("scenes/plate").join(file)).unwrap(),
            }
            make(&sandbox.path("scenes/plate").join(file));
            // This runs in the test's own process, since there are so many cases. A file that gets opened after all
            // hangs the test.
            let error = tracer::load_scene(sandbox.path("scenes/plate"), None).unwrap_err();
            let message = error.to_string();
            assert_contains(
                &message,
                &[place, found, "where a regular file is expected"],
            );
        }
    }
}

#[test]
fn a_large_file_is_refused_before_it_is_read() {
    let sandbox = Sandbox::new();
    // A sparse file takes no disk space.
    let file = fs::File::create(sandbox.path("scenes/plate/plate.obj")).unwrap();
    file.set_len(tracer::limits::LARGEST_MESH_FILE + 1).unwrap();
    let found = "holds 2147483649 bytes, and at most 2147483648 are read";
    assert_render_refused(&sandbox, &["scene.toml:15: mesh", "plate.obj", found]);
}

#[test]
fn a_folder_name_with_control_characters_is_refused() {
    let sandbox = Sandbox::new();
    sandbox.copy_scene("turn\u{1b}[31med", |scene| {
        scene.replace("exposure = 0.5", "exposure = 1")
    });
    let found = "the folder's name is the scene's, and it holds the control character U+001B";
    let output = sandbox.shuttertruth(&["list"]);
    assert_refused(&output, 2, &[found, "rename the folder"]);
}

#[test]
fn letters_of_other_languages_are_allowed() {
    let sandbox = Sandbox::new();
    sandbox.copy_scene("été_桜", |scene| {
        scene.replace("nothing: it serves", "Ничего: it serves")
    });
    let name = "scenes/été_桜";
    let scene = tracer::load_scene(sandbox.path(name), None).unwrap();
    assert_eq!(scene.id, "été_桜");
}

#[cfg(unix)]
#[test]
fn an_unreadable_scene_is_named_and_not_skipped() {
    let message = |sandbox: &Sandbox| {
        let error = tracer::list_scenes(sandbox.path("scenes")).unwrap_err();
        error.to_string()
    };
    let link = std::os::unix::fs::symlink::<&str, std::path::PathBuf>;

    // The folder does not exist.
    let sandbox = Sandbox::new();
    link("nowhere", sandbox.path("scenes/moved")).unwrap();
    let found = message(&sandbox);
    assert!(found.contains("scenes/moved: cannot be read"), "{found}");

    // One scene.toml does not exist, and one is a folder.
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("scenes/half")).unwrap();
    assert_eq!(
        tracer::list_scenes(sandbox.path("scenes")).unwrap().len(),
        1
    );
    link("nowhere", sandbox.path("scenes/half/scene.toml")).unwrap();
    let found = message(&sandbox);
    assert!(found.contains("half/scene.toml: cannot be read"), "{found}");
    fs::remove_file(sandbox.path("scenes/half/scene.toml")).unwrap();
    fs::create_dir(sandbox.path("scenes/half/scene.toml")).unwrap();
    let found = message(&sandbox);
    assert!(found.contains("it is a folder"), "{found}");
}

#[test]
fn a_scene_may_use_files_outside_its_folder() {
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("shared")).unwrap();
    for file in ["plate.obj", "plate.mtl"] {
        fs::rename(
            sandbox.path("scenes/plate").join(file),
            sandbox.path("shared").join(file),
        )
        .unwrap();
    }
    let elsewhere = toml::Value::from(sandbox.path("shared/plate.obj").to_string_lossy().as_ref());
    for mesh in [
        "\"../../shared/plate.obj\"".to_owned(),
        elsewhere.to_string(),
    ] {
        sandbox.write("scene.toml", &SCENE.replace("\"plate.obj\"", &mesh));
        assert_done(&render(&sandbox));
    }
}
