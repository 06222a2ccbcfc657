//! Checks that bounds name scenes and filters that exist, and that every case has a bound.

use filters::Filter;
use measure::{Error, FilterChoice, Frames};
use scene::{Location, SceneId};

use crate::bounds::sized::read_all_bounds;
use crate::bounds::{BOUNDS_FILE, BoundsFile, Level, SceneBounds};

/// Refuses bounds of a scene or a filter that does not exist, in any file below `root` and in
/// `scenes`, the bounds of the run's scenes.
pub fn check_names<'a>(
    root: impl Into<Location>,
    scenes: impl Iterator<Item = &'a SceneBounds>,
    filters: &[FilterChoice],
) -> Result<(), Error> {
    let of_scenes = read_bounds_of_scenes(&root.into())?;
    let files = of_scenes
        .iter()
        .chain(scenes.flat_map(|bounds| &bounds.files));
    let mut tables = files.flat_map(|file| &file.filters);
    tables.try_for_each(|(name, table)| {
        check_filter(name, filters)
            .map_err(|reason| Error::Refused(format!("{}: {reason}", table.place)))
    })
}

/// Refuses a case without a bound, and bounds without any required one, since such a check cannot
/// fail. `scenes` are the scenes and the bounds of scenes in the folder `root`; `frames` are the
/// measured frames of each scene: limits on sequences of another length judge nothing.
pub fn require_bounds<'a>(
    root: impl Into<Location>,
    scenes: impl Iterator<Item = (&'a SceneId, &'a SceneBounds)>,
    filters: &[FilterChoice],
    frames: Frames,
) -> Result<(), Error> {
    let root = root.into();
    let mut required = false;
    for (scene, bounds) in scenes {
        for choice in filters {
            let mut bounds = bounds.of(&choice.filter.name, &choice.preset);
            let length = bounds.values().find_map(|bound| bound.length);
            bounds.retain(|_, bound| bound.length.is_none_or(|length| length.holds_for(frames)));
            let name = choice.name();
            let reason = match length {
                _ if !bounds.is_empty() => None,
                Some(length) => Some(format!(
                    "all its bounds are on sequences of other lengths, such as {}, and none would be checked; check as many \
                     frames, or bound a score of single frames",
                    length.text()
                )),
                None => Some(format!(
                    "has no bound, and a check needs one; give it some in {root}/{BOUNDS_FILE} or beside the scene, under \
                     [default] or [filter.\"{name}\"]"
                )),
            };
            if let Some(reason) = reason {
                return Err(Error::Refused(format!("{scene} / {name}: {reason}")));
            }
            required |= (bounds.values()).any(|bound| bound.level == Level::Required);
        }
    }
    if required {
        return Ok(());
    }
    let names: Vec<String> = filters.iter().map(FilterChoice::name).collect();
    Err(Error::Refused(format!(
        "{root}/{BOUNDS_FILE}: no bound of {} is required, so that nothing could fail; give them bounds with level = \
         \"required\" under [filter.\"..\"]",
        names.join(", ")
    )))
}

/// Reads the bounds of every scene below `root`, for every picture size, judged or not.
fn read_bounds_of_scenes(root: &Location) -> Result<Vec<BoundsFile>, Error> {
    // `root` need not exist if every scene is given by its path.
    let mut folders = root.list().unwrap_or_default();
    folders.sort_by(|a, b| a.path.cmp(&b.path));
    let mut files = read_all_bounds(root)?;
    for folder in folders.iter().filter(|folder| folder.is_dir()) {
        let bounds = read_all_bounds(folder)?;
        if !bounds.is_empty() && !folder.join("scene.toml").is_file() {
            return Err(Error::Refused(format!(
                "{}: bounds of a scene that does not exist: {} has no scene.toml; rename the folder as the scene, or remove \
                 the bounds",
                bounds[0].path.display(),
                folder
            )));
        }
        files.extend(bounds);
    }
    Ok(files)
}

/// Refuses a key `filter` or `filter:preset` that is neither built in nor in the run.
fn check_filter(key: &str, choices: &[FilterChoice]) -> Result<(), String> {
    let (name, preset) = match key.split_once(':') {
        Some((name, preset)) => (name, Some(preset)),
        None => (key, None),
    };
    let taking_part = choices.iter().map(|choice| &choice.filter);
    let built_in = Filter::builtin(name).ok();
    let known: Vec<&Filter> = (taking_part.filter(|filter| filter.name == name))
        .chain(&built_in)
        .collect();
    if known.is_empty() {
        let mut names = Filter::builtin_names();
        names.extend(choices.iter().map(|choice| choice.filter.name.clone()));
        names.sort();
        names.dedup();
        return Err(format!(
            "no filter is called \"{name}\"; allowed: {}, and filters of your own that take part",
            names.join(", ")
        ));
    }
    let presets: Vec<&str> = (known.iter().flat_map(|filter| &filter.presets))
        .map(|preset| preset.name.as_str())
        .collect();
    match preset {
        Some(preset) if !presets.contains(&preset) => Err(format!(
            "the filter {name} has no preset \"{preset}\"; allowed: {}",
            presets.join(", ")
        )),
        _ => Ok(()),
    }
}
