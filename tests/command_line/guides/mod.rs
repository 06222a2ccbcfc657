//! Every command of every page, run in the order of the page. `make guides` runs these tests.

mod page;
mod reader;
mod tables;

use std::fs;
use std::time::Instant;

use crate::bench::{stderr, stdout};
use crate::links::{find_pages, root};
use page::{Step, find_steps};
use reader::Reader;

/// Commands that are not run, and why.
const NOT_RUN: [(&str, &str); 12] = [
    ("cargo test --workspace", "runs this test and all others"),
    (
        "cargo install --path crates/cli",
        "compiles the program again",
    ),
    (
        "cargo install --locked --path crates/cli",
        "compiles the program again",
    ),
    (
        "cargo test -p tests --test rendering furnace",
        "a part of `make test`",
    ),
    (
        "cargo test -p cli --test command_line check",
        "a part of `make test`",
    ),
    (
        "cargo test --locked -p cli --test fuzz",
        "a part of `make test`",
    ),
    (
        "cargo test -p tests --test scoring decoy_matrix -- --nocapture",
        "a part of `make test`",
    ),
    ("cargo bench -p tracer", "compiles in release mode"),
    ("cargo bench -p tracer -- none", "compiles in release mode"),
    (
        "cargo run -p generator",
        "writes the scenes of the checkout",
    ),
    ("pip install numpy OpenEXR", "installs packages"),
    (
        "shuttertruth report --gallery",
        "names an option, and is not complete",
    ),
];

/// What the reader of a page has when he comes to a command: the page, the beginning of the command, and a line of shell that
/// makes it.
const PREPARED: [(&str, &str, &str); 10] = [
    (
        "README.md",
        "shuttertruth import",
        "cp scenes/fan/fan.mtl . && cp scenes/fan/fan.obj my_model.obj",
    ),
    ("README.md", "shuttertruth compare", "cp -r out before"),
    (
        "README.md",
        "shuttertruth score",
        "cp out/fan/truth_trailing.exr truth.exr && cp out/fan/frame.exr . && cp out/fan/identity_default/output.png mine.png",
    ),
    (
        "docs/add-a-filter.md",
        "shuttertruth score",
        "cp out/fan/my_blur_default/output.exr mine.exr",
    ),
    (
        "docs/ci.md",
        "shuttertruth accept --out out",
        "cp -r checked out",
    ),
    (
        "docs/ci.md",
        "shuttertruth compare",
        "cp -r checked before && cp -r checked after",
    ),
    (
        "docs/truths.md",
        "shuttertruth merge",
        "shuttertruth render --scenes fan --replicates 1..2 --size 96x54 --samples-per-pixel 16 --out part1",
    ),
    (
        "crates/suite/README.md",
        "shuttertruth check",
        "shuttertruth check --filter mcguire:paper --scenes fan",
    ),
    (
        "scenes/README.md",
        "shuttertruth report",
        "shuttertruth run --scenes fan --size 96x54 --samples-per-pixel 16",
    ),
    (
        "scenes/README.md",
        "shuttertruth import",
        "cp scenes/fan/fan.mtl . && cp scenes/fan/fan.obj my_model.obj",
    ),
];

/// Beginnings of commands that build, or that need what a test has not, and what is run instead.
const REPLACED: [(&str, &str); 3] = [
    (
        "cargo run --release --bin shuttertruth -- ",
        "shuttertruth ",
    ),
    ("make ", "make --dry-run "),
    ("python3 ", "\"${PYTHON:-python3}\" -B "),
];

/// Options that make a command quick, whatever value the page gives them; each is added to the commands that are named.
///
/// `check` and `calibrate` are as the page has them: bounds hold for one size, and few samples decide nothing.
const QUICK: [(&str, &str, &[&str]); 5] = [
    (
        "--size",
        "96x54",
        &["run", "render", "bench", "tune", "compare-presets"],
    ),
    (
        "--samples-per-pixel",
        "16",
        &["run", "render", "tune", "compare-presets"],
    ),
    ("--budget", "6", &["tune"]),
    ("--rows", "2", &[]),
    ("--noise", "0.05", &[]),
];

/// Options that are added to a command where the page leaves them out, and means all scenes or filters.
const NARROWED: [(&str, &str, &[&str]); 2] = [
    ("--scenes", "fan", &["run", "check", "tune"]),
    ("--filter", "mcguire:paper", &["bench"]),
];

/// Makes a command of a page quick.
fn shorten(command: &str) -> String {
    let mut line = command.to_owned();
    for (beginning, other) in REPLACED {
        if let Some(rest) = line.strip_prefix(beginning) {
            line = format!("{other}{rest}");
        }
    }
    let Some(words) = line.strip_prefix("shuttertruth ") else {
        return line;
    };
    let mut words: Vec<String> = words.split(' ').map(str::to_owned).collect();
    let command = words[0].clone();
    let named = |commands: &[&str]| commands.contains(&command.as_str());
    for (option, value, commands) in QUICK {
        match words.iter().position(|word| word == option) {
            Some(at) if !named(&["check", "calibrate"]) => words[at + 1] = value.to_owned(),
            None if named(commands) => words.extend([option, value].map(str::to_owned)),
            _ => {}
        }
    }
    // Held-out scenes have a size of their own.
    let mut held_out = ["--sealed", "--held-out"].into_iter();
    if let Some(option) = held_out.find(|option| words.iter().any(|word| word == option)) {
        words.extend([format!("{option}-size"), "96x54".to_owned()]);
        words.extend([format!("{option}-samples-per-pixel"), "16".to_owned()]);
    }
    // A finished run has its scenes.
    let finished = words.iter().any(|word| word.ends_with("run.json"));
    for (option, value, commands) in NARROWED {
        if named(commands) && !finished && !words.iter().any(|word| word == option) {
            words.extend([option, value].map(str::to_owned));
        }
    }
    format!("shuttertruth {}", words.join(" "))
}

/// Lists the pages, by their paths in the repository, with what their readers do.
fn read_pages() -> Vec<(String, Vec<Step>)> {
    let pages = find_pages(&root()).into_iter().map(|path| {
        let name = path.strip_prefix(root()).unwrap().display().to_string();
        (name, find_steps(&fs::read_to_string(path).unwrap()))
    });
    pages.filter(|(_, steps)| !steps.is_empty()).collect()
}

/// Finds the line of shell that makes what a command needs.
fn find_prepared(page: &str, command: &str) -> Option<&'static str> {
    let mut all = PREPARED.iter();
    let found = all.find(|(of, beginning, _)| *of == page && command.starts_with(beginning));
    found.map(|(_, _, line)| *line)
}

fn is_left_out(command: &str) -> bool {
    NOT_RUN.iter().any(|(left_out, _)| *left_out == command)
}

#[test]
fn every_exception_is_a_command_of_a_page() {
    let pages = read_pages();
    let commands: Vec<(&str, &str)> = (pages.iter())
        .flat_map(|(page, steps)| steps.iter().map(move |step| (page.as_str(), step)))
        .filter_map(|(page, step)| match step {
            Step::Run(command) => Some((page, command.as_str())),
            Step::Write { .. } => None,
        })
        .collect();
    assert!(
        commands.len() > 60,
        "only {} commands were found",
        commands.len()
    );
    for (left_out, _) in NOT_RUN {
        let shown = commands.iter().any(|(_, command)| *command == left_out);
        assert!(shown, "no page shows the exception \"{left_out}\"");
    }
    for (page, beginning, _) in PREPARED {
        let shown =
            (commands.iter()).any(|(of, command)| *of == page && command.starts_with(beginning));
        assert!(shown, "{page} has no command \"{beginning} ..\"");
    }
}

/// Runs a command; returns what is wrong with its end.
fn fail(reader: &Reader, page: &str, command: &str) -> Option<String> {
    let start = Instant::now();
    let output = reader.run(command);
    let seconds = start.elapsed().as_secs_f64();
    eprintln!("{seconds:6.1} s  {page}: {command}");
    let said = || format!("{}{}", stdout(&output), stderr(&output));
    let ended = || {
        format!(
            "{page}: {command}\nends with {}:\n{}",
            output.status,
            said()
        )
    };
    (!output.status.success()).then(ended)
}

#[test]
#[ignore = "takes many minutes: `make guides` runs it"]
fn every_command_of_the_pages_ends_with_exit_code_0() {
    let mut failed = Vec::new();
    for (page, steps) in read_pages() {
        let reader = Reader::new();
        for step in steps {
            match step {
                Step::Write { path, text } => reader.write(&path, &text),
                Step::Run(command) if is_left_out(&command) => {}
                Step::Run(command) => {
                    if let Some(line) = find_prepared(&page, &command) {
                        failed.extend(fail(&reader, &page, line));
                    }
                    failed.extend(fail(&reader, &page, &shorten(&command)));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
