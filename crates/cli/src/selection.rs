//! Scenes and filters that the words of a command name.

use std::path::{Path, PathBuf};

use filters::Filter;
use tracer::{Scene, list_scene, list_scenes, load_scene};

use suite::{Error, FilterChoice};

/// Whether filters that are programs may be selected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Programs {
    /// Whoever calls has allowed to run them, or does not run them.
    Allowed,
    /// A filter folder may come from anybody: none of them runs.
    Refused,
}

/// A loaded scene and the folder that it came from.
pub struct SceneChoice {
    /// Holds scene.toml, and bounds.toml if the scene has bounds of its own.
    pub folder: PathBuf,
    /// The scene.
    pub scene: Scene,
}

/// Loads the named scenes; all of `root`, each in its default variant, where none is named.
///
/// A word is the name of a folder under `root` or the path of any scene folder, then optionally `@variant`; `@all` takes
/// every variant.
pub fn select_scenes(root: &Path, words: &[String]) -> Result<Vec<SceneChoice>, Error> {
    // Where every scene is given by its path, `root` need not exist.
    let listings = match !words.is_empty() && words.iter().all(|word| is_path(word)) {
        true => Vec::new(),
        false => list_scenes(root)?,
    };
    if words.is_empty() {
        return listings
            .iter()
            .map(|listing| load(&listing.folder, None))
            .collect();
    }
    let mut scenes: Vec<SceneChoice> = Vec::new();
    for word in words {
        let (name, variant) = parted(word);
        let known = listings.iter().find(|listing| listing.name == name);
        let folder = match known {
            Some(listing) => listing.folder.clone(),
            None if is_path(name) => PathBuf::from(name),
            None => {
                let names: Vec<&str> = listings
                    .iter()
                    .map(|listing| listing.name.as_str())
                    .collect();
                return Err(Error::Usage(format!(
                    "--scenes: no scene \"{name}\" in {}; allowed: {}, or the path of a scene folder, such as ./{name}",
                    root.display(),
                    names.join(", ")
                )));
            }
        };
        match variant {
            Some("all") => scenes.extend(all_variants(&folder)?),
            _ => scenes.push(load(&folder, variant)?),
        }
    }
    refuse_twins(&scenes)?;
    Ok(scenes)
}

/// A word without its variant, and the variant. Folders above the scene's own may have an @ in their names.
fn parted(word: &str) -> (&str, Option<&str>) {
    let name = word.trim_end_matches(['/', '\\']);
    let own = name.rfind(['/', '\\']).map_or(0, |separator| separator + 1);
    match name[own..].split_once('@') {
        Some((folder, variant)) => (&name[..own + folder.len()], Some(variant)),
        None => (word, None),
    }
}

/// Every variant of the scene in a folder.
fn all_variants(folder: &Path) -> Result<Vec<SceneChoice>, Error> {
    let variants = list_scene(folder)?.variants;
    if variants.is_empty() {
        return Err(Error::Usage(format!(
            "--scenes: {} has no variants for @all; name the scene without it",
            folder.display()
        )));
    }
    (variants.iter())
        .map(|variant| load(folder, Some(variant)))
        .collect()
}

/// Refuses two scenes of one name: both would be written to one folder and counted as two.
fn refuse_twins(scenes: &[SceneChoice]) -> Result<(), Error> {
    for (index, scene) in scenes.iter().enumerate() {
        let name = &scene.scene.name;
        let mut before = scenes[..index].iter();
        if let Some(twin) = before.find(|twin| twin.scene.name == *name) {
            return Err(Error::Usage(format!(
                "--scenes: {name} is named twice, as {} and {}; allowed: each name once; rename one of the folders, or \
                 run them into two --out folders",
                twin.folder.display(),
                scene.folder.display()
            )));
        }
    }
    Ok(())
}

fn load(folder: &Path, variant: Option<&str>) -> Result<SceneChoice, Error> {
    let own = folder.file_name().unwrap_or_default().to_string_lossy();
    if own.contains('@') {
        return Err(Error::Usage(format!(
            "--scenes: the folder {} cannot name a scene; allowed: names without @, which stands before a variant; rename it",
            folder.display()
        )));
    }
    Ok(SceneChoice {
        folder: folder.to_owned(),
        scene: load_scene(folder, variant)?,
    })
}

/// Loads the named filters; every built-in one where none is named.
///
/// A word is the name of a built-in filter or the path of a filter folder, then optionally `:preset`. Without a preset, in
/// the word or for all, each preset of the filter is taken. `overrides` are `filter.parameter=value`. Filters that are
/// programs are refused unless `programs` allows them.
pub fn select_filters(
    words: &[String],
    preset: Option<&str>,
    overrides: &[String],
    programs: Programs,
) -> Result<Vec<FilterChoice>, Error> {
    let words = if words.is_empty() {
        Filter::builtin_names()
    } else {
        words.to_vec()
    };
    let mut choices: Vec<FilterChoice> = Vec::new();
    for word in &words {
        let (name, own_preset) = match word.rsplit_once(':') {
            Some((name, preset)) if !preset.contains(['/', '\\']) => (name, Some(preset)),
            _ => (word.as_str(), None),
        };
        let load = || match is_path(name) {
            true => Filter::load(Path::new(name)),
            false => Filter::builtin(name),
        };
        let presets = match own_preset.or(preset) {
            Some(preset) => vec![preset.to_owned()],
            None => load()?
                .presets
                .into_iter()
                .map(|preset| preset.name)
                .collect(),
        };
        for preset in presets {
            choices.push(FilterChoice::new(load()?, &preset)?);
        }
    }
    if programs == Programs::Refused {
        refuse_programs(&choices)?;
    }
    for text in overrides {
        apply_override(&mut choices, text)?;
    }
    refuse_twin_filters(&choices)?;
    Ok(choices)
}

fn refuse_programs(choices: &[FilterChoice]) -> Result<(), Error> {
    match choices.iter().find_map(|it| it.filter.command.as_ref()) {
        None => Ok(()),
        Some(command) => Err(Error::Usage(format!(
            "{}:{}: the filter is a program and would run `{}`; read what that does, and allow it with --allow-commands",
            command.manifest.display(),
            command.line,
            command.words().join(" ")
        ))),
    }
}

/// Refuses a preset that is named twice, or two filters of one name: both would be written to one folder and counted as two.
fn refuse_twin_filters(choices: &[FilterChoice]) -> Result<(), Error> {
    for (index, choice) in choices.iter().enumerate() {
        let name = choice.name();
        if choices[..index].iter().any(|twin| twin.name() == name) {
            return Err(Error::Usage(format!(
                "--filters: {name} is named twice; allowed: each filter and preset once; give a folder of your own \
                 another name in its filter.toml"
            )));
        }
    }
    Ok(())
}

fn apply_override(choices: &mut [FilterChoice], text: &str) -> Result<(), Error> {
    let parts = text.split_once('=').and_then(|(place, value)| {
        place
            .split_once('.')
            .map(|(filter, parameter)| (filter, parameter, value))
    });
    let Some((name, parameter, value)) = parts else {
        return Err(Error::Usage(format!(
            "--set {text}: allowed is filter.parameter=value, such as jump_flood.samples=16"
        )));
    };
    let mut found = false;
    for choice in choices
        .iter_mut()
        .filter(|choice| choice.filter.name == name)
    {
        choice.settings.set(&choice.filter, parameter, value)?;
        found = true;
    }
    if found {
        return Ok(());
    }
    let mut names: Vec<&str> = choices
        .iter()
        .map(|choice| choice.filter.name.as_str())
        .collect();
    names.dedup();
    Err(Error::Usage(format!(
        "--set {text}: no filter \"{name}\" takes part; allowed: {}",
        names.join(", ")
    )))
}

/// A path has a separator; a word without one is a name, whatever lies in the current folder.
fn is_path(word: &str) -> bool {
    word.contains(['/', '\\'])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_at_stands_before_a_variant_only_in_the_last_name() {
        for (word, name, variant) in [
            ("fan", "fan", None),
            ("fan@fast", "fan", Some("fast")),
            ("./me@home/fan", "./me@home/fan", None),
            ("./me@home/fan@fast", "./me@home/fan", Some("fast")),
            ("me@home/fan@fast/", "me@home/fan", Some("fast")),
        ] {
            assert_eq!(parted(word), (name, variant), "{word}");
        }
    }
}
