//! `shuttertruth render`

use suite::{Error, frame_of, scene_folder, select_scenes, truth_of};

use super::{render_settings, say};
use crate::cli::RenderArgs;

/// Renders each scene's frame and its truths, and says where they are.
pub fn execute(args: &RenderArgs) -> Result<(), Error> {
    for choice in select_scenes(&args.scenes.scenes_dir, &args.scenes.scenes)? {
        let scene = choice.scene;
        let size = args.size.unwrap_or((scene.width, scene.height));
        let settings = render_settings(&args.scenes, size)?;
        let (out, quiet) = (&args.scenes.out, args.scenes.quiet);
        frame_of(&scene, &settings, out, quiet)?;
        for alignment in &args.alignments {
            truth_of(&scene, &settings, *alignment, out, quiet)?;
        }
        say(&format!("{}\n", scene_folder(out, &scene).display()))?;
    }
    Ok(())
}
