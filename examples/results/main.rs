//! Keeps results: puts the scores of runs of different scenes into their file below `results/`, and
//! writes its page from all files there: `cargo run -p shuttertruth --example results -- out/run.json`. A
//! file named `bench` and more, as pages save it, goes into its card's file below `results/bench/`.
//! Without a file it only writes the page. With `--lengths` it prints the lengths of engines'
//! smears. With `--site FOLDER` it keeps nothing, and writes the source of the site with live cases
//! of one run: `make site`.

mod change;
mod engines;
mod lengths;
mod page;
mod site;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use bench::Bench;
use judge::Results;
use measure::{Case, Error, ReferencePicture, Run};
use report::{RunReport, write_case_strip, write_report};

use crate::engines::list_engines;
use crate::lengths::{Lengths, Panels};
use crate::page::{main_results, picture_name, results_page};
use crate::site::{Site, read};

const FOLDER: &str = "results";
/// Folder of the files of cards, below the first.
const BENCHES: &str = "bench";

fn main() -> ExitCode {
    let paths = std::env::args_os().skip(1).map(PathBuf::from);
    let (benches, runs): (Vec<_>, Vec<_>) = paths.partition(|path| is_bench(path));
    let done = match &runs[..] {
        [option, folder, run] if option == Path::new("--site") => write_site(folder, run),
        [option] if option == Path::new("--lengths") => {
            print_lengths();
            Ok(())
        }
        _ => (keep(&runs).and_then(|()| keep_benches(&benches))).and_then(|()| write_page(&runs)),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// Prints the measured lengths of engines' smears, for engines.toml.
fn print_lengths() {
    let panels = Panels::new();
    for engine in list_engines() {
        let Lengths { shipped, at_180 } = panels.measure(&engine, 1.0);
        println!(
            "{}: length = {shipped:.0}, at_180 = {at_180:.0}",
            engine.name
        );
    }
}

/// Writes these runs' file of results, if there are any.
fn keep(paths: &[PathBuf]) -> Result<(), Error> {
    if paths.is_empty() {
        return Ok(());
    }
    let runs: Vec<Run> = (paths.iter())
        .map(|path| Run::read(path))
        .collect::<Result<_, _>>()?;
    let mut results = Results::from_runs(&runs)?;
    let path = Path::new(FOLDER).join(results.file_name());
    if path.exists() {
        let newer = std::mem::replace(&mut results, Results::read(&path)?);
        results.update(newer)?;
    }
    frame::write_atomically(&path, results.text().as_bytes())?;
    println!("{}", path.display());
    Ok(())
}

fn is_bench(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().starts_with("bench")
}

fn keep_benches(paths: &[PathBuf]) -> Result<(), Error> {
    for path in paths {
        let kept = Bench::read(path)?.keep(&Path::new(FOLDER).join(BENCHES))?;
        println!("{}", kept.display());
    }
    Ok(())
}

/// Writes the page from every file of results, and the pictures of the runs' cases on it.
fn write_page(runs: &[PathBuf]) -> Result<(), Error> {
    let results = Results::read_all(Path::new(FOLDER))?;
    let cards = Bench::read_all(&Path::new(FOLDER).join(BENCHES))?;
    let path = Path::new(FOLDER).join("README.md");
    frame::write_atomically(&path, results_page(&results, &cards)?.as_bytes())?;
    println!("{}", path.display());
    for path in runs {
        write_pictures(&results, &Run::read(path)?, path)?;
    }
    Ok(())
}

/// Writes the worst picture of each engine's shipped preset, if the run made it.
fn write_pictures(all: &[Results], run: &Run, path: &Path) -> Result<(), Error> {
    let Some(results) = main_results(all) else {
        return Ok(());
    };
    if run.render.size() != results.size {
        return Ok(());
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let engines = list_engines().into_iter();
    for worst in engines.filter_map(|engine| results.worst_of(&engine.shape)) {
        let is_worst = |case: &&Case| case.name() == worst.name && case.scene == worst.scene;
        if let Some(case) = run.cases.iter().find(is_worst) {
            let path = Path::new(FOLDER).join("pictures").join(picture_name(worst));
            write_case_strip(case, folder, &path)?;
            println!("{}", path.display());
        }
    }
    Ok(())
}

/// Writes the source of the site to `folder`, with live cases of the run at `path`.
fn write_site(folder: &Path, path: &Path) -> Result<(), Error> {
    let mut run = Run::read(path)?;
    // A scene's pictures are loaded together; live cases need no sub-frames next to them.
    let is_accumulation =
        |case: &Case| matches!(case.reference(), Some(ReferencePicture::Accumulation(_)));
    run.cases.retain(|case| !is_accumulation(case));
    let names: BTreeSet<String> = (run.cases.iter())
        .map(|case| case.scene.to_string())
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    Site::collect(Path::new("."), &names)?.write(Path::new("."), folder)?;
    let [run_folder, live] = [
        path.parent().unwrap_or(Path::new("")),
        &folder.join("src/live"),
    ];
    for name in names {
        let picture = read(&run_folder.join(name).join("frame.png"))?;
        frame::write_atomically(&live.join(format!("{name}.png")), &picture)?;
    }
    // Pictures and tables are files of their own, which the page loads when someone opens a case.
    let report = RunReport {
        run: &run,
        folder: run_folder,
        findings: &[],
        verdict: None,
        additions: &[bench::add_costs(&run, run_folder)?],
        largest: 0,
    };
    write_report(&report, &live.join("report.html"))?;
    println!("{}", folder.display());
    Ok(())
}
