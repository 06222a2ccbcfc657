//! No function is longer than a screen.

use std::fs;

use crate::{rust_files, sources};

/// Most lines of a function, from its name to its last bracket.
const MAX_LINES: usize = 60;

/// Longer functions that read better whole.
const EXCEPTIONS: &[(&str, &str)] = &[
    ("crates/metrics/src/sequence/reference.rs", "measure"),
    ("crates/bvh/src/tree.rs", "traverse"),
    ("crates/scene/src/load/mod.rs", "load_scene_and_files"),
    ("crates/tracer/src/path/integrator.rs", "follow_path"),
];

#[test]
fn no_function_is_longer_than_a_screen() {
    let mut wrong = String::new();
    let mut unused = EXCEPTIONS.to_vec();
    for path in sources().iter().flat_map(|folder| rust_files(folder)) {
        let text = fs::read_to_string(&path).expect("sources are text");
        let path = path.display().to_string();
        let (_, file) = path.split_once("../").expect("it is below the repository");
        for (line, name, lines) in find_functions(&text) {
            let known = unused.iter().position(|known| *known == (file, name));
            match known {
                _ if lines <= MAX_LINES => {}
                Some(at) => drop(unused.remove(at)),
                None => wrong += &format!("{file}:{line}: {name} has {lines} lines\n"),
            }
        }
    }
    assert!(
        wrong.is_empty(),
        "functions of more than {MAX_LINES} lines; split them, or name them in EXCEPTIONS if they read better whole:\n{wrong}"
    );
    assert!(unused.is_empty(), "take {unused:?} from EXCEPTIONS");
}

/// Words allowed before `fn`.
const WORDS: &str = "pub pub(crate) pub(super) async const unsafe extern \"C\"";

/// Finds the line, name and length of each function with a body; rustfmt puts its last bracket
/// below its beginning.
fn find_functions(text: &str) -> Vec<(usize, &str, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut functions = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let code = line.trim_start();
        let indent = &line[..line.len() - code.len()];
        let Some((before, after)) = code.split_once("fn ") else {
            continue;
        };
        let mut words = before.split_whitespace();
        if !words.all(|word| WORDS.split(' ').any(|known| known == word)) {
            continue;
        }
        let is_end = |line: &&str| {
            let code = line.strip_prefix(indent).unwrap_or_default();
            code == "}"
                || code.starts_with(|c: char| !c.is_whitespace()) && code.ends_with([';', '}'])
        };
        let end = lines[at..].iter().position(is_end);
        let name = after.split(['(', '<']).next().unwrap_or_default();
        functions.extend(end.map(|end| (at + 1, name, end + 1)));
    }
    functions
}

const SAMPLE: &str = "\
trait Shape {
    fn area(
        &self,
    ) -> f32;
}

pub(crate) fn long<T>(value: T)
where
    T: Copy,
{
    if value.is_some() {
        inner();
    }
}

fn short() {}
";

#[test]
fn functions_are_found_with_their_lengths() {
    let functions = [(2, "area", 3), (7, "long", 8), (16, "short", 1)];
    assert_eq!(find_functions(SAMPLE), functions);
}
