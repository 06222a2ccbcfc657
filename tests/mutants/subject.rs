//! A filter preset and its mutants.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};

use cli::{Programs, select_filters};
use suite::{Error, FilterChoice};
use tempfile::TempDir;
use tests::filter_folder::{copy_changed_filter, shipped_filter};
use tests::mutants::{Mutant, choose_mutants};
use tracer::SceneId;

use crate::journal::Place;

/// Upper limit on the seconds of a mutant's pass. A shipped one takes less than one.
const TIME_LIMIT: f64 = 20.0;

pub struct Subject {
    /// Filter and preset: `mcguire:paper`.
    pub name: String,
    /// Name of these kernels in the journal: another text has other mutants.
    pub key: String,
    /// File of the kernels, below the repository.
    pub file: String,
    pub kernels: String,
    pub sound: FilterChoice,
    /// Mutants that naga accepts.
    pub mutants: Vec<MutantFilter>,
}

pub struct MutantFilter {
    pub mutant: Mutant,
    /// Description of the change, with its line.
    pub name: String,
    pub choice: FilterChoice,
    /// Its files, which a run copies.
    _folder: TempDir,
}

impl Subject {
    pub fn place(&self, name: &str, scene: &SceneId) -> Place {
        (self.key.clone(), name.to_owned(), scene.to_string())
    }

    pub fn sound_place(&self, scene: &SceneId, seed: u64) -> Place {
        self.place(&format!("seed {seed}"), scene)
    }

    /// Loads a filter preset, and chooses up to `count` of the mutants that naga accepts.
    pub fn new(name: &str, count: usize) -> Result<Self, Error> {
        let sound = select(name)?;
        let filter = sound.filter.name.clone();
        let folder = shipped_filter(&filter);
        let read = |path| fs::read_to_string(path).expect("a shipped filter can be read");
        let kernels = read(folder.join(&filter).with_extension("wgsl"));
        let mut hasher = DefaultHasher::new();
        (&kernels, read(folder.join("filter.toml"))).hash(&mut hasher);
        let accepted: Vec<Mutant> = (Mutant::all(&kernels).into_iter())
            .filter(|mutant| load_mutant(&filter, &sound.preset, mutant).is_ok())
            .collect();
        let chosen = choose_mutants(&accepted, count).into_iter();
        let mutants = chosen.map(|mutant| {
            let (choice, folder) = load_mutant(&filter, &sound.preset, &mutant)?;
            Ok(MutantFilter {
                name: mutant.describe(&kernels),
                choice,
                _folder: folder,
                mutant,
            })
        });
        Ok(Self {
            name: name.to_owned(),
            key: format!("{name} {:016x}", hasher.finish()),
            file: format!("shaders/{filter}/{filter}.wgsl"),
            mutants: mutants.collect::<Result<_, Error>>()?,
            kernels,
            sound,
        })
    }
}

fn select(name: &str) -> Result<FilterChoice, Error> {
    let mut choices = select_filters(&[name.to_owned()], None, &[], Programs::Refused)?;
    match choices.len() {
        1 => Ok(choices.remove(0)),
        _ => Err(Error::Usage(format!(
            "--filters {name}: name the preset as well, such as mcguire:paper"
        ))),
    }
}

/// Loads a mutant from a folder that is there as long as the second value.
fn load_mutant(
    filter: &str,
    preset: &str,
    mutant: &Mutant,
) -> Result<(FilterChoice, TempDir), Error> {
    let folder = tempfile::tempdir().expect("temporary folders can be made");
    let copy = folder.path().join(filter);
    copy_changed_filter(filter, &copy, |text| mutant.apply(text));
    let mut choice = select(&format!("{}:{preset}", copy.display()))?;
    choice.filter.time_limit = TIME_LIMIT;
    Ok((choice, folder))
}
