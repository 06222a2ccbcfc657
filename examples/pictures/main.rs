//! Makes the pictures of the pages, as pictures.toml says: `make pictures`. `--check` compares them
//! with those of the pages instead of replacing these. `report,fan` makes those of two runs;
//! without a name, all run.

#[path = "../../tests/report_page/browser.rs"]
#[expect(dead_code, reason = "the tests of pages need more of it")]
mod browser;
mod draw;
mod recipe;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::{env, fs};

use draw::{draw, read_text};
use image::Rgb;
use measure::Error;
use recipe::{Picture, PictureRun, RECORD, Recipe, Record, Shown, hash, is_picture, read_record};

/// Folder of pictures before they are compared, each at its path.
const MADE: &str = "out/pictures/made";
/// Difference of colours between two adapters, of 255.
const ROUNDING: u8 = 2;

fn main() -> ExitCode {
    let words = env::args().skip(1);
    let names: Vec<String> = words
        .flat_map(|word| word.split(',').map(str::to_owned).collect::<Vec<_>>())
        .collect();
    match make(&names) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(count) => {
            eprintln!(
                "{count} pictures are not what the program makes; replace them: make pictures"
            );
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// Makes the pictures of the named runs. Returns how many differ from the pages', which are
/// replaced unless a name is `--check`.
fn make(names: &[String]) -> Result<usize, Error> {
    let (options, names): (Vec<_>, Vec<_>) = names.iter().partition(|name| *name == "--check");
    let recipe = Recipe::read();
    let all: Vec<&str> = recipe.run.iter().map(|run| run.name.as_str()).collect();
    if let Some(unknown) = names.iter().find(|name| !all.contains(&name.as_str())) {
        let all = all.join(", ");
        return Err(Error::Refused(format!(
            "no run of pictures is called \"{unknown}\"; runs are {all}"
        )));
    }
    let mut kept = read_record(Path::new("."));
    let mut differing = 0;
    for run in &recipe.run {
        if names.is_empty() || names.contains(&&run.name) {
            eprintln!("pictures: {}, up to {} s", run.name, run.seconds);
            run_commands(run)?;
            for (path, shown) in make_pictures(run)? {
                let Some(difference) = find_difference(&path, &shown, kept.get(&path)) else {
                    continue;
                };
                println!("{path}: {difference}");
                if options.is_empty() {
                    copy(&made(&path), Path::new(&path))?;
                    kept.insert(path, shown);
                } else {
                    differing += 1;
                }
            }
        }
    }
    for left in &recipe.by_hand {
        eprintln!("left as it is: {}, {}", left.file, left.reason);
    }
    if options.is_empty() {
        kept.retain(|path, _| Path::new(path).exists());
        let text = serde_json::to_string_pretty(&kept).expect("texts by path") + "\n";
        frame::write_atomically(Path::new(RECORD), text.as_bytes())?;
    }
    Ok(differing)
}

/// Runs the commands of a run with this build's programs.
fn run_commands(run: &PictureRun) -> Result<(), Error> {
    let program = env::current_exe().expect("a program has a path");
    let examples = program.parent().expect("a program is in a folder");
    let programs = [examples.to_owned(), examples.join("..")].into_iter();
    let before = env::var_os("PATH").unwrap_or_default();
    let path = env::join_paths(programs.chain(env::split_paths(&before)));
    let path = path.expect("folders without colons");
    let folder = Path::new(".").join(&run.folder);
    fs::create_dir_all(&folder).map_err(|error| failed(&run.folder, error))?;
    for command in &run.commands {
        eprintln!("    {command}");
        let mut shell = Command::new("sh");
        shell
            .args(["-c", command])
            .current_dir(&folder)
            .env("PATH", &path);
        let ended = shell.status().map_err(|error| failed(command, error))?;
        if !ended.success() {
            return Err(failed(command, ended));
        }
    }
    Ok(())
}

/// Makes the pictures of a run in their own folder. Returns what each shows.
fn make_pictures(run: &PictureRun) -> Result<Record, Error> {
    let below = Path::new(&run.folder);
    let mut record = Record::new();
    for picture in &run.picture {
        for (path, from) in list_files(picture, below)? {
            match from {
                Some(from) => copy(&from, &made(&path))?,
                None => draw(picture, below, &made(&path))?,
            }
            let bytes = fs::read(made(&path)).map_err(|error| failed(&path, error))?;
            let text = read_text(picture, below, &path)?;
            let hash = hash(&bytes);
            record.insert(path, Shown { hash, text });
        }
    }
    Ok(record)
}

/// Lists the paths of a picture, or of all of its folder, and the files to copy.
fn list_files(picture: &Picture, below: &Path) -> Result<Vec<(String, Option<PathBuf>)>, Error> {
    let Some(folder) = &picture.folder else {
        let from = picture.copy.as_ref().map(|file| below.join(file));
        return Ok(vec![(picture.file.clone(), from)]);
    };
    let files = fs::read_dir(below.join(folder)).map_err(|error| failed(folder, error))?;
    let paths = files.filter_map(|file| Some(file.ok()?.path()));
    let pictures = paths.filter(|path| is_picture(path)).map(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        (format!("{}/{name}", picture.file), Some(path))
    });
    Ok(pictures.collect())
}

/// Says how a made picture differs from the page's, pixel by pixel, or from its record.
fn find_difference(path: &str, shown: &Shown, kept: Option<&Shown>) -> Option<String> {
    let Ok(bytes) = fs::read(path) else {
        return Some("is missing".to_owned());
    };
    let now = fs::read(made(path)).expect("a picture that was just made");
    let read = |bytes: &[u8]| image::load_from_memory(bytes).map(|picture| picture.to_rgb8());
    let (Ok(old), Ok(new)) = (read(&bytes), read(&now)) else {
        return Some("cannot be read".to_owned());
    };
    if old.dimensions() != new.dimensions() {
        let sizes = (old.dimensions(), new.dimensions());
        return Some(format!("has another size: {sizes:?}"));
    }
    let change = |(old, new): (&Rgb<u8>, &Rgb<u8>)| {
        let channels = old.0.into_iter().zip(new.0);
        channels.map(|(old, new)| old.abs_diff(new)).max()
    };
    let changes = old.pixels().zip(new.pixels()).filter_map(change);
    let changes: Vec<u8> = changes.filter(|change| *change > ROUNDING).collect();
    if let Some(most) = changes.iter().max() {
        let (count, all) = (changes.len(), old.width() * old.height());
        return Some(format!(
            "{count} of {all} pixels differ, by up to {most} of 255"
        ));
    }
    match kept {
        None => Some(format!("is not in {RECORD}")),
        Some(kept) if kept.hash != hash(&bytes) => Some(format!("is not the picture of {RECORD}")),
        Some(kept) if kept.text != shown.text => {
            Some(format!("shows another text than {RECORD} says"))
        }
        Some(_) => None,
    }
}

fn made(path: &str) -> PathBuf {
    Path::new(MADE).join(path)
}

fn copy(from: &Path, to: &Path) -> Result<(), Error> {
    let bytes = fs::read(from).map_err(|error| failed(&from.display().to_string(), error))?;
    Ok(frame::write_atomically(to, &bytes)?)
}

fn failed(what: &str, why: impl std::fmt::Display) -> Error {
    Error::Refused(format!("{what}: {why}"))
}
