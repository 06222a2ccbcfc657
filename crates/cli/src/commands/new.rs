//! The command `new`, which begins a filter of the user's own with an example.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};
use filters::check_filter_name;
use frame::{FileError, write_atomically};
use include_dir::{Dir, include_dir};
use measure::{Error, printable_path};
use terminal::output::print;
use terminal::refuse;

use super::list::list_filter;

/// One small blur for each engine and language.
static EXAMPLES: Dir = include_dir!("$CARGO_MANIFEST_DIR/../../examples/first_blur");

#[derive(Debug, Args)]
pub struct NewArgs {
    /// Folder to make; its name becomes the filter's.
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    /// Example to start from.
    #[arg(long, value_name = "EXAMPLE", value_parser = example_names())]
    pub from: String,
}

/// Writes an example as a filter of the user's own, tries it out as `list` does, and prints the
/// next command.
pub fn execute(args: &NewArgs) -> Result<(), Error> {
    let name = args.folder.file_name().and_then(OsStr::to_str);
    let name = name.unwrap_or_default();
    if let Err(reason) = check_filter_name(name) {
        refuse!("new: {}: {reason}", args.folder.display());
    }
    if args.folder.exists() {
        refuse!(
            "new: {} exists; allowed: a new folder; choose another name",
            args.folder.display()
        );
    }
    let example = EXAMPLES
        .get_dir(&args.from)
        .expect("the parser knows these names alone");
    let folder = if args.folder.is_relative() {
        Path::new(".").join(&args.folder)
    } else {
        args.folder.clone()
    };
    write_example(example, name, &folder)?;
    let shown = printable_path(&folder);
    print(format!("written: {shown}, from {}\n", args.from))?;
    list_filter(&folder)?;
    print(format!(
        "next: shuttertruth run sliding_panel fan railing --filter {shown} --size 160x90 --open\n"
    ))
}

/// Writes the files of an example under the filter's name, all or none.
fn write_example(example: &Dir, name: &str, folder: &Path) -> Result<(), Error> {
    let fail = |source| FileError::io(folder, "write", source);
    let parent = folder.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(parent).map_err(fail)?;
    // A killed command leaves no half filter: the folder is written elsewhere, and then moved.
    let whole = tempfile::Builder::new()
        .prefix(".shuttertruth-")
        .suffix(".tmp")
        .tempdir_in(parent);
    let whole = whole.map_err(fail)?;
    let manifest = manifest_text(example);
    let named = quoted_value(manifest, "name");
    for (below, bytes) in list_files(example) {
        // A kernel file is called as its filter is.
        let below = match below.strip_prefix(named) {
            Some(ending) if ending.starts_with('.') => format!("{name}{ending}"),
            _ => below,
        };
        let path = whole.path().join(&below);
        if below == "filter.toml" {
            let renamed = manifest.replacen(&format!("\"{named}\""), &format!("\"{name}\""), 1);
            write_atomically(&path, renamed.as_bytes())?;
        } else {
            write_atomically(&path, bytes)?;
        }
    }
    Ok(std::fs::rename(whole.path(), folder).map_err(fail)?)
}

/// Lists the files below an example by their paths in it.
fn list_files<'a>(example: &'a Dir<'a>) -> Vec<(String, &'a [u8])> {
    let mut files = Vec::new();
    let mut folders = vec![example];
    while let Some(folder) = folders.pop() {
        folders.extend(folder.dirs());
        for file in folder.files() {
            let below = file.path().strip_prefix(example.path());
            let below = below.expect("a file lies below its folder");
            files.push((below.display().to_string(), file.contents()));
        }
    }
    files
}

/// Lists the examples for `--from`, each with its summary.
fn example_names() -> PossibleValuesParser {
    let mut folders: Vec<&Dir> = EXAMPLES.dirs().collect();
    folders.sort_by_key(|folder| folder.path());
    PossibleValuesParser::new(folders.into_iter().map(|folder| {
        let name = folder.path().to_str().expect("its name is Unicode");
        let summary = quoted_value(manifest_text(folder), "summary");
        PossibleValue::new(name).help(summary.trim_end_matches('.'))
    }))
}

/// Returns the filter.toml of an example.
fn manifest_text<'a>(example: &'a Dir<'a>) -> &'a str {
    let file = example.get_file(example.path().join("filter.toml"));
    let text = file.and_then(|file| file.contents_utf8());
    text.expect("an example has a filter.toml")
}

/// Returns the text of a key at the top of an example's filter.toml.
fn quoted_value<'a>(manifest: &'a str, key: &str) -> &'a str {
    let start = format!("{key} = \"");
    let rest = manifest
        .lines()
        .find_map(|line| line.strip_prefix(start.as_str()));
    let value = rest.and_then(|rest| rest.split('"').next());
    value.expect("an example has a name and a summary")
}
