//! Keeps results: puts the scores of runs of different scenes into their file below `results/`, and writes its pages from all files
//! there: `cargo run -p cli --example results -- out/run.json`. A bench.json beside a run.json says what filters cost. Without a run
//! it writes the pages alone.

mod filter_page;
mod page;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use judge::Results;
use report::{read_bench, write_case_strip};
use suite::{Case, Error, Run};

use crate::filter_page::{picture_name, results_filter_pages};
use crate::page::{main_results, results_page};

const FOLDER: &str = "results";

fn main() -> ExitCode {
    let runs: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    match keep(&runs).and_then(|()| write_pages(&runs)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// Writes the file of results of these runs, if there are any.
fn keep(paths: &[PathBuf]) -> Result<(), Error> {
    if paths.is_empty() {
        return Ok(());
    }
    let runs: Vec<Run> = (paths.iter())
        .map(|path| Run::read(path))
        .collect::<Result<_, _>>()?;
    let mut results = Results::from_runs(&runs)?;
    for path in paths {
        if let Some(bench) = read_bench(folder_of(path))? {
            results.add_costs(&bench)?;
        }
    }
    let path = Path::new(FOLDER).join(results.file_name());
    if path.exists() {
        let newer = std::mem::replace(&mut results, Results::read(&path)?);
        results.update(newer)?;
    }
    frame::write_atomically(&path, results.text().as_bytes())?;
    println!("{}", path.display());
    Ok(())
}

/// Writes all pages from every file of results, and pictures of the runs' cases that they show.
fn write_pages(runs: &[PathBuf]) -> Result<(), Error> {
    let results = Results::read_all(Path::new(FOLDER))?;
    let mut pages = results_filter_pages(&results);
    pages.insert("README.md".to_owned(), results_page(&results)?);
    for (name, text) in pages {
        let path = Path::new(FOLDER).join(name);
        frame::write_atomically(&path, text.as_bytes())?;
        println!("{}", path.display());
    }
    for path in runs {
        write_pictures(&results, &Run::read(path)?, folder_of(path))?;
    }
    Ok(())
}

/// Writes the worst picture of each filter, where the run made it.
fn write_pictures(all: &[Results], run: &Run, folder: &Path) -> Result<(), Error> {
    let Some(results) = main_results(all) else {
        return Ok(());
    };
    if [run.render.width, run.render.height] != results.size {
        return Ok(());
    }
    let filters: BTreeSet<&str> = (results.scores.iter())
        .map(|own| own.filter.as_str())
        .collect();
    for worst in filters
        .into_iter()
        .filter_map(|filter| results.worst_of(filter))
    {
        let is_worst = |own: &&Case| own.name() == worst.name && own.scene == worst.scene;
        if let Some(case) = run.cases.iter().find(is_worst) {
            let path = Path::new(FOLDER).join("pictures").join(picture_name(worst));
            write_case_strip(case, folder, &path)?;
            println!("{}", path.display());
        }
    }
    Ok(())
}

fn folder_of(run: &Path) -> &Path {
    run.parent().unwrap_or(Path::new(""))
}
