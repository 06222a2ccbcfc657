//! Types, sizes, names and places of files.

use std::fs;
use std::path::Path;

use tests::text::assert_contains;

use super::{RENDER, with_sky, with_texture};
use crate::sandbox::{SCENE, Sandbox, make_fifo};

#[cfg(unix)]
#[test]
fn an_irregular_file_is_refused_before_it_is_opened() {
    type Make<'a> = &'a dyn Fn(&Path);
    let kinds: [(Make, &str); 4] = [
        (&make_fifo, "it is a FIFO"),
        (&|path| link("/dev/zero", path), "it is a device"),
        (
            &|path| drop(std::os::unix::net::UnixListener::bind(path).unwrap()),
            "it is a socket",
        ),
        (&|path| fs::create_dir(path).unwrap(), "it is a folder"),
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
            // This runs in the test's own process, since there are so many cases. The test hangs if a file is opened after all.
            let error = tracer::load_scene(sandbox.path("scenes/plate"), None).unwrap_err();
            let parts = [place, found, "where a regular file is expected"];
            assert_contains(&error.to_string(), &parts);
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
    sandbox.refuse(RENDER, &["scene.toml:15: mesh", "plate.obj", found]);
}

#[cfg(unix)]
fn link(target: &str, path: &Path) {
    std::os::unix::fs::symlink(target, path).unwrap();
}

#[cfg(unix)]
#[test]
fn an_unreadable_scene_is_named_and_not_skipped() {
    let list = |sandbox: &Sandbox| tracer::list_scenes(sandbox.path("scenes"));
    let refused = |sandbox: &Sandbox, part: &str| {
        assert_contains(&list(sandbox).unwrap_err().to_string(), &[part]);
    };
    // The folder does not exist.
    let sandbox = Sandbox::new();
    link("nowhere", &sandbox.path("scenes/moved"));
    refused(&sandbox, "scenes/moved: cannot be read");
    // One scene.toml does not exist, and one is a folder.
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("scenes/half")).unwrap();
    assert_eq!(list(&sandbox).unwrap().len(), 1);
    let path = sandbox.path("scenes/half/scene.toml");
    link("nowhere", &path);
    refused(&sandbox, "half/scene.toml: cannot be read");
    fs::remove_file(&path).unwrap();
    fs::create_dir(&path).unwrap();
    refused(&sandbox, "it is a folder");
}

#[test]
fn a_scene_may_use_files_outside_its_folder() {
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("shared")).unwrap();
    for file in ["plate.obj", "plate.mtl"] {
        let own = sandbox.path("scenes/plate").join(file);
        fs::rename(own, sandbox.path("shared").join(file)).unwrap();
    }
    let absolute = sandbox.path("shared/plate.obj").display().to_string();
    for mesh in ["../../shared/plate.obj", &absolute] {
        sandbox.write("scene.toml", &SCENE.replace("plate.obj", mesh));
        sandbox.done(RENDER);
    }
}
