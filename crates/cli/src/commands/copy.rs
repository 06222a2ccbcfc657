//! The command `copy`.

use std::path::PathBuf;

use clap::Args;
use frame::write_atomically;
use store::printable_path;
use suite::Error;
use tracer::{Location, list_scenes};

use crate::output::{count_text, print};
use crate::selection::choose_names;

#[derive(Debug, Args)]
pub struct CopyArgs {
    /// Built-in scenes: names, or patterns such as 'rail*' [default: all].
    #[arg(value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Folder to write. A scene that exists there is refused; a bounds.toml that exists there is kept.
    #[arg(short, long, value_name = "DIR", default_value = "scenes")]
    pub out: PathBuf,
}

/// Writes the folders of the chosen scenes, and the bounds of all scenes. Overwrites nothing.
pub fn execute(args: &CopyArgs) -> Result<(), Error> {
    let listings = list_scenes(Location::of_bundle(&catalogue::SCENES))?;
    let known: Vec<String> = listings.into_iter().map(|own| own.name).collect();
    let scenes = choose_names("copy", &args.scenes, &known)?;
    if let Some(folder) = (scenes.iter().map(|own| args.out.join(own))).find(|own| own.exists()) {
        refuse!(
            "copy: {} exists; allowed: new scenes; name other scenes, or another folder with --out",
            folder.display()
        );
    }
    let is_chosen = |path: &&str| {
        (path.split_once('/')).is_none_or(|(scene, _)| scenes.iter().any(|own| own == scene))
    };
    let mut text = String::new();
    for path in (catalogue::SCENES.list)().into_iter().filter(is_chosen) {
        let to = args.out.join(path);
        if to.exists() {
            text += &format!("kept: {}\n", printable_path(&to));
            continue;
        }
        let bytes = (catalogue::SCENES.unpack)(path).expect("the bundle lists its files");
        write_atomically(&to, &bytes)?;
    }
    let count = count_text(scenes.len(), "scene", "scenes");
    text += &format!("written: {} ({count})\n", printable_path(&args.out));
    print(&text)
}
