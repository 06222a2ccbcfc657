//! Command-line words of jobs: this command line's options, scenes, and filters.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command};
use filters::Filter;
use suite::{Error, RunPlan};
use tracer::SceneId;

use crate::arguments::MeasureArgs;
use crate::selection::{select_engine_scenes, select_scenes};

/// Options that are part of the words of scenes and filters, or that no job gets.
const LEFT_OUT: [&str; 8] = [
    "seal",
    "frame-rate",
    "shutter-time",
    "preset",
    "set",
    "truths",
    "no-cache",
    "json",
];

/// Makes words from a fixed number of texts.
pub fn words<const N: usize>(words: [&str; N]) -> Vec<String> {
    words.map(str::to_owned).to_vec()
}

/// Adds the options of this command line that the command with arguments `A` also has and `job` lacks.
pub fn push_given<A: Args>(job: &mut Vec<String>, given: &ArgMatches) -> Result<(), Error> {
    let own = job.clone();
    for option in A::augment_args(Command::new("job")).get_arguments() {
        let id = option.get_id().as_str();
        let Some(long) = option.get_long().filter(|long| !LEFT_OUT.contains(long)) else {
            continue;
        };
        let word = format!("--{long}");
        let is_given = given.try_contains_id(id).unwrap_or(false)
            && given.value_source(id) == Some(ValueSource::CommandLine);
        if !is_given || own.contains(&word) {
            continue;
        }
        if !option.get_action().takes_values() {
            job.push(word);
            continue;
        }
        for value in given.get_raw(id).into_iter().flatten() {
            job.extend([word.clone(), as_text(value.to_owned())?]);
        }
    }
    Ok(())
}

/// Lists the words of this command line after its name, without the plan's own options.
pub fn words_behind() -> Result<Vec<String>, Error> {
    let all = std::env::args_os().skip_while(|word| word != "plan");
    let mut all = all.skip(1).map(as_text);
    let mut words = Vec::new();
    while let Some(word) = all.next().transpose()? {
        match word.as_str() {
            "--parts" => drop(all.next()),
            "--json" => {}
            other if other.starts_with("--parts=") => {}
            _ => words.push(word),
        }
    }
    Ok(words)
}

/// Writes a path as a word.
pub fn path_word(path: &Path) -> Result<String, Error> {
    as_text(path.as_os_str().to_owned())
}

fn as_text(word: OsString) -> Result<String, Error> {
    word.into_string().map_err(|word| {
        Error::Usage(format!(
            "{}: is not UTF-8, which the command line of a job must be; rename it",
            word.display()
        ))
    })
}

/// Writes a folder as a word that cannot be mistaken for a name.
fn folder_word(folder: &Path) -> Result<String, Error> {
    let word = path_word(folder)?;
    Ok(match word.contains(['/', '\\']) {
        true => word,
        false => format!("./{word}"),
    })
}

/// Lists the regular files in and below a folder in order, as inputs of a job.
fn files_below(folder: &Path) -> Result<Vec<String>, Error> {
    let fail = |source| frame::FileError::io(folder, "read", source);
    let mut entries: Vec<PathBuf> = (std::fs::read_dir(folder).map_err(fail)?)
        .map(|entry| Ok(entry.map_err(fail)?.path()))
        .collect::<Result<_, Error>>()?;
    entries.sort();
    let mut files = Vec::new();
    for entry in entries.into_iter().filter(|entry| !entry.is_symlink()) {
        if entry.is_dir() {
            files.extend(files_below(&entry)?);
        } else if entry.is_file() {
            files.push(path_word(&entry)?);
        }
    }
    Ok(files)
}

/// A scene of a plan.
#[derive(Clone)]
pub struct SceneWords {
    /// Word for `--scenes`.
    pub word: String,
    /// Identity, unique in the plan.
    pub id: SceneId,
    /// True if its frame and truths are rendered, false if an engine drew them.
    pub is_rendered: bool,
    /// Its files on disk.
    pub files: Vec<String>,
}

/// Lists the scenes in the plan's order: rendered ones, then those that engines drew.
pub fn list_scene_words(args: &MeasureArgs, plan: &RunPlan) -> Result<Vec<SceneWords>, Error> {
    let scenes = &args.scenes;
    let root = &scenes.root.scenes_dir;
    let mut all = Vec::new();
    if !plan.scenes.is_empty() {
        let (_, names) = select_engine_scenes(root, &scenes.names()?)?;
        for choice in select_scenes(root, &names)? {
            let id = choice.scene.id;
            all.push(SceneWords {
                word: match root.join(&id.name).path == choice.folder.path {
                    true => id.to_string(),
                    false => folder_word(&choice.folder.path)? + &id.choice(),
                },
                id,
                is_rendered: true,
                files: (choice.folder.on_disk()).map_or(Ok(Vec::new()), files_below)?,
            });
        }
    }
    for scene in &plan.engine_scenes {
        all.push(SceneWords {
            word: folder_word(&scene.folder)?,
            id: scene.id.clone(),
            is_rendered: false,
            files: files_below(&scene.folder)?,
        });
    }
    Ok(all)
}

/// Some presets of one filter for one job.
#[derive(Clone)]
pub struct FilterWords {
    /// Name of the job's folder, unique in the plan.
    pub name: String,
    /// Its presets and overrides as options.
    pub options: Vec<String>,
    /// Number of presets.
    pub presets: usize,
    /// Files of a user's own filter.
    pub files: Vec<String>,
}

/// Groups a plan's presets by filter, in the plan's order.
pub fn list_filter_words(args: &MeasureArgs, plan: &RunPlan) -> Result<Vec<FilterWords>, Error> {
    let place = |filter: &Filter| (filter.name.clone(), filter.folder.clone());
    let groups = (plan.filters).chunk_by(|one, other| place(&one.filter) == place(&other.filter));
    let mut names: Vec<&String> = Vec::new();
    let mut all = Vec::new();
    for group in groups {
        let Filter { name, folder, .. } = &group[0].filter;
        let base = (folder.as_deref()).map_or(Ok(name.clone()), folder_word)?;
        let presets = group
            .iter()
            .map(|choice| format!("{base}:{}", choice.preset));
        let mut options: Vec<String> = Vec::new();
        presets.for_each(|preset| options.extend(words(["--filter", &preset])));
        for set in &args.set {
            if set.split('.').next() == Some(name) {
                options.extend(words(["--set", set]));
            }
        }
        all.push(FilterWords {
            name: match names.iter().filter(|other| **other == name).count() {
                0 => name.clone(),
                before => format!("{name}+{before}"),
            },
            options,
            presets: group.len(),
            files: (folder.as_deref()).map_or(Ok(Vec::new()), files_below)?,
        });
        names.push(name);
    }
    Ok(all)
}
