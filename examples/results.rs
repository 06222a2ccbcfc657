//! Keeps results: puts the scores of runs of different scenes into their file below `results/`, and writes `results/README.md` from all
//! files there: `cargo run -p cli --example results -- out/run.json`. Without a run it writes the page alone.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use cli::results_page;
use suite::{Error, Results, Run};

const FOLDER: &str = "results";

fn main() -> ExitCode {
    let runs: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    match keep(&runs).and_then(|()| write_page()) {
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
    let path = Path::new(FOLDER).join(results.file_name());
    if path.exists() {
        let newer = std::mem::replace(&mut results, Results::read(&path)?);
        results.update(newer)?;
    }
    frame::write_atomically(&path, results.text().as_bytes())?;
    println!("{}", path.display());
    Ok(())
}

/// Writes the page from every file of results.
fn write_page() -> Result<(), Error> {
    let results = Results::read_all(Path::new(FOLDER))?;
    let path = Path::new(FOLDER).join("README.md");
    frame::write_atomically(&path, results_page(&results)?.as_bytes())?;
    println!("{}", path.display());
    Ok(())
}
