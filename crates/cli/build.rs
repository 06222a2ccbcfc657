//! Sets the program's version, with the commit and target of the build.

use std::path::Path;
use std::process::Command;

/// Source folders of the program, relative to this crate.
const SOURCES: [&str; 5] = [
    "../../Cargo.lock",
    "../../crates",
    EXAMPLES,
    "../../scenes",
    "../../shaders",
];

/// Filters that the command `new` writes.
const EXAMPLES: &str = "../../examples/first_blur";

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed={EXAMPLES}");
    println!("cargo::rerun-if-env-changed=SHUTTERTRUTH_COMMIT");
    let version = env("CARGO_PKG_VERSION");
    let target = env("TARGET");
    let source = match env("PROFILE").as_str() {
        "release" => describe_source(),
        // A commit would soon be out of date, or every commit would recompile the program.
        _ => "development build".to_owned(),
    };
    println!("cargo::rustc-env=SHUTTERTRUTH_VERSION={version} ({source}, {target})");
}

/// Describes the source: the commit named by the environment or by git, or none.
fn describe_source() -> String {
    if let Ok(commit) = std::env::var("SHUTTERTRUTH_COMMIT")
        && !commit.trim().is_empty()
    {
        return format!("commit {}", commit.trim());
    }
    // A folder without its own git may be inside another project's repository.
    let root = Path::new("../..").canonicalize().ok();
    let top = git(&["rev-parse", "--show-toplevel"]).map(|top| Path::new(&top).canonicalize());
    let is_own = matches!((root, top), (Some(root), Some(Ok(top))) if root == top);
    let Some(commit) = git(&["rev-parse", "--short=12", "HEAD"]).filter(|_| is_own) else {
        return "unknown commit: built without git".to_owned();
    };
    let log = git(&["rev-parse", "--git-path", "logs/HEAD"]);
    for path in log.as_deref().into_iter().chain(SOURCES) {
        println!("cargo::rerun-if-changed={path}");
    }
    match git(&["status", "--porcelain", "--untracked-files=no"]).as_deref() {
        Some("") => format!("commit {commit}"),
        _ => format!("commit {commit} with changes"),
    }
}

/// Runs git; returns its output, or none without git or a repository.
fn git(words: &[&str]) -> Option<String> {
    let output = Command::new("git").args(words).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}

fn env(name: &str) -> String {
    std::env::var(name).expect("cargo sets it")
}
