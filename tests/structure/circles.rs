//! No module uses another that uses it, directly or through others: neither files nor folders.

use std::collections::BTreeSet;

use crate::modules::{Graph, Module, find_folder_graph, find_graph, read_modules};
use crate::sources;

/// Crates that still have circles. Each leaves the list with its last circle.
const OPEN: [&str; 4] = ["cli", "filters", "metrics", "tune"];

#[test]
fn no_crate_has_a_circle_of_modules() {
    let mut wrong = Vec::new();
    for folder in sources() {
        let name = folder
            .parent()
            .and_then(|it| it.file_name())
            .unwrap_or_default();
        let name = name.to_string_lossy();
        let graph = find_graph(&read_modules(&folder));
        let circles = [
            find_circles(&graph),
            find_circles(&find_folder_graph(&graph)),
        ]
        .concat();
        match (circles.is_empty(), OPEN.contains(&&*name)) {
            (true, true) => wrong.push(format!("{name} has no circle: take it from OPEN\n")),
            (false, false) => wrong.extend(circles.iter().map(|it| format!("{name}: {it}"))),
            _ => {}
        }
    }
    assert!(
        wrong.is_empty(),
        "modules that use each other; move what both need into a module of its own:\n{}",
        wrong.concat()
    );
}

/// Finds the circles, each with the uses that close it.
fn find_circles(graph: &Graph) -> Vec<String> {
    let mut done = BTreeSet::new();
    let mut circles = Vec::new();
    for module in graph.keys() {
        let mut circle = reach(graph, module);
        circle.retain(|it| reach(graph, it).contains(module));
        if circle.contains(module) && done.insert(circle.clone()) {
            circles.push(describe(graph, &circle));
        }
    }
    circles
}

/// Finds the modules that a module uses, directly or through others.
fn reach<'a>(graph: &'a Graph, from: &Module) -> BTreeSet<&'a Module> {
    let mut reached = BTreeSet::new();
    let mut open: Vec<&Module> = graph.get(from).into_iter().flatten().collect();
    while let Some(module) = open.pop() {
        if reached.insert(module) {
            open.extend(graph.get(module).into_iter().flatten());
        }
    }
    reached
}

fn describe(graph: &Graph, circle: &BTreeSet<&Module>) -> String {
    let name = |module: &Module| match module.is_empty() {
        true => "the root".to_owned(),
        false => module.join("/"),
    };
    let mut text = String::new();
    for module in circle {
        let used = graph[*module].iter().filter(|it| circle.contains(it));
        let used: Vec<String> = used.map(name).collect();
        text += &format!("  {} uses {}\n", name(module), used.join(", "));
    }
    format!("{} modules\n{text}", circle.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modules::Texts;

    /// Finds the circles of files and of folders in a crate of these files.
    fn find(files: &[(&str, &str)]) -> [Vec<String>; 2] {
        let texts: Texts = (files.iter())
            .map(|(name, text)| {
                let parts = name.split('/').filter(|part| !part.is_empty());
                (parts.map(str::to_owned).collect(), (*text).to_owned())
            })
            .collect();
        let graph = find_graph(&texts);
        [
            find_circles(&graph),
            find_circles(&find_folder_graph(&graph)),
        ]
    }

    #[test]
    fn a_circle_of_files_is_found() {
        let [files, folders] = find(&[
            ("", "mod a;\nmod b;\nmod c;\nuse a::A;\n"),
            ("a", "use crate::b::{self, B};\n"),
            ("b", "fn f() {\n    super::c::f();\n}\n"),
            (
                "c",
                "// The last one.\nuse std::fs;\n\nuse super::a::A as Other;\n",
            ),
        ]);
        let found = "3 modules\n  a uses b\n  b uses c\n  c uses a\n";
        assert_eq!(files, [found]);
        assert_eq!(folders, [found]);
    }

    #[test]
    fn a_circle_of_folders_is_found_where_no_files_form_one() {
        let [files, folders] = find(&[
            ("a/one", "use crate::b::one::One;\n"),
            ("a/two", ""),
            ("b/one", ""),
            ("b/two", "use crate::{\n    a::{two::Two},\n};\n"),
        ]);
        assert_eq!(files, [""; 0]);
        assert_eq!(folders, ["2 modules\n  a uses b\n  b uses a\n"]);
    }

    #[test]
    fn a_circle_through_a_re_export_is_found() {
        let [files, _] = find(&[
            (
                "",
                "mod a;\nmod b;\npub use a::inner::A;\npub(crate) use b::B as Renamed;\n",
            ),
            ("a", "mod inner;\n"),
            ("a/inner", "use crate::Renamed;\n"),
            ("b", "use crate::A;\n"),
        ]);
        assert_eq!(files, ["2 modules\n  a/inner uses b\n  b uses a/inner\n"]);
    }

    #[test]
    fn tests_and_re_exports_close_no_circle() {
        let [files, folders] = find(&[
            ("", "mod a;\nmod b;\npub use a::A;\n"),
            ("a", "use crate::b::B;\n"),
            (
                "b",
                "#[cfg(test)]\nuse crate::A;\n\n#[cfg(test)]\nmod tests {\n    use crate::a::A;\n}\n",
            ),
        ]);
        assert_eq!(files, [""; 0]);
        assert_eq!(folders, [""; 0]);
    }
}
