//! Selection of scenes.

use std::path::Path;

use filters::Filter;
use measure::{Error, IngestedScene};
use scene::{Location, Scene, SceneId, list_scene, list_scenes, load_scene};

use super::names::{is_path, match_names, refuse_empty_names, suggest_names};

/// A loaded scene and the folder that it came from.
pub struct SceneChoice {
    /// Folder of scene.toml, and of bounds.toml if the scene has its own bounds.
    pub folder: Location,
    /// The scene.
    pub scene: Scene,
}

/// Loads the named scenes, or all of `root` in their default variants.
///
/// A name is a folder under `root`, a pattern of such names, or the path of any scene folder, with
/// an optional `@variant`; `@all` selects every variant.
pub fn select_scenes(
    root: impl Into<Location>,
    names: &[String],
) -> Result<Vec<SceneChoice>, Error> {
    let root = &root.into();
    refuse_empty_names("scenes", names)?;
    // If every scene is given by its path, `root` need not exist.
    let listings = match !names.is_empty() && names.iter().all(|name| is_path(name)) {
        true => Vec::new(),
        false if root.is_dir() => list_scenes(root)?,
        false => refuse!(
            "{root}: there is no such folder of scenes; name one with --scenes-dir, or give a scene by its path"
        ),
    };
    if names.is_empty() {
        return listings
            .iter()
            .map(|listing| load_choice(&listing.folder, &SceneId::default()))
            .collect();
    }
    let known: Vec<String> = listings.into_iter().map(|listing| listing.name).collect();
    let mut scenes: Vec<SceneChoice> = Vec::new();
    for text in names {
        let (name, id) = split_scene(text);
        for folder in find_folders(root, name, &known)? {
            match id.variant.as_deref() {
                Some(ALL) => scenes.extend(load_all_variants(&folder, &id)?),
                _ => scenes.push(load_choice(&folder, &id)?),
            }
        }
    }
    refuse_twins((scenes.iter()).map(|scene| (&scene.scene.id, scene.folder.clone())))?;
    Ok(scenes)
}

/// Reads the ingested scenes among the named ones; returns the other names as well. A
/// scene of `root` has priority over a folder of the same name elsewhere.
pub fn select_ingested_scenes(
    root: &Location,
    names: &[String],
) -> Result<(Vec<IngestedScene>, Vec<String>), Error> {
    let is_ingested = |name: &&String| {
        (is_path(name) || !root.join(name).is_dir()) && IngestedScene::is_in(Path::new(name))
    };
    let (ingested, others): (Vec<&String>, Vec<&String>) = names.iter().partition(is_ingested);
    let scenes: Vec<IngestedScene> = (ingested.into_iter())
        .map(|name| IngestedScene::read(Path::new(name)))
        .collect::<Result<_, _>>()?;
    refuse_twins(
        scenes
            .iter()
            .map(|scene| (&scene.id, Location::from(&scene.folder))),
    )?;
    Ok((scenes, others.into_iter().cloned().collect()))
}

/// Finds the folders of a name, a pattern or a path. A scene of `root` has priority over a folder
/// of the same name elsewhere.
fn find_folders(root: &Location, name: &str, known: &[String]) -> Result<Vec<Location>, Error> {
    let matched = match_names("scenes", name, known)?;
    if !matched.is_empty() && !is_path(name) {
        return Ok(matched.iter().map(|name| root.join(name)).collect());
    }
    if let Some(option) = other_option(name) {
        refuse!("{name} is no scene; give it with {option} {name}");
    }
    if is_path(name) || Path::new(name).is_dir() {
        return Ok(vec![Path::new(name).into()]);
    }
    refuse!(
        "no scene \"{name}\" in {root}; {}{} A scene elsewhere is named by its path, such as ./{name}",
        suggest_names(name, known),
        suggest_built_in(root, name)
    )
}

/// Finds the option for a filter or a finished run; none for other names.
fn other_option(name: &str) -> Option<&'static str> {
    let filter = name.rsplit_once(':').map_or(name, |(filter, _)| filter);
    let is_built_in = (Filter::builtin_names().iter()).any(|known| known == filter);
    let (path, filter) = (Path::new(name), Path::new(filter));
    if is_built_in || filter.join("filter.toml").is_file() {
        Some("--filter")
    } else if path.join("run.json").is_file() || path.ends_with("run.json") {
        Some("check --run")
    } else {
        None
    }
}

/// Explains how to get a built-in scene that another folder of scenes hides.
fn suggest_built_in(root: &Location, name: &str) -> &'static str {
    let built_in = Location::of_bundle(&catalogue::SCENES).join(name);
    if root.bundle.is_none() && built_in.is_dir() {
        " The program brings one along: --scenes-dir built-in."
    } else {
        ""
    }
}

/// Splits a text into a scene's name or path, and its identity. Parent folders may have an @ in
/// their names.
pub fn split_scene(text: &str) -> (&str, SceneId) {
    let name = text.trim_end_matches(['/', '\\']);
    let start = name.rfind(['/', '\\']).map_or(0, |separator| separator + 1);
    match name[start..].split_once('@') {
        Some((folder, choice)) => (
            &name[..start + folder.len()],
            SceneId::new(folder, Some(choice)),
        ),
        None => (text, SceneId::new(&name[start..], None)),
    }
}

/// Word for all variants of a scene.
const ALL: &str = "all";

/// Loads every variant of the scene in a folder, at the frame rate of `all` if it has one.
fn load_all_variants(folder: &Location, all: &SceneId) -> Result<Vec<SceneChoice>, Error> {
    let variants = list_scene(folder)?.variants;
    if variants.is_empty() {
        refuse!("scenes: {folder} has no variants for @all; name the scene without it");
    }
    let of_variant = |variant| SceneId {
        variant: Some(variant),
        ..all.clone()
    };
    (variants.into_iter())
        .map(|variant| load_choice(folder, &of_variant(variant)))
        .collect()
}

/// Refuses two scenes of one name: both would share a folder and count twice.
fn refuse_twins<'a>(scenes: impl Iterator<Item = (&'a SceneId, Location)>) -> Result<(), Error> {
    let mut known: Vec<(&SceneId, Location)> = Vec::new();
    for (name, folder) in scenes {
        if let Some((_, other)) = known.iter().find(|(other, _)| *other == name) {
            refuse!(
                "scenes: {name} is named twice, as {other} and {folder}; allowed: each name once; rename one of the folders, or \
                 run them into two --out folders"
            );
        }
        known.push((name, folder));
    }
    Ok(())
}

fn load_choice(folder: &Location, id: &SceneId) -> Result<SceneChoice, Error> {
    let name = folder
        .path
        .file_name()
        .unwrap_or_default()
        .to_string_lossy();
    if name.contains('@') {
        refuse!(
            "scenes: the folder {folder} cannot name a scene; allowed: names without @, which begins a variant; rename it"
        );
    }
    if folder.on_disk().is_some_and(IngestedScene::is_in) {
        refuse!(
            "scenes: {folder} holds what an engine drew, and nothing to render; `run` and `check` measure it"
        );
    }
    Ok(SceneChoice {
        folder: folder.clone(),
        scene: load_scene(folder, id.choice().strip_prefix('@'))?,
    })
}
