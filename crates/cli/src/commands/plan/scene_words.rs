//! Scenes as words of a job's command line.

use suite::{EngineScene, Error};
use tracer::SceneId;

use super::job::{files_below, path_word};
use crate::arguments::SceneArgs;
use crate::selection::{SceneChoice, select_engine_scenes, select_scenes};

/// A scene of a plan, in the order of the plan.
pub struct SceneWords {
    /// Word for `--scenes`.
    pub word: String,
    /// Identity, which no other scene of the plan has.
    pub id: SceneId,
    /// True if its frame and truths are rendered, and false if an engine drew them.
    pub is_rendered: bool,
    /// Its files on disk.
    pub files: Vec<String>,
}

/// Lists the scenes that are rendered, then those that engines drew.
pub fn list_scene_words(args: &SceneArgs) -> Result<Vec<SceneWords>, Error> {
    let (drawn, names) = select_engine_scenes(&args.root.scenes_dir, &args.names()?)?;
    let rendered = match drawn.is_empty() || !names.is_empty() {
        true => select_scenes(&args.root.scenes_dir, &names)?,
        false => Vec::new(),
    };
    let rendered = rendered.iter().map(|choice| words_of_scene(args, choice));
    rendered.chain(drawn.iter().map(words_of_drawn)).collect()
}

fn words_of_scene(args: &SceneArgs, choice: &SceneChoice) -> Result<SceneWords, Error> {
    let id = choice.scene.id.clone();
    let word = match args.root.scenes_dir.join(&id.name).path == choice.folder.path {
        true => id.to_string(),
        false => as_path(path_word(&choice.folder.path)?) + &id.choice(),
    };
    let files = (choice.folder.on_disk()).map_or(Ok(Vec::new()), files_below)?;
    Ok(SceneWords {
        word,
        id,
        is_rendered: true,
        files,
    })
}

fn words_of_drawn(scene: &EngineScene) -> Result<SceneWords, Error> {
    Ok(SceneWords {
        word: as_path(path_word(&scene.folder)?),
        id: scene.id.clone(),
        is_rendered: false,
        files: files_below(&scene.folder)?,
    })
}

/// Makes a word a path, which no name is taken for.
pub fn as_path(word: String) -> String {
    match word.contains(['/', '\\']) {
        true => word,
        false => format!("./{word}"),
    }
}
