//! Copies of the built-in scenes, for `list --copy-to`.

use std::path::Path;

use frame::write_atomically;
use store::printable_path;
use suite::Error;
use tracer::{Location, list_scenes};

use crate::output::{count_text, print};
use crate::selection::choose_names;

/// Writes the named built-in scenes, or all, and their bounds below `out`. Overwrites nothing.
pub fn copy_scenes(names: &[String], out: &Path) -> Result<(), Error> {
    let names: &[String] = if names == ["scenes"] { &[] } else { names };
    let listings = list_scenes(Location::of_bundle(&catalogue::SCENES))?;
    let known: Vec<String> = listings.into_iter().map(|own| own.name).collect();
    let scenes = choose_names("--copy-to", names, &known)?;
    if let Some(folder) = (scenes.iter().map(|own| out.join(own))).find(|own| own.exists()) {
        refuse!(
            "--copy-to: {} exists; allowed: new scenes; name other scenes or another folder",
            folder.display()
        );
    }
    let is_chosen = |path: &&str| {
        (path.split_once('/')).is_none_or(|(scene, _)| scenes.iter().any(|own| own == scene))
    };
    let mut text = String::new();
    for path in (catalogue::SCENES.list)().into_iter().filter(is_chosen) {
        let to = out.join(path);
        if to.exists() {
            text += &format!("kept: {}\n", printable_path(&to));
            continue;
        }
        let bytes = (catalogue::SCENES.unpack)(path).expect("the bundle lists its files");
        write_atomically(&to, &bytes)?;
    }
    let count = count_text(scenes.len(), "scene", "scenes");
    text += &format!("written: {} ({count})\n", printable_path(out));
    print(&text)
}
