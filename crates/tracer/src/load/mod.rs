//! From `scenes/<name>/scene.toml` and the OBJ, MTL and texture files that it names to a checked [`Scene`].
//!
//! The format is documented in `scenes/README.md`, with a complete example.

mod camera;
mod document;
mod environment;
mod error;
mod faces;
mod files;
mod finish;
mod light;
mod listing;
mod material;
mod mtl;
mod obj;
mod obj_check;
mod objects;
mod pose;
mod schema;
mod shapes;
mod shutter;
mod statements;
mod texture;

use std::path::{Path, PathBuf};

use document::Document;
pub use error::SceneError;
pub use faces::MOST_COINCIDENT;
use files::Files;
pub use listing::{SceneListing, list_scenes};
use objects::Stage;
use schema::SceneTable;

use crate::Scene;

/// Largest width and height of a picture, in pixels.
const LARGEST_SIZE: u32 = 16384;

/// Loads the scene in `folder`, with the changes of one of its variants or as it is.
///
/// Refuses whatever a render could not use, and says where it stands and what is allowed; repairs nothing.
pub fn load_scene(folder: &Path, variant: Option<&str>) -> Result<Scene, SceneError> {
    load_scene_and_files(folder, variant).map(|(scene, _)| scene)
}

/// The same, and where the files lie that it was made from: its scene.toml and all that is named there, and by those.
pub fn load_scene_and_files(
    folder: &Path,
    variant: Option<&str>,
) -> Result<(Scene, Vec<PathBuf>), SceneError> {
    let mut files = Files::new(folder);
    let document = read_document(&mut files, folder)?;
    let table = document.scene(variant)?;
    // A slip in a variant shows at once, not only when somebody chooses it.
    for name in document.variants()? {
        document.scene(Some(&name))?;
    }
    check_frame(&document, &table)?;

    let shutter_profile = shutter::shutter_profile(&document, &table.shutter)?;
    let camera = camera::camera(&document, &table.camera)?;
    let background = light::background(&document, &mut files, folder, &table.background)?;
    let sun = table.sun.as_ref().map(|sun| light::sun(&document, sun));
    let display = light::display(&document, &table.display)?;
    let mut stage = Stage::new(&document, folder, files);
    stage.add_objects(&table.object)?;
    let notes = faces::tidy(&mut stage.meshes, &stage.objects)?;

    let [width, height] = *table.size.get_ref();
    let name = folder_name(folder);
    let paths = stage.files.paths();
    let scene = Scene {
        name: variant.map_or(name.clone(), |variant| format!("{name}@{variant}")),
        exposes: table.exposes.into_inner(),
        family: table.family,
        exposure: table.exposure.into_inner(),
        shutter_profile,
        width,
        height,
        display,
        camera,
        background,
        sun: sun.transpose()?,
        meshes: stage.meshes,
        textures: stage.textures.decoded,
        materials: stage.materials,
        objects: stage.objects,
        notes,
        hash: stage.files.hash(variant),
    };
    Ok((scene, paths))
}

fn read_document(files: &mut Files, folder: &Path) -> Result<Document, SceneError> {
    let path = folder.join("scene.toml");
    let text = files.text(&path).map_err(|error| {
        let reason = format!("cannot be read: {error}; a scene is a folder with a scene.toml");
        SceneError::file(&path, reason)
    })?;
    Ok(Document::new(&path, text))
}

/// The last part of the path; that of the full path where it is written as `.`.
fn folder_name(folder: &Path) -> String {
    let full = match folder.file_name() {
        Some(_) => folder.to_owned(),
        None => folder.canonicalize().unwrap_or_default(),
    };
    let name = full.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// What concerns the picture as a whole.
fn check_frame(document: &Document, table: &SceneTable) -> Result<(), SceneError> {
    if table.exposes.get_ref().trim().is_empty() {
        let reason = "exposes is empty; say in one sentence what the scene exposes";
        return Err(document.error(table.exposes.span(), reason));
    }
    frame::Alignment::Trailing
        .shutter(*table.exposure.get_ref())
        .map_err(|error| document.error(table.exposure.span(), error.to_string()))?;
    let [width, height] = *table.size.get_ref();
    let allowed = 1..=LARGEST_SIZE;
    if !allowed.contains(&width) || !allowed.contains(&height) {
        let reason =
            format!("size is [{width}, {height}]; allowed: 1 to {LARGEST_SIZE} pixels each");
        return Err(document.error(table.size.span(), reason));
    }
    if table.object.is_empty() {
        let reason = "no objects; a scene needs at least one [object.name] with a mesh";
        return Err(SceneError::file(&document.path, reason));
    }
    Ok(())
}
