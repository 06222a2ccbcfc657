//! The command `engine export`.

use std::path::PathBuf;

use clap::Args;
use measure::{Error, PROGRAM, printable_path};
use terminal::arguments::RootArgs;
use terminal::output::print;
use terminal::refuse;
use terminal::selection::select_scenes;

use crate::export::{Manifest, export_gltf};
use crate::ingest::check_subframe_count;

/// Arguments of `engine export`.
#[derive(Debug, Args)]
pub struct ExportArgs {
    /// Scenes: names, folders or patterns such as 'rail*', each with an optional @variant or @all.
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<String>,
    /// Folder of scenes.
    #[command(flatten)]
    pub root: RootArgs,
    /// Folder for glTF 2.0: each scene gets one of its own there.
    #[arg(long, value_name = "DIR", default_value = "out/gltf")]
    pub gltf: PathBuf,
    /// Write SCENE@unlit: flat emissive colours and no lights. An engine's picture of it can be
    /// compared with the truth directly.
    #[arg(long)]
    pub unlit: bool,
    /// Sub-frames to draw; manifest.json has their times.
    #[arg(long, value_name = "N", default_value_t = 32)]
    pub subframes: u32,
}

/// Writes each scene as glTF, and prints its path and the frame's time in the animation.
pub fn execute(args: &ExportArgs) -> Result<(), Error> {
    let subframes = args.subframes;
    if let Err(allowed) = check_subframe_count(subframes as usize) {
        refuse!("--subframes {subframes}: allowed: {allowed}; 32 are usual");
    }
    let names = if args.unlit {
        let names = args.scenes.iter().map(|name| unlit_name(name));
        names.collect::<Result<_, _>>()?
    } else {
        args.scenes.clone()
    };
    let choices = select_scenes(&args.root.scenes_dir, &names)?;
    let mut text = String::new();
    for choice in &choices {
        let folder = args.gltf.join(choice.scene.id.folder());
        let manifest = export_gltf(&choice.scene, &choice.folder, PROGRAM, &folder, subframes)?;
        text += &describe(&manifest, &printable_path(&folder));
    }
    print(&text)
}

/// Names the unlit variant of a scene.
fn unlit_name(name: &str) -> Result<String, Error> {
    if name.contains('@') {
        refuse!(
            "--unlit: {name} is a variant; allowed: scenes in their default variant, which `unlit` is a variant of"
        )
    } else {
        Ok(format!("{name}@unlit"))
    }
}

fn describe(manifest: &Manifest, folder: &str) -> String {
    let [open, close] = manifest.shutter["centred"];
    format!(
        "{}: {} objects; the frame is at {:.6} s, the one before at {:.6} s, a centred shutter is open from {open:.6} to \
         {close:.6} s\nwritten: {folder}/scene.gltf, scene.bin, sky.exr, manifest.json, capture.toml\n",
        manifest.scene,
        manifest.objects.len() - 1,
        manifest.instant,
        manifest.previous,
    )
}
