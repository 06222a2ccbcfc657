//! From `scenes/<name>/scene.toml` and the OBJ, MTL and texture files that it names to a checked [`Scene`].
//!
//! The format is documented in `scenes/README.md`, with a complete example.

mod camera;
mod document;
mod environment;
mod error;
mod files;
mod finish;
mod light;
mod listing;
mod material;
mod mtl;
mod obj;
mod obj_check;
mod objects;
mod parents;
mod picture;
mod pose;
mod reach;
mod schema;
mod shapes;
mod shutter;
mod statements;
mod surfaces;
mod texture;
mod variants;

use std::path::{Path, PathBuf};

use document::Document;
pub use error::SceneError;
use error::hidden;
use files::Files;
pub use listing::{SceneListing, list_scene, list_scenes};
use objects::Stage;
use schema::SceneTable;
use variants::Parsed;

use crate::Scene;
use crate::limits::{LARGEST_SCENE_FILE, LARGEST_SIDE, MOST_PIXELS};

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
    let parsed = Parsed::of(&document)?;
    let table = parsed.scene(variant)?;
    parsed.check()?;
    check_frame(&document, &table)?;

    let shutter_profile = shutter::shutter_profile(&document, &table.shutter)?;
    let camera = camera::camera(&document, &table.camera)?;
    let background = light::background(&document, &mut files, folder, &table.background)?;
    let sun = table.sun.as_ref().map(|sun| light::sun(&document, sun));
    let display = light::display(&document, &table.display)?;
    let interval = rendered_interval(&table, shutter_profile.rolling);
    let mut stage = Stage::new(&document, folder, files, interval);
    stage.add_objects(&table.camera, &camera, &table.object)?;

    let [width, height] = *table.size.get_ref();
    let name = folder_name(folder)?;
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
        hash: stage.files.hash(variant),
    };
    Ok((scene, paths))
}

fn read_document(files: &mut Files, folder: &Path) -> Result<Document, SceneError> {
    let path = folder.join("scene.toml");
    let text = files.text(&path, LARGEST_SCENE_FILE).map_err(|error| {
        let reason = format!("cannot be read: {error}; a scene is a folder with a scene.toml");
        SceneError::file(&path, reason)
    })?;
    Ok(Document::new(&path, text))
}

/// The last part of the path; that of the full path where it is written as `.`.
fn folder_name(folder: &Path) -> Result<String, SceneError> {
    let full = match folder.file_name() {
        Some(_) => folder.to_owned(),
        None => folder.canonicalize().unwrap_or_default(),
    };
    let name = full.file_name().unwrap_or_default();
    let refused = |reason: String| {
        let reason =
            format!("the folder's name is the scene's, and it {reason}; rename the folder");
        Err(SceneError::file(folder, reason))
    };
    match name.to_str() {
        Some(name) => match hidden(name) {
            None => Ok(name.to_owned()),
            Some(reason) => refused(reason),
        },
        None => refused("is not Unicode".to_owned()),
    }
}

/// Times, in frames, of which a render may ask where things are: while the shutter is open, and a frame to either side.
fn rendered_interval(table: &SceneTable, rolling: f64) -> [f64; 2] {
    let longest = 1.0 + table.exposure.get_ref() + rolling.abs();
    [-longest, longest]
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
    let allowed = 1..=LARGEST_SIDE;
    if !allowed.contains(&width) || !allowed.contains(&height) {
        let reason =
            format!("size is [{width}, {height}]; allowed: 1 to {LARGEST_SIDE} pixels each");
        return Err(document.error(table.size.span(), reason));
    }
    let pixels = u64::from(width) * u64::from(height);
    if pixels > MOST_PIXELS {
        let reason = format!(
            "size is [{width}, {height}], {pixels} pixels; allowed: {MOST_PIXELS}; give a smaller size"
        );
        return Err(document.error(table.size.span(), reason));
    }
    if table.object.is_empty() {
        let reason = "no objects; a scene needs at least one [object.name] with a mesh";
        return Err(SceneError::file(&document.path, reason));
    }
    Ok(())
}
