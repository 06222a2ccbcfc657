//! The modules of a crate and what each uses of the others.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::rust_files;
use crate::uses::{Use, find_uses};

/// Path of a module below its crate's root: `["load", "mtl"]`. The root has none.
pub type Module = Vec<String>;

/// For each module, the modules that it uses.
pub type Graph = BTreeMap<Module, BTreeSet<Module>>;

/// Sources of a crate by module.
pub type Texts = BTreeMap<Module, String>;

/// Reads the files of a crate.
pub fn read_modules(sources: &Path) -> Texts {
    let text = |path: &Path| fs::read_to_string(path).expect("sources are text");
    let module = |path: &Path| {
        let below = path.strip_prefix(sources).expect("it is below");
        let parts = below.with_extension("");
        let mut parts: Module = parts.iter().map(|it| it.display().to_string()).collect();
        parts.pop_if(|last| ["mod", "lib", "main"].contains(&last.as_str()));
        parts
    };
    let files = rust_files(sources);
    files
        .iter()
        .map(|path| (module(path), text(path)))
        .collect()
}

/// Finds what each module uses. A name that another module re-exports counts as a use of the module that it comes from; the
/// re-export itself is no use.
pub fn find_graph(texts: &Texts) -> Graph {
    let uses: Vec<(&Module, Use)> = (texts.iter())
        .flat_map(|(module, text)| find_uses(text).into_iter().map(move |own| (module, own)))
        .collect();
    let resolve = |module: &Module, path: &[String]| resolve(texts, module, path);
    let mut exports = BTreeMap::new();
    for (module, own) in uses.iter().filter(|(_, own)| own.is_export) {
        if let Some(path) = resolve(module, &own.path) {
            exports.insert(((*module).clone(), own.name.clone()), path);
        }
    }
    let mut graph: Graph = texts
        .keys()
        .map(|it| (it.clone(), BTreeSet::new()))
        .collect();
    for (module, own) in uses.iter().filter(|(_, own)| !own.is_export) {
        if let Some(path) = resolve(module, &own.path) {
            let owner = find_owner(texts, &exports, path);
            graph.entry((*module).clone()).or_default().insert(owner);
        }
    }
    for (module, used) in &mut graph {
        used.remove(module);
    }
    graph
}

/// Finds the path from the root; none for a path of another crate.
fn resolve(texts: &Texts, module: &Module, path: &[String]) -> Option<Module> {
    let (first, rest) = path.split_first()?;
    let climbs = path.iter().take_while(|it| *it == "super").count();
    let is_child =
        || texts.contains_key(&[module.as_slice(), std::slice::from_ref(first)].concat());
    match first.as_str() {
        "crate" => Some(rest.to_vec()),
        "self" => Some([module, rest].concat()),
        "super" => {
            let above = &module[..module.len().checked_sub(climbs)?];
            Some([above, &path[climbs..]].concat())
        }
        _ if is_child() => Some([module, path].concat()),
        _ => None,
    }
}

/// Finds the module that a path leads to, along the re-exports of its names.
fn find_owner(
    texts: &Texts,
    exports: &BTreeMap<(Module, String), Module>,
    mut path: Module,
) -> Module {
    let mut seen = BTreeSet::new();
    loop {
        let parts = (0..=path.len())
            .rev()
            .find(|end| texts.contains_key(&path[..*end]));
        let (module, rest) = path.split_at(parts.unwrap_or(0));
        let next = rest.first().map(|name| (module.to_vec(), name.clone()));
        match next
            .filter(|next| seen.insert(next.clone()))
            .and_then(|next| exports.get(&next))
        {
            Some(origin) => path = [origin, &rest[1..]].concat(),
            None => return module.to_vec(),
        }
    }
}

/// Returns what each folder, or file beside the root, uses of the others.
pub fn find_folder_graph(graph: &Graph) -> Graph {
    let mut folders = Graph::new();
    for (module, used) in graph {
        for other in used {
            if let (Some(own), Some(other)) = (module.first(), other.first())
                && own != other
            {
                let used = folders.entry(vec![own.clone()]).or_default();
                used.insert(vec![other.clone()]);
            }
        }
    }
    folders
}
