//! No module uses another that uses it, directly or through others: neither files nor folders.

use std::collections::BTreeSet;

use crate::modules::{Module, Pairs, Texts, find_folder_pairs, find_pairs, read_modules};
use crate::sources;

#[test]
fn no_crate_has_a_circle_of_modules() {
    let mut wrong = String::new();
    for folder in sources() {
        for circles in find_all_circles(&read_modules(&folder)) {
            for line in circles.lines() {
                wrong += &format!("{}: {line}\n", folder.display());
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "modules that use each other; move what both need into a module of its own:\n{wrong}"
    );
}

/// Finds the circles of files, and those of folders.
fn find_all_circles(texts: &Texts) -> [String; 2] {
    let pairs = find_pairs(texts);
    let of_folders = find_folder_pairs(&pairs);
    [&pairs, &of_folders].map(find_circles)
}

/// Finds the circles, each with the uses that close it.
fn find_circles(pairs: &Pairs) -> String {
    let mut circles = BTreeSet::new();
    for (module, _) in pairs {
        let mut circle = reach(pairs, module);
        circle.retain(|member| reach(pairs, member).contains(module));
        circles.insert(circle);
    }
    let texts = circles.iter().map(|circle| describe(pairs, circle));
    texts.collect()
}

/// Finds the modules that a module uses, directly or through others.
fn reach<'a>(pairs: &'a Pairs, from: &'a Module) -> BTreeSet<&'a Module> {
    let mut reached = BTreeSet::new();
    let mut open = vec![from];
    while let Some(module) = open.pop() {
        let from_here = pairs.range((module.clone(), Module::new())..);
        let used = from_here
            .take_while(|pair| pair.0 == *module)
            .map(|pair| &pair.1);
        open.extend(used.filter(|module| reached.insert(*module)));
    }
    reached
}

/// Lists the uses between modules; the root's name is empty.
fn describe(pairs: &Pairs, circle: &BTreeSet<&Module>) -> String {
    let inner =
        |(module, used): &&(Module, Module)| circle.contains(module) && circle.contains(used);
    let line = |(module, used): &(Module, Module)| {
        format!("{} uses {}\n", module.join("/"), used.join("/"))
    };
    pairs.iter().filter(inner).map(line).collect()
}

/// Crates with the circles of their files and of their folders. `//// NAME` begins a file.
const ROWS: [[&str; 3]; 4] = [
    [
        "//// \nmod a;\nmod b;\nmod c;\nuse a::A;
//// a\nuse crate::b::{self, B};
//// b\nfn f() {\n    super::c::f();\n}
//// c\n// The last one.\nuse std::fs;\n\nuse super::a::A as Other;\n",
        "a uses b\nb uses c\nc uses a\n",
        "a uses b\nb uses c\nc uses a\n",
    ],
    // Folders form a circle where no files do.
    [
        "//// a/one\nuse crate::b::one::One;
//// a/two\n
//// b/one\n
//// b/two\nuse crate::{\n    a::{two::Two},\n};\n",
        "",
        "a uses b\nb uses a\n",
    ],
    // A circle through a re-export.
    [
        "//// \nmod a;\nmod b;\npub use a::inner::A;\npub(crate) use b::B as Renamed;
//// a\nmod inner;
//// a/inner\nuse crate::Renamed;
//// b\nuse crate::A;\n",
        "a/inner uses b\nb uses a/inner\n",
        "a uses b\nb uses a\n",
    ],
    // Tests and re-exports close no circle.
    [
        "//// \nmod a;\nmod b;\npub use a::A;
//// a\nuse crate::b::B;
//// b\n#[cfg(test)]\nuse crate::A;\n\n#[cfg(test)]\nmod tests {\n    use crate::a::A;\n}\n",
        "",
        "",
    ],
];

#[test]
fn circles_of_files_and_of_folders_are_found() {
    for [files, of_files, of_folders] in ROWS {
        let parts = files
            .split("//// ")
            .filter_map(|part| part.split_once('\n'));
        let module = |name: &str| name.split_terminator('/').map(str::to_owned).collect();
        let texts = parts.map(|(name, text)| (module(name), text.to_owned()));
        let circles = find_all_circles(&texts.collect());
        assert_eq!(circles, [of_files, of_folders]);
    }
}
