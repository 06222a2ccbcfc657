//! Copies of the built-in scenes, for `list --copy-to`.

use std::path::Path;
use terminal::refuse;

use frame::{FileError, write_atomically};
use measure::{Error, printable_path};
use scene::{Location, list_scenes};

use terminal::output::{count_text, print};
use terminal::selection::choose_names;

/// Writes the named built-in scenes, or all, and their bounds below `out`. Overwrites nothing.
pub fn copy_scenes(names: &[String], out: &Path) -> Result<(), Error> {
    let names: &[String] = if names == ["scenes"] { &[] } else { names };
    let listings = list_scenes(Location::of_bundle(&catalogue::SCENES))?;
    let known: Vec<String> = listings.into_iter().map(|listing| listing.name).collect();
    let scenes = choose_names("--copy-to", names, &known)?;
    if let Some(folder) =
        (scenes.iter().map(|scene| out.join(scene))).find(|folder| folder.exists())
    {
        refuse!(
            "--copy-to: {} exists; allowed: new scenes; name other scenes or another folder",
            folder.display()
        );
    }
    let fail = |source| FileError::io(out, "write", source);
    std::fs::create_dir_all(out).map_err(fail)?;
    // A killed copy leaves no half scene: each is written elsewhere, and then moved as a whole.
    let whole = tempfile::Builder::new()
        .prefix(".shuttertruth-")
        .suffix(".tmp")
        .tempdir_in(out);
    let whole = whole.map_err(fail)?;
    let mut text = String::new();
    for path in (catalogue::SCENES.list)() {
        let unpack = || (catalogue::SCENES.unpack)(path).expect("the bundle lists its files");
        match path.split_once('/') {
            Some((scene, _)) if scenes.iter().any(|chosen| chosen == scene) => {
                write_atomically(&whole.path().join(path), &unpack())?;
            }
            Some(_) => {}
            None if out.join(path).exists() => {
                text += &format!("kept: {}\n", printable_path(&out.join(path)));
            }
            None => write_atomically(&out.join(path), &unpack())?,
        }
    }
    for scene in &scenes {
        std::fs::rename(whole.path().join(scene), out.join(scene)).map_err(fail)?;
    }
    let count = count_text(scenes.len(), "scene", "scenes");
    text += &format!("written: {} ({count})\n", printable_path(out));
    print(&text)
}
