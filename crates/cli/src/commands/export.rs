//! The command `export`.

use engine::{Manifest, export_gltf};
use store::printable_path;
use suite::{Error, PROGRAM};

use crate::arguments::ExportArgs;
use crate::output::print::print;
use crate::selection::select_scenes;

/// Writes each scene as glTF and prints where, and at which time of the animation the frame is.
pub fn execute(args: &ExportArgs) -> Result<(), Error> {
    let names = match args.unlit {
        true => (args.scenes.iter())
            .map(|name| unlit_name(name))
            .collect::<Result<_, _>>()?,
        false => args.scenes.clone(),
    };
    let choices = select_scenes(&args.scenes_dir, &names)?;
    let mut text = String::new();
    for choice in &choices {
        let folder = args.gltf.join(&choice.scene.name);
        let manifest = export_gltf(&choice.scene, &choice.folder, PROGRAM, &folder)?;
        text += &describe(&manifest, &printable_path(&folder));
    }
    print(&text)
}

/// Names the unlit variant of a scene.
fn unlit_name(name: &str) -> Result<String, Error> {
    match name.contains('@') {
        false => Ok(format!("{name}@unlit")),
        true => Err(Error::Usage(format!(
            "--unlit: {name} is a variant; allowed: scenes in their default variant, which `unlit` is a variant of"
        ))),
    }
}

fn describe(manifest: &Manifest, folder: &str) -> String {
    let [open, close] = manifest.shutter["centred"];
    format!(
        "{}: {} objects; the frame is at {:.6} s, the one before at {:.6} s, a centred shutter is open from {open:.6} to \
         {close:.6} s\nwritten: {folder}/scene.gltf, scene.bin, sky.exr, manifest.json\n",
        manifest.scene,
        manifest.objects.len() - 1,
        manifest.instant,
        manifest.previous,
    )
}
