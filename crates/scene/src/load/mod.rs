//! The loader of scenes: from a scene.toml, and the OBJ, MTL and picture files that it names, to a
//! checked [`Scene`].
//!
//! `scenes/README.md` documents the format, with a complete example.

mod camera;
mod display;
mod document;
mod environment;
mod error;
mod face_lines;
mod faces;
mod files;
mod finish;
mod key_shapes;
mod keyed_motion;
mod libraries;
mod light;
mod listing;
mod map_options;
mod material;
mod material_list;
mod mesh_sources;
mod meshes;
mod mtl;
mod obj;
mod obj_fault;
mod obj_text;
mod object_motion;
mod objects;
mod outline;
mod parents;
mod picture;
mod rotation;
mod scale;
mod schema;
mod shutter;
mod statements;
mod texture;
mod transform_range;
mod translucency;
mod triangulation;
mod values;
mod variants;

use std::path::PathBuf;

use frame::Size;

pub use error::SceneError;
use files::{Files, folder_name, read_document};
pub use listing::{SceneListing, list_scene, list_scenes};
use meshes::MeshLoader;
use objects::ObjectLoader;
use schema::SceneTable;
use variants::ParsedScene;

use crate::{Display, FrameRate, Location, Scene, SceneId, Seal};

/// Variant that every scene has without naming it: its surfaces send out their own colours.
const UNLIT: &str = "unlit";

/// Loads the scene in `folder`, on disk or in a [`Bundle`](crate::Bundle), or one of its variants.
/// The variants `unlit` and `seal7`, with any seed, can be made from any scene. So can those at
/// another [`FrameRate`], such as `144fps` or `unlit@24fps_1-48s`.
///
/// Refuses whatever a render could not use, with its place and what is allowed; repairs nothing.
pub fn load_scene(folder: impl Into<Location>, variant: Option<&str>) -> Result<Scene, SceneError> {
    load_scene_and_files(folder, variant).map(|(scene, _)| scene)
}

/// Loads a scene, and returns it with the paths of all files that it was made from.
pub fn load_scene_and_files(
    folder: impl Into<Location>,
    variant: Option<&str>,
) -> Result<(Scene, Vec<PathBuf>), SceneError> {
    let folder = folder.into();
    let mut files = Files::new(&folder);
    let folder = folder.path.as_path();
    let document = read_document(&mut files, folder)?;
    let parsed = ParsedScene::parse(&document)?;
    let id = SceneId::new(folder_name(folder)?, variant);
    let rate = id.rate.unwrap_or_default();
    if let Err(reason) = rate.check() {
        return Err(SceneError::in_file(&document.path, reason));
    }
    let from_file = id.variant.as_deref();
    let has_variant = |name: &str| parsed.variant_names().iter().any(|known| known == name);
    let is_unlit = from_file == Some(UNLIT) && !has_variant(UNLIT);
    let table = parsed.read(from_file.filter(|_| !is_unlit))?;
    parsed.check_variants()?;
    if table.object.is_empty() {
        let reason = "no objects; a scene needs at least one [object.name] with a mesh";
        return Err(SceneError::in_file(&document.path, reason));
    }
    let shutter_profile = table.shutter.as_ref().map(|shutter| shutter.0.clone());
    let shutter_profile = shutter_profile.unwrap_or_default();
    let camera = camera::read_camera(&table.camera).map_err(|slip| document.locate(slip))?;
    let background = light::read_background(&document, &mut files, folder, &table.background)?;
    let sun = table.sun.as_ref().map(light::read_sun).transpose();
    let sun = sun.map_err(|slip| document.locate(slip))?;
    let interval = rendered_interval(&table, shutter_profile.rolling, id.seal.is_some(), rate);
    let meshes = MeshLoader::new(&document, folder, files, interval);
    let mut loader = ObjectLoader::new(&document, meshes, interval);
    loader.add_objects(&table.camera, &camera, &table.object)?;
    let ObjectLoader {
        objects,
        mut meshes,
        ..
    } = loader;
    let mut notes: Vec<String> = meshes.notes.into_iter().collect();
    notes.extend(faces::remove_redundant_faces(&mut meshes.meshes, &objects)?);

    let Size { width, height } = table.size.0;
    let paths = meshes.files.paths();
    let scene = Scene {
        exposes: table.exposes.0,
        family: table.family,
        exposure: table.exposure.0,
        written_exposure: table.exposure.0,
        shutter_profile,
        width,
        height,
        display: Display::from(&table.display),
        camera,
        background,
        sun,
        meshes: meshes.meshes,
        textures: meshes.textures.decoded,
        materials: meshes.materials.list,
        objects,
        notes,
        hash: meshes.files.hash(variant),
        id,
    };
    let scene = match scene.id.seal {
        _ if is_unlit => scene.unlit(),
        Some(seed) => Seal::new(seed, &scene.id.name).apply(scene),
        None => scene,
    };
    Ok((scene.at_rate(rate), paths))
}

/// Finds the times, in frames of the file, that a render may ask for: those of an open shutter, and
/// a frame to either side.
fn rendered_interval(
    table: &SceneTable,
    rolling: f64,
    is_sealed: bool,
    rate: FrameRate,
) -> [f64; 2] {
    let frames = rate.frames_per_written_frame();
    let longest = (1.0 + rate.exposure(table.exposure.0)) / frames + rolling.abs();
    let longest = if is_sealed {
        Seal::farthest(longest)
    } else {
        longest
    };
    [-longest, longest]
}
