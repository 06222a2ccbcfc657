//! The modules of a crate and their uses of one another.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use crate::rust_files;
use crate::uses::find_uses;

/// Path of a module below its crate's root, in parts. The root has none.
pub type Module = Vec<String>;

/// Pairs of modules: a user, and the module that it uses.
pub type Pairs = BTreeSet<(Module, Module)>;

/// Sources of a crate by module.
pub type Texts = BTreeMap<Module, String>;

/// Reads the files of a crate.
pub fn read_modules(sources: &Path) -> Texts {
    let read = |path: PathBuf| {
        let below = path.strip_prefix(sources).expect("it is below");
        let stem = below.with_extension("");
        let mut module: Module = stem.iter().map(|part| part.display().to_string()).collect();
        module.pop_if(|last| ["mod", "lib", "main"].contains(&last.as_str()));
        (module, fs::read_to_string(&path).expect("sources are text"))
    };
    rust_files(sources).into_iter().map(read).collect()
}

/// Finds what each module uses. A name that another module re-exports counts as a use of its
/// original module; the re-export itself is no use.
pub fn find_pairs(texts: &Texts) -> Pairs {
    let (mut exports, mut uses) = (BTreeMap::new(), Vec::new());
    for (module, text) in texts {
        for import in find_uses(text) {
            match resolve(texts, module, &import.path) {
                Some(path) if import.is_export => {
                    exports.insert((module.clone(), import.name), path);
                }
                Some(path) => uses.push((module.clone(), path)),
                None => {}
            }
        }
    }
    let owner = |path| find_owner(texts, &exports, path);
    let pairs = uses.into_iter().map(|(module, path)| (module, owner(path)));
    pairs.filter(|(module, used)| module != used).collect()
}

/// Finds the path from the root; none for a path of another crate.
fn resolve(texts: &Texts, module: &Module, path: &[String]) -> Option<Module> {
    let (first, rest) = path.split_first()?;
    let climbs = path.iter().take_while(|part| *part == "super").count();
    match first.as_str() {
        "crate" => Some(rest.to_vec()),
        "self" => Some([module, rest].concat()),
        "super" => {
            let above = &module[..module.len().checked_sub(climbs)?];
            Some([above, &path[climbs..]].concat())
        }
        _ => {
            let is_child = texts.contains_key(&[&module[..], &path[..1]].concat());
            is_child.then(|| [module, path].concat())
        }
    }
}

/// Finds the module that a path leads to, following re-exports of its names.
fn find_owner(
    texts: &Texts,
    exports: &BTreeMap<(Module, String), Module>,
    mut path: Module,
) -> Module {
    let mut seen = BTreeSet::new();
    loop {
        let mut starts = (0..=path.len()).rev().map(|end| path.split_at(end));
        let start = starts.find(|(module, _)| texts.contains_key(*module));
        let (module, rest) = start.unwrap_or((&[], &path));
        let name = rest.first().map(|name| (module.to_vec(), name.clone()));
        let unseen = name.filter(|name| seen.insert(name.clone()));
        match unseen.and_then(|name| exports.get(&name)) {
            Some(origin) => path = [origin, &rest[1..]].concat(),
            None => return module.to_vec(),
        }
    }
}

/// Returns which folder, or file next to the root, uses which other.
pub fn find_folder_pairs(pairs: &Pairs) -> Pairs {
    let inner = |(module, used): &&(Module, Module)| !module.is_empty() && !used.is_empty();
    let folders = |(module, used): &(Module, Module)| (module[..1].to_vec(), used[..1].to_vec());
    let pairs = pairs.iter().filter(inner).map(folders);
    pairs.filter(|(folder, used)| folder != used).collect()
}
